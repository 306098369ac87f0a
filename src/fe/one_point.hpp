// One-point integration with the hourglass control of Flanagan & Belytschko, IJNME 17 (1981) 679–706.
//
// The motions q_k beyond the uniform strain element's (uniform_strain.hpp) are resisted, with γ/√8 of unit
// length, by S γγᵀ/8:
//
//   "one-point": a stiffness, S = ½ κ (λ+2μ) B·B/V, B·B = Σ_a B_a·B_a = 8 Σ_k g_k·g_k. ω² = 8 (λ+2μ)
//   B·B/(ρV²) bounds the uniform strain element's frequencies, S/(ρV/8) is κ/2 of that. Energy ½ (S/8) Σ_k
//   q_k².
//
//   "one-point-viscous": a dashpot on velocities, S = 2 κ ρ c √(⅔ B·B), c² = (λ+2μ)/ρ; ⅔ B·B is the square of
//   a cube's face, as V^⅔ is, where others take 2 κ ρ c V^⅔. It dissipates (S/8) Σ_k q̇_k² and stores nothing:
//   the twelve motions are slowed down, not resisted, so a static load may move them ever further.
//
// κ is dimensionless, 0.05 usual; κ = 0 leaves the bare element.
#pragma once
#include <cmath>
#include <string_view>

#include "fe/uniform_strain.hpp"

namespace geist::fe {

/// √ lane by lane.
GEIST_INLINE double root(double a) { return std::sqrt(a); }
GEIST_INLINE Pack root(Pack a) {
  Pack r;
  for (int l = 0; l < lanes; ++l) r[l] = std::sqrt(a[l]);
  return r;
}

/// Σ_k q_k².
template <class T>
GEIST_INLINE T sum_of_squares(const T (&q)[4][3]) {
  return (dot(q[0], q[0]) + dot(q[1], q[1])) + (dot(q[2], q[2]) + dot(q[3], q[3]));
}

struct OnePoint {
  static constexpr std::string_view name = "one-point";
  static constexpr bool uses_velocity = false;
  static constexpr bool resists_along_q = true;  ///< Q_k is a multiple of q_k
  double lambda, mu, scale;                      ///< scale = ½ κ (λ+2μ); S/8 = scale Σ g·g/V

  explicit OnePoint(const Parameters& p)
      : lambda(p.lambda), mu(p.mu), scale(0.5 * p.hourglass * (p.lambda + 2 * p.mu)) {}

  template <class T>
  GEIST_INLINE T forces(const Corners<T>& X, const Corners<T>& u, const Corners<T>& v, Corners<T>& f) const {
    return one_point_forces(*this, X, u, v, f);
  }

  template <class T>
  GEIST_INLINE T resist(const UniformStrain<T>& e, const T (&q)[4][3], T (&Q)[4][3]) const {
    const T stiffness = scale * e.square() * e.m.inverse_volume;
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < 3; ++i) Q[k][i] = stiffness * q[k][i];
    return constant<T>(0);
  }

  template <class T>
  GEIST_INLINE Stored<T> energy(const Corners<T>& X, const Corners<T>& u) const {
    const UniformStrain<T> e(X);
    const Modes<T> w = to_modes(u);
    T L[3][3], q[4][3];
    mean_of_gradient(e.m, w, L);
    e.hourglass(w, L, q);
    const T stiffness = scale * e.square() * e.m.inverse_volume;
    return {e.m.volume * energy_density(lambda, mu, L), 0.5 * stiffness * sum_of_squares(q)};
  }
};

struct OnePointViscous {
  static constexpr std::string_view name = "one-point-viscous";
  static constexpr bool uses_velocity = true;
  static constexpr bool resists_along_q = false;
  double lambda, mu, scale;  ///< scale = ¼ κ ρ c √(16/3); S/8 = scale √(Σ g·g)

  explicit OnePointViscous(const Parameters& p)
      : lambda(p.lambda), mu(p.mu), scale(p.hourglass * std::sqrt(p.density * (p.lambda + 2 * p.mu) / 3)) {}

  template <class T>
  GEIST_INLINE T forces(const Corners<T>& X, const Corners<T>& u, const Corners<T>& v, Corners<T>& f) const {
    return one_point_forces(*this, X, u, v, f);
  }

  template <class T>
  GEIST_INLINE T resist(const UniformStrain<T>& e, const T (&rate)[4][3], T (&Q)[4][3]) const {
    const T viscosity = scale * root(e.square());
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < 3; ++i) Q[k][i] = viscosity * rate[k][i];
    return viscosity * sum_of_squares(rate);
  }

  template <class T>
  GEIST_INLINE Stored<T> energy(const Corners<T>& X, const Corners<T>& u) const {
    const UniformStrain<T> e(X);
    T L[3][3];
    mean_of_gradient(e.m, to_modes(u), L);
    return {e.m.volume * energy_density(lambda, mu, L), constant<T>(0)};
  }
};

}  // namespace geist::fe
