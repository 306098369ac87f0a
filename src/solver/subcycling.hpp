// Subcycling: what vibrates too fast for the model's time step Δt takes m shorter ones within it.
//
// The fine nodes P are those that elements of high frequency meet, and one layer more; if the lattices are
// fine, all particles and the nodes that ghosts ride on, so that ghosts follow in every short step. Every
// step, the forces of the elements and bonds that touch P are the mean along a motion of P that starts from
// rest at u^n: everything else stands still, and so do the forces of everything else. With h = Δt/m, z_0 =
// u^n,
//
//   z_{k+1} − z_k = κ_k (z_k − z_{k−1}) + γ_k Δt² M⁻¹ f(z_k) in P,      f̃ = Σ_k s_k f(z_k),  Σ s_k = 1
//
// and central differences of the step Δt go on with f̃. To linear forces f = −K u that is a change of K into a
// symmetric K̃ with the frequencies that P alone would have with the step h, so that energy is conserved and
// Δt has one limit only, that K̃ sets (J. Diaz and M. J. Grote, SIAM J. Sci. Comput. 31 (2009) 1985–2014).
// κ, γ, s are those of leap-frog steps h, damped by ν = 1/10 so that no resonance of the steps is left (M. J.
// Grote, S. Michel and S. A. Sauter, Math. Comp. 90 (2021) 2603–2643). docs/theory.md, "Subcycling".
#pragma once
#include <cstdint>
#include <vector>

#include "core/field.hpp"
#include "coupling/ghosts.hpp"
#include "de/short_steps.hpp"
#include "model/model.hpp"
#include "solver/fine_part.hpp"
#include "solver/timers.hpp"

namespace geist {

/// One of the m short steps within Δt.
struct Substep {
  double keep;   ///< κ_k: of the increment before
  double gain;   ///< γ_k: of Δt² times the acceleration
  double share;  ///< s_k: of its force in the mean
};

/// All m of them: the recurrence of Chebyshev's polynomials T_k(δ), δ = 1 + ν/m².
std::vector<Substep> substeps(int m);

/// Largest Δt ω of what takes m short steps: 2 for m = 1, nearly 2m otherwise.
double stable_phase(int m);

/// How much Δt² ω² that stand still meanwhile may add to it.
double stable_remainder(int m);

class Subcycling {
 public:
  /// Nothing is fine.
  Subcycling() = default;
  /// The components that supports hold must be known, and the listed sites.
  Subcycling(const Model& model, const FinePart& part);

  bool empty() const { return steps_.empty(); }
  /// The blocks that are fine, and those that are not.
  const Sweep& fine() const { return fine_; }
  const Sweep& others() const { return others_; }
  /// Whether the lattices are.
  bool lattices() const { return !lattices_.empty(); }

  /// mesh.f += f̃ of the fine blocks and ghosts; mesh.f must hold all other forces on the fine nodes, but for
  /// gravity. If the lattices are fine, listed_force += f̃ of their bonds.
  void add_mean_forces(Model& model, const coupling::Reactions& reactions, Vec3 gravity, double dt,
                       Timers& timers);

  /// The kick of the free particles of the fine lattice l by f̃ and gravity; kick as for bond_forces_and_kick,
  /// but for one unit of mass and inertia.
  de::KickSums kick(std::size_t l, Lattice& lattice, const de::Kick& kick, double dt) const;

  int ratio() const { return empty() ? 1 : static_cast<int>(steps_.size()); }

 private:
  template <class F>
  void for_nodes(F f) const;
  void begin(Model& model, Timers& timers);
  void drift_lattices(Model& model, Timers& timers);
  void kick_lattices(Model& model, const Substep& step, Vec3 gravity, double dt);
  void kick_and_drift(Mesh& mesh, const Substep& step, Vec3 gravity, double dt);
  void end(Model& model, Timers& timers);

  std::vector<Substep> steps_;
  Sweep fine_, others_;
  std::vector<std::int32_t> nodes_;  ///< of the fine blocks
  std::vector<std::uint8_t> still_;  ///< by these: bit c is set if component c stands still
  // By these nodes: u^n; the forces of everything else; z_k − z_{k−1}; what f̃ has grown to
  Field<3> u_, rest_, increment_, mean_;
  std::vector<de::ShortSteps> lattices_;  ///< all, or none
};

}  // namespace geist
