#include "output/columns.hpp"

#include <cmath>

namespace geist::output {
namespace {

using L = const Ledger&;
namespace dim = dimension;
constexpr std::size_t energies = 13;

// clang-format off
constexpr LedgerEntry list[] = {
    {"kinetic_translation", dim::energy, [](L l) { return l.kinetic_translation; }},
    {"kinetic_rotation",    dim::energy, [](L l) { return l.kinetic_rotation; }},
    {"strain_elements",     dim::energy, [](L l) { return l.strain_elements; }},
    {"strain_bonds",        dim::energy, [](L l) { return l.strain_bonds; }},
    {"strain_coupling",     dim::energy, [](L l) { return l.strain_coupling; }},
    {"hourglass",           dim::energy, [](L l) { return l.hourglass; }},
    {"contact",             dim::energy, [](L l) { return l.contact; }},
    {"damping",             dim::energy, [](L l) { return l.damping; }},
    {"friction",            dim::energy, [](L l) { return l.friction; }},
    {"contact_damping",     dim::energy, [](L l) { return l.contact_damping; }},
    {"external",            dim::energy, [](L l) { return l.external; }},
    {"initial",             dim::energy, [](L l) { return l.initial; }},
    {"balance",             dim::energy, [](L l) { return l.balance(); }},
    {"momentum_x",         dim::momentum, [](L l) { return l.linear.x; }},
    {"momentum_y",         dim::momentum, [](L l) { return l.linear.y; }},
    {"momentum_z",         dim::momentum, [](L l) { return l.linear.z; }},
    {"angular_momentum_x", dim::angular_momentum, [](L l) { return l.angular.x; }},
    {"angular_momentum_y", dim::angular_momentum, [](L l) { return l.angular.y; }},
    {"angular_momentum_z", dim::angular_momentum, [](L l) { return l.angular.z; }},
};
// clang-format on
static_assert(list[energies - 1].name == "balance");

}  // namespace

std::span<const LedgerEntry> ledger_entries() { return list; }
std::span<const LedgerEntry> energy_entries() { return ledger_entries().first(energies); }

double total_energy(const Ledger& ledger) {
  return ledger.kinetic() + ledger.internal() + ledger.dissipated();
}

}  // namespace geist::output
