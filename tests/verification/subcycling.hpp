// What the tests of subcycling share: K̃ by columns and its spectrum, and the energy balance of a run.
#pragma once
#include <string>
#include <vector>

#include "case/build.hpp"

namespace geist::verification {

/// Let sim take steps of dt, if what cannot can take short ones.
bool subcycle(Simulation& sim, double dt, double safety = 1);

/// What divisions of bodies gave.
struct Spectra {
  int found = 0;
  std::vector<int> by_substeps = std::vector<int>(9);
  double largest = 0;  ///< Δt² ω² / 4
  std::string words() const;
};

/// That K̃, which short steps make of the stiffness, is symmetric, has the rigid motions alone at zero, and is
/// stable with each of these time steps (without any safety) that can be divided. It is found column by
/// column from the accelerations that the first half kick tells.
void expect_symmetric_and_stable(const Case& input, const std::vector<double>& steps, Spectra& spectra);

/// Largest error of the energy balance until a time.
double worst_balance(Simulation& sim, double until);

}  // namespace geist::verification
