// History: one row of history.csv at a time.
//
// First line: the columns' names, separated by commas: step, time, the probes, the entries of the ledger,
// residual. Then numbers, with as many digits as it takes to read back the same bits; a number that does not
// exist (the residual of a dynamic run) is left empty. Units stand in summary.json under "units", "history".
#pragma once
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "output/columns.hpp"
#include "output/file.hpp"

namespace geist::output {

struct HistoryRow {
  long step = 0;
  double time = 0;
  std::vector<double> probes;  ///< in the order of the probes given at the beginning
  Ledger ledger;
  double residual = std::numeric_limits<double>::quiet_NaN();  ///< share of the load; static and quasi-static
};

/// The columns of the history with their units, in order.
std::vector<std::pair<std::string, Dimension>> history_columns(std::span<const ProbeValue> probes);

class History {
 public:
  /// Throws std::runtime_error if the file cannot be written, std::invalid_argument if two columns have one
  /// name.
  History(const std::filesystem::path& path, std::span<const ProbeValue> probes);

  /// Each row is handed to the system at once: a run that is killed keeps it. Throws std::runtime_error.
  void write(const HistoryRow& row);

 private:
  std::size_t probes_;
  File file_;
};

}  // namespace geist::output
