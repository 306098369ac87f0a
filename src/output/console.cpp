#include "output/console.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace geist::output {
namespace {

std::string number(double value) { return fmt::format("{:.6g}", value); }

/// "12.3 %"; shares too small for that keep a digit that says how small.
std::string percent(double part, double whole) {
  if (!(whole > 0)) return "-";
  const double share = 100 * part / whole;
  const bool tiny = share != 0 && std::abs(share) < 0.05;
  return tiny ? fmt::format("{:.1g} %", share) : fmt::format("{:.1f} %", share);
}

/// By how much a value is larger in size than expected: "+2.4 %".
std::string excess(double value, double expected) {
  return expected == 0 ? "-" : fmt::format("{:+.2f} %", 100 * (value / expected - 1));
}

/// Columns that a text takes up: bytes of UTF-8 that do not continue a character.
std::size_t width(std::string_view text) {
  return std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
}

std::string padded(const std::string& text, std::size_t columns, bool left) {
  const std::string space(columns - std::min(columns, width(text)), ' ');
  return left ? text + space : space + text;
}

/// "1 min 20 s"; the smaller unit is left out where it is zero.
std::string two_units(long long whole, long long per, std::string_view large, std::string_view small) {
  std::string text = fmt::format("{} {}", whole / per, large);
  if (whole % per) text += fmt::format(" {} {}", whole % per, small);
  return text;
}

}  // namespace

std::string with_commas(long long n) {
  const std::string digits = std::to_string(n);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const bool thousands = (digits.size() - i) % 3 == 0 && i > (n < 0 ? 1u : 0u);
    if (thousands) text += ',';
    text += digits[i];
  }
  return text;
}

std::string human_bytes(double bytes) {
  constexpr std::array units{"B", "KiB", "MiB", "GiB", "TiB"};
  std::size_t unit = 0;
  for (; bytes >= 1023.95 && unit + 1 < units.size(); ++unit) bytes /= 1024;
  return unit ? fmt::format("{:.1f} {}", bytes, units[unit]) : fmt::format("{:.0f} B", bytes);
}

std::string human_seconds(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  if (seconds < 0.9995) return fmt::format("{:.3g} ms", 1e3 * seconds);
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  if (seconds < 3599.5) return two_units(std::llround(seconds), 60, "min", "s");
  if (seconds < 86370) return two_units(std::llround(seconds / 60), 60, "h", "min");
  return two_units(std::llround(seconds / 3600), 24, "d", "h");
}

std::string to_text(const Table& table) {
  std::vector<std::vector<std::string>> rows = table.rows;
  if (!table.header.empty()) rows.insert(rows.begin(), table.header);
  std::vector<std::size_t> columns;
  for (const auto& row : rows) {
    columns.resize(std::max(columns.size(), row.size()));
    for (std::size_t c = 0; c < row.size(); ++c) columns[c] = std::max(columns[c], width(row[c]));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c)
      line += fmt::format("  {}", padded(row[c], columns[c], c == 0));
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

Table probe_table(std::span<const ProbeValue> probes, const UnitSystem& units) {
  const bool compare =
      std::any_of(probes.begin(), probes.end(), [](auto& p) { return !std::isnan(p.expected); });
  Table table{{"probe", "value", "unit"}, {}};
  if (compare) table.header.insert(table.header.end(), {"expected", "difference", "by"});
  for (const ProbeValue& probe : probes) {
    auto& row = table.rows.emplace_back();
    row = {probe.name, number(probe.value), units.label(probe.dimension)};
    if (!compare) continue;
    if (std::isnan(probe.expected))
      row.insert(row.end(), {"", "", ""});
    else
      row.insert(row.end(),
                 {number(probe.expected), excess(probe.value, probe.expected), probe.expected_from});
  }
  return table;
}

Table ledger_table(const Ledger& ledger, const UnitSystem& units) {
  Table table{{"energy", units.label(dimension::energy), "share"}, {}};
  const double total = total_energy(ledger);
  for (const LedgerEntry& entry : energy_entries()) {
    const double value = entry.value(ledger);
    std::string name(entry.name);
    std::replace(name.begin(), name.end(), '_', ' ');
    if (value != 0 || entry.name == "balance")
      table.rows.push_back({name, number(value), percent(value, total)});
  }
  return table;
}

Table timing_table(std::span<const Phase> phases) {
  Table table{{"phase", "time", "share"}, {}};
  double total = 0;
  for (const Phase& phase : phases) total += phase.seconds;
  for (const Phase& phase : phases)
    table.rows.push_back({phase.name, human_seconds(phase.seconds), percent(phase.seconds, total)});
  table.rows.push_back({"total", human_seconds(total), percent(total, total)});
  return table;
}

void print(std::FILE* out, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), out);
  std::fflush(out);
}

}  // namespace geist::output
