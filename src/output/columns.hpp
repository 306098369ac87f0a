// What a run reports as numbers: its probes and the entries of the energy ledger, each named once.
#pragma once
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/units.hpp"
#include "solver/ledger.hpp"

namespace geist::output {

/// A probe, and its value now.
struct ProbeValue {
  std::string name;
  Dimension dimension;
  double value = std::numeric_limits<double>::quiet_NaN();
  double expected = std::numeric_limits<double>::quiet_NaN();  ///< to compare with, where the case names one
  std::string expected_from = {};                              ///< where that comes from
};

/// An entry of the ledger: one column of the history, one key of the summary.
struct LedgerEntry {
  std::string_view name;
  Dimension dimension;
  double (*value)(const Ledger&);
};

/// Energies now, energies since the start, their balance; then the momenta.
std::span<const LedgerEntry> ledger_entries();
/// Those of them that are energies.
std::span<const LedgerEntry> energy_entries();

/// Sum of the energies that are there and those dissipated, what the balance is compared with.
double total_energy(const Ledger& ledger);

}  // namespace geist::output
