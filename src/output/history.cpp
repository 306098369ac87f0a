#include "output/history.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <stdexcept>

namespace geist::output {
namespace {

std::string number(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

/// A name as a cell of a CSV file (RFC 4180).
std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == name.npos) return name;
  std::string cell = "\"";
  for (const char c : name) cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + '"';
}

std::string header(std::span<const ProbeValue> probes) {
  std::string line;
  std::set<std::string> names;
  for (const auto& [name, unit] : history_columns(probes)) {
    if (!names.insert(name).second)
      throw std::invalid_argument(fmt::format("the history has two columns called \"{}\"", name));
    line += fmt::format("{}{}", line.empty() ? "" : ",", quoted(name));
  }
  return line + '\n';
}

}  // namespace

std::vector<std::pair<std::string, Dimension>> history_columns(std::span<const ProbeValue> probes) {
  std::vector<std::pair<std::string, Dimension>> columns{{"step", dimension::none},
                                                         {"time", dimension::time}};
  for (const ProbeValue& probe : probes) columns.emplace_back(probe.name, probe.dimension);
  for (const LedgerEntry& entry : ledger_entries()) columns.emplace_back(entry.name, entry.dimension);
  columns.emplace_back("residual", dimension::none);
  return columns;
}

History::History(const std::filesystem::path& path, std::span<const ProbeValue> probes)
    : probes_(probes.size()), file_(path) {
  file_.write(header(probes));
  file_.flush();
}

void History::write(const HistoryRow& row) {
  if (row.probes.size() != probes_) throw std::invalid_argument("a history row has one value for each probe");
  std::string line = fmt::format("{},{}", row.step, number(row.time));
  for (const double value : row.probes) line += fmt::format(",{}", number(value));
  for (const LedgerEntry& entry : ledger_entries())
    line += fmt::format(",{}", number(entry.value(row.ledger)));
  line += fmt::format(",{}\n", number(row.residual));
  file_.write(line);
  file_.flush();
}

}  // namespace geist::output
