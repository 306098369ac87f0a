// Full integration: the whole energy at 2 × 2 × 2 Gauss points. It locks in bending (shear) and for ν → ½
// (volume); a baseline to compare with.
#pragma once
#include <string_view>

#include "fe/gauss.hpp"

namespace geist::fe {

/// A formulation is a value: it has the constants of a region and sees one element (T = double) or eight (T =
/// Pack): reference positions X, displacements u and velocities v of the corners, in any frame that it may
/// call its own. A kinematics that turns with the element is therefore a function around it, not another copy
/// of it.
///
///   forces(X, u, v, f)   f = forces ON the nodes, −∂E/∂u and dissipative ones; returns the power dissipated
///   energy(X, u)         E
///
/// If !uses_velocity, v is not read and nothing is dissipated.
struct Full {
  static constexpr std::string_view name = "full";
  static constexpr bool uses_velocity = false;
  double lambda, mu;

  explicit Full(const Parameters& p) : lambda(p.lambda), mu(p.mu) {}

  template <class T>
  GEIST_INLINE T forces(const Corners<T>& X, const Corners<T>& u, const Corners<T>&, Corners<T>& f) const {
    Modes<T> F{};
    add_gauss_forces(lambda, mu, to_modes(X), to_modes(u), F);
    to_corners(F, f);
    return constant<T>(0);
  }

  template <class T>
  GEIST_INLINE Stored<T> energy(const Corners<T>& X, const Corners<T>& u) const {
    return {gauss_energy(lambda, mu, to_modes(X), to_modes(u)), constant<T>(0)};
  }
};

}  // namespace geist::fe
