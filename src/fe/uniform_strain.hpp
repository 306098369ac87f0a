// The uniform strain hexahedron of Flanagan & Belytschko, IJNME 17 (1981) 679–706, on which one-point
// elements are built.
//
// Stress from the mean gradient (modes.hpp), E = V w(L). It leaves twelve motions without energy; what the
// four patterns h_k = ηζ, ζξ, ξη, ξηζ do beyond a linear field is measured by
//
//   q_k = γ_k · u = û_k − L c_k,   γ_ka = h_k(ξ_a) − (1/V) c_k · B_a        zero for every linear field
//
// so that whatever resists the q_k alone passes the patch test and is orthogonal to rigid and linear motions.
#pragma once
#include "fe/hooke.hpp"
#include "fe/modes.hpp"

namespace geist::fe {

/// What all one-point elements share.
template <class T>
struct UniformStrain {
  Modes<T> x;  ///< modes c_k of X
  MeanGradient<T> m;

  GEIST_INLINE explicit UniformStrain(const Corners<T>& X) : x(to_modes(X)), m(mean_gradient(x)) {}

  /// Σ_k g_k·g_k = B·B/8.
  GEIST_INLINE T square() const {
    T s = dot(m.g[1], m.g[1]);
    for (int k = 2; k < 7; ++k) s = s + dot(m.g[k], m.g[k]);
    return s;
  }

  /// q[k − 4] = û_k − L c_k for the hourglass patterns k = 4 … 7.
  GEIST_INLINE void hourglass(const Modes<T>& u, const T (&L)[3][3], T (&q)[4][3]) const {
    for (int k = 4; k < 8; ++k)
      for (int i = 0; i < 3; ++i) q[k - 4][i] = u[k][i] - dot(L[i], x[k]);
  }

  /// Forces on the corners of a stress σ and of hourglass resistances Q_k: F_k = −σ g_k − Q·γ.
  GEIST_INLINE void forces(const T (&sigma)[3][3], const T (&Q)[4][3], Corners<T>& f) const {
    T P[3][3];  // (1/V) Σ Q_k ⊗ c_k − σ
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        T s = Q[0][i] * x[4][j];
        for (int k = 1; k < 4; ++k) s = fma(Q[k][i], x[4 + k][j], s);
        P[i][j] = fma(s, m.inverse_volume, -sigma[i][j]);
      }
    Modes<T> F;
    for (int i = 0; i < 3; ++i) {
      for (int k = 1; k < 7; ++k) F[k][i] = dot(P[i], m.g[k]);
      for (int k = 4; k < 7; ++k) F[k][i] = F[k][i] - Q[k - 4][i];
      F[7][i] = -Q[3][i];
    }
    to_corners(F, f);
  }
};

/// A formulation of this kind: law.resist(e, q, Q) sets the resistances Q to q, or to the rates of q if it
/// uses velocities, and returns the power dissipated.
template <class Law>
concept OnePointLaw = requires(const Law& law, const UniformStrain<double>& e, double (&q)[4][3]) {
  law.resist(e, q, q);
};

/// Formulation::forces() of such a law.
template <class Law, class T>
GEIST_INLINE T one_point_forces(const Law& law, const Corners<T>& X, const Corners<T>& u, const Corners<T>& v,
                                Corners<T>& f) {
  const UniformStrain<T> e(X);
  const Modes<T> w = to_modes(u);
  T L[3][3], sigma[3][3], q[4][3], Q[4][3];
  mean_of_gradient(e.m, w, L);
  hooke(law.lambda, law.mu, L, sigma);
  if constexpr (Law::uses_velocity) {
    const Modes<T> rate = to_modes(v);
    mean_of_gradient(e.m, rate, L);
    e.hourglass(rate, L, q);
  } else {
    e.hourglass(w, L, q);
  }
  const T power = law.resist(e, q, Q);
  e.forces(sigma, Q, f);
  return power;
}

}  // namespace geist::fe
