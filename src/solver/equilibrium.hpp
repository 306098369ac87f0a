// Equilibrium: the state of rest K u = f of a model under its loads and supports, without time.
//
// Preconditioned conjugate gradients. K is never assembled: K p is what the kernels of a step make of the
// displacement p. With finite rotations Newton's method asks for such solutions, K being the tangent at the
// present state, and loads grow in steps. The preconditioner adds two corrections: every place moves against
// its own stiffness alone (point_blocks.hpp), and blocks of places move as rigid bodies (rigid_blocks.hpp).
#pragma once
#include <csignal>
#include <functional>
#include <string>

#include "solver/simulation.hpp"

namespace geist {

struct EquilibriumPlan {
  double tolerance = 1e-8;  ///< ‖force out of balance‖ / max(‖loads‖, ‖reactions‖)
  long max_iterations = 10'000;
  const volatile std::sig_atomic_t* stop = nullptr;      ///< becomes non-zero when the search shall end
  std::function<void(long, double)> progress = nullptr;  ///< told of every iteration and its residual
};

struct Equilibrium {
  enum class End { found, not_converged, interrupted, failed } end = End::found;
  std::string message;  ///< for people; empty if found
  long iterations = 0;
  double residual = 0;
};

/// Bring the model to rest where its loads and supports at model.time want it. A prescribed displacement is
/// that of the curve at this time; where a velocity is prescribed nothing has moved yet. Without contact and
/// viscous hourglass control. With finite rotations loads and prescribed displacements grow in proportion
/// from nothing; if equilibrium is lost on the way, the model stays at the last one found. Velocities stay as
/// they are, and forces are for Simulation::start() to find.
Equilibrium find_equilibrium(Simulation& sim, const EquilibriumPlan& plan);

}  // namespace geist
