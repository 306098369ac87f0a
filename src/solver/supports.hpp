// Supports: components of motion that are held or prescribed in time, with their reactions and work.
#pragma once
#include <cstdint>
#include <vector>

#include "model/model.hpp"
#include "solver/curve.hpp"

namespace geist {

/// Displacement factor · curve(t), or velocity factor · curve(t). A held component has velocity 0.
struct Motion {
  enum class Kind { held, displacement, velocity } kind = Kind::held;
  double factor = 0;
  Curve curve;

  /// Velocity over the step from t to t + dt.
  double velocity(double t, double dt) const;

  /// Displacement of a state of rest at time t: 0 where a velocity is prescribed, which has not moved
  /// anything yet.
  double displacement(double t) const;
};

/// One component (0–2 displacement, 3–5 rotation) of a node (lattice < 0) or of a particle.
struct HeldComponent {
  std::int32_t lattice;
  std::size_t place;  ///< node, or site
  std::int32_t slot;  ///< of the site in its lattice's list
  std::int32_t component;
  std::int32_t motion;  ///< index into Supports::motions
  double velocity = 0;  ///< prescribed for the present half step
  double reaction = 0;  ///< force (or moment) of the support on the body, at the time of the last kick
};

struct Supports {
  std::vector<Motion> motions;
  std::vector<HeldComponent> held;
  double work = 0;                 ///< of moving supports since the start
  std::vector<double> velocities;  ///< by motion, for the present step

  /// Prescribe the velocities of the step from model.time to model.time + dt, reckon the reactions
  /// R = m ((v⁺ − v⁻)/dt − g) − f, and add the work ½ (R^{n−1} + R^n) v⁻ dt of the step before.
  /// `arrived`: whether there was a step before.
  void apply(Model& model, double dt, Vec3 gravity, bool arrived);

  /// Bring what is held to rest, whatever its initial velocity says.
  void halt(Model& model);

  /// Work as if the reactions had grown in proportion to the displacement: W = ½ R·u.
  void reckon_proportional(const Model& model);

  /// √Σ R² over displacement components
  double reaction_norm() const;
};

}  // namespace geist
