// Text for the terminal: numbers for people, small tables, and the progress of a run.
#pragma once
#include <cstdio>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/columns.hpp"
#include "output/summary.hpp"

namespace geist::output {

/// "12,345"
std::string with_commas(long long n);
/// "512 B", "1.5 MiB"
std::string human_bytes(double bytes);
/// "3.2 ms", "12.3 s", "1 min 20 s", "2 h 5 min", "3 d 4 h"
std::string human_seconds(double seconds);

/// The first column is aligned to the left, the others to the right.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};
/// The table as lines, indented by two spaces.
std::string to_text(const Table& table);

/// Name, value, unit.
Table probe_table(std::span<const ProbeValue> probes, const UnitSystem& units);
/// Energies with their shares of all the energy there is; entries that are zero are left out.
Table ledger_table(const Ledger& ledger, const UnitSystem& units);
/// Seconds and shares of their sum.
Table timing_table(std::span<const Phase> phases);

/// Write text to a stream. A terminal that has gone away must not end the run: errors are ignored.
void print(std::FILE* out, std::string_view text);

}  // namespace geist::output
