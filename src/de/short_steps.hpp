// A lattice that takes short steps within the model's time step Δt (solver/subcycling.hpp): it sets out from
// u^n at rest, and comes back with what it would have been moved by. A short step is a step: its increments
// w_k = z_{k+1} − z_k take the place of the velocity,
//
//   w_k = κ w_{k−1} + γΔt² M⁻¹ f(z_k),   z_{k+1} = z_k + w_k,   Σ w_k = ½ Δt² M⁻¹ f̃
//
// so that the kernels of bonds.hpp do it. With finite rotations w_k turns R_k; then too f̃ is the mean of the
// forces on the way, since Σ w_k is linear in them.
#pragma once
#include "de/bonds.hpp"
#include "model/lattice.hpp"

namespace geist::de {

class ShortSteps {
 public:
  explicit ShortSteps(const Lattice& lattice);

  /// Sets out. lattice.listed_force is what acts on listed sites all along, besides bonds and gravity.
  void begin(Lattice& lattice);

  /// z_k + w_k, between two short steps; then ghosts must follow.
  void drift(Lattice& lattice);

  /// w_k by the forces at z_k. Those of bonds on listed sites count with `share` in their mean;
  /// lattice.listed_force has them and what acts all along.
  void step(Lattice& lattice, const Kick& kick, double share);

  /// Comes back: motion and velocity are as at begin(), lattice.listed_force is the mean and what acts all
  /// along.
  void end(Lattice& lattice);

  /// The kick of the free particles, with Σ w_k in the force's place.
  KickSums kick(Lattice& lattice, const Kick& kick) const;

 private:
  template <class Drift>
  void drift_by(const Drift& drift, Lattice& lattice);

  Field<6> motion_, increment_, sum_;  ///< u^n while away; w_k; Σ w but for the last
  Field<9> rotation_;                  ///< R^n while away
  Field<6> rest_, mean_;               ///< by listed site
  bool first_ = true;                  ///< still at u^n
};

}  // namespace geist::de
