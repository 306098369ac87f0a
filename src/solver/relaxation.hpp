// Adaptive dynamic relaxation: damping that follows the lowest frequency still in motion.
//
// Source: P. Underwood, Dynamic relaxation, in Computational Methods for Transient Analysis (1983), 245–265.
// A mode of frequency ω dies out fastest at α = 2ω. ω is taken from the running Rayleigh quotient of the
// motion,
//   ω² = Δu·K Δu / Δu·M Δu  with  K Δu = −(f^n − f^{n−1}),  Δu = Δt v^{n−1/2},
// the whole stiffness rather than Underwood's diagonal estimate of it: the change of force is known anyway.
// Fast modes die first, so the estimate falls until it is that of the slowest.
#pragma once
#include "solver/simulation.hpp"

namespace geist {

class Relaxation {
 public:
  /// Set sim.alpha for the next step.
  void update(Simulation& sim);

 private:
  double omega2_ = 0;
};

}  // namespace geist
