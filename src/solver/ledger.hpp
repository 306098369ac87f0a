// Ledger: where the energy is and went, and the momenta. All at the time t^n of the displacements.
#pragma once
#include "core/vec.hpp"

namespace geist {

struct Ledger {
  // Energy now
  double kinetic_translation = 0;
  double kinetic_rotation = 0;  ///< of particles and ghosts
  double strain_elements = 0;
  double strain_bonds = 0;     ///< particle–particle
  double strain_coupling = 0;  ///< particle–ghost
  double hourglass = 0;        ///< stored by stiffness-type control
  double contact = 0;          ///< in the springs of contacts
  // Energy since the start
  double damping = 0;          ///< taken out by damping (mass-proportional, viscous hourglass control)
  double friction = 0;         ///< taken out by sliding contacts
  double contact_damping = 0;  ///< taken out by restitution < 1
  double external = 0;         ///< work of loads and moving supports
  double initial = 0;          ///< energy at time 0
  // Momenta
  Vec3 linear;  ///< Σ m v
  /// Σ X × m v + I ω about the origin, ghost spin included. Reference positions, which bonds and hexahedra of
  /// small displacement keep; with contact or finite kinematics, present positions X + u, which these keep.
  Vec3 angular;

  double kinetic() const { return kinetic_translation + kinetic_rotation; }
  double internal() const { return strain_elements + strain_bonds + strain_coupling + hourglass + contact; }
  double dissipated() const { return damping + friction + contact_damping; }
  /// What is there, less what should be: zero for the exact solution.
  double balance() const { return kinetic() + internal() + dissipated() - external - initial; }
};

}  // namespace geist
