// Probes: single numbers read off a simulation.
#pragma once
#include <compare>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "solver/simulation.hpp"

namespace geist {

/// One of the lattices' particles.
struct ParticleId {
  std::int32_t lattice;
  std::size_t site;
  friend auto operator<=>(const ParticleId&, const ParticleId&) = default;
};

struct Probe {
  enum class Quantity { displacement, velocity, rotation, reaction, contact_force };
  enum class Reduce { mean, min, max, sum };

  std::string name;
  Quantity quantity = Quantity::displacement;
  int component = 0;  ///< 0–2; 3 is the magnitude
  Reduce reduce = Reduce::mean;
  std::vector<std::int32_t> nodes;    ///< ascending
  std::vector<ParticleId> particles;  ///< ascending
  std::vector<std::size_t> held;      ///< indices into Supports::held, for reactions

  /// Value at t^n of an observed step. Reactions and contact forces are sums over the selection.
  double value(const Simulation& sim) const;
};

}  // namespace geist
