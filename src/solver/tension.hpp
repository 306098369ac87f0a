// A patch test that every run can afford: pull a bar of 12 × 4 × 4 particles and see what E and ν it has.
#pragma once
#include <optional>

#include "model/lattice.hpp"

namespace geist {

/// What the bar answered in its middle third, its ends pulled with evenly spread forces.
struct Tension {
  double young, poisson;
};

/// A bar of the lattice's material, radius and method. Nothing if such a bar cannot be (its ν is for thinner
/// bodies) or finds no equilibrium.
std::optional<Tension> tension_test(const Lattice& like);

}  // namespace geist
