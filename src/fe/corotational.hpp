// Finite rotations: any formulation of small displacement, in axes that turn with the element.
//
// The element's rotation is that of its mean deformation gradient,
//
//   F = 1 + (1/V) Σ_a u_a ⊗ B_a = R U      (B_a: modes.hpp)
//
// In axes turned by R its corners are at x̂_a = Rᵀ (x_a − x_0), x = X + u, and
//
//   û_a = x̂_a − (X_a − X_0),   E(x) = Ê(û),   f̂_a = −∂Ê/∂û_a
//
// where Ê is the formulation's energy. A rotation of x turns R and leaves û, so E is indifferent to the
// frame; strains should be moderate, rotations may be any. (Felippa & Haugen, CMAME 194 (2005) 2285–2335, for
// co-rotational elements in general; Moita & Crisfield, IJNME 39 (1996) 3775–3792, take R from the polar
// decomposition at the centre of a hexahedron. The mean has no preferred corner.)
//
// Forces are the exact derivatives of E, so R varies, too. With Rᵀ δR = [w]× and δF = Σ δx_a ⊗ B_a/V, the
// skew part of Rᵀ δF = [w]× U + δU is
//
//   (tr U 1 − U) w = axial(Rᵀ δF − δFᵀ R)                                                           (*)
//   δû_a = Rᵀ δx_a − w × x̂_a
//   δE = −Σ f̂_a · Rᵀ δx_a + w · m,   m = Σ x̂_a × f̂_a
//   f_a = −∂E/∂x_a = R (f̂_a − s × B_a/V),   (tr U 1 − U) s = m
//
// The term with s takes the moment out again: Σ x̂_a × (s × B_a/V) = (tr U 1 − U) s = m. So linear and angular
// momentum about present positions are kept. tr U 1 − U has the sums of two principal stretches for
// eigenvalues and is never near singular.
//
// One-point elements (uniform_strain.hpp) need no turned corners. In their axes the mean of ∂û/∂x is U − 1;
// γ_k sees no linear field; and σ̂ has no moment, as it has the axes of U:
//
//   σ̂ = σ(U − 1),   q̂_k = γ_k · û = Rᵀ q_k,   m = −Σ q̂_k × Q̂_k          q_k = γ_k · u
//
// The term with s is what a skew stress would give: the forces are those of the stress R (σ̂ + [s]×) and the
// resistances R Q̂_k on the element as it was. Where Q̂_k is a multiple of q̂_k, as in one_point.hpp with a
// stiffness, m = 0 exactly, and the stress is all that turns.
//
// What resists velocities sees the rate of û, Rᵀ v_a − w × x̂_a with w of (*) for δx = v: nothing in a rigid
// spin, and f · v is what f̂ dissipates.
#pragma once
#include "fe/full.hpp"
#include "fe/uniform_strain.hpp"
#include "geometry/polar.hpp"

namespace geist::fe {

/// Mean deformation gradient F from the modes of u.
template <class T>
GEIST_INLINE void mean_deformation(const MeanGradient<T>& m, const Modes<T>& u, T (&F)[3][3]) {
  mean_of_gradient(m, u, F);
  for (int i = 0; i < 3; ++i) F[i][i] = F[i][i] + 1.0;
}

/// Rotation and stretch of an element's mean deformation.
template <class T>
struct TurningAxes {
  T R[3][3], U[3][3];

  GEIST_INLINE TurningAxes(const MeanGradient<T>& mean, const Modes<T>& u) {
    T F[3][3];
    mean_deformation(mean, u, F);
    rotation_of(F, R);
    turned_in(F, U);
  }
  GEIST_INLINE TurningAxes(const Corners<T>& X, const Corners<T>& u)
      : TurningAxes(mean_gradient(to_modes(X)), to_modes(u)) {}

  /// out = Rᵀ a.
  GEIST_INLINE void into(const T* a, T* out) const {
    for (int i = 0; i < 3; ++i) out[i] = fma(R[2][i], a[2], fma(R[1][i], a[1], R[0][i] * a[0]));
  }

  /// out = Rᵀ A.
  GEIST_INLINE void turned_in(const T (&A)[3][3], T (&out)[3][3]) const {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) out[i][j] = fma(R[2][i], A[2][j], fma(R[1][i], A[1][j], R[0][i] * A[0][j]));
  }

  /// out = R A.
  GEIST_INLINE void turned_out(const T (&A)[3][3], T (&out)[3][3]) const {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) out[i][j] = fma(R[i][2], A[2][j], fma(R[i][1], A[1][j], R[i][0] * A[0][j]));
  }

  /// Stress of the stretch, σ(U − 1).
  GEIST_INLINE void stress(double lambda, double mu, T (&sigma)[3][3]) const {
    T L[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) L[i][j] = i == j ? U[i][i] - 1.0 : U[i][j];
    hooke(lambda, mu, L, sigma);
  }

  /// Positions x̂ and displacements û of the corners.
  GEIST_INLINE void positions(const Corners<T>& X, const Corners<T>& u, Corners<T>& x, Corners<T>& w) const {
    for (int a = 0; a < 8; ++a) {
      T reference[3], present[3];
      for (int i = 0; i < 3; ++i) {
        reference[i] = X[a][i] - X[0][i];
        present[i] = reference[i] + (u[a][i] - u[0][i]);
      }
      into(present, x[a]);
      for (int i = 0; i < 3; ++i) w[a][i] = x[a][i] - reference[i];
    }
  }

  /// w of (tr U 1 − U) w = a.
  GEIST_INLINE void solve(const T (&a)[3], T (&w)[3]) const {
    T G[3][3], C[3][3];
    const T trace = U[0][0] + U[1][1] + U[2][2];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) G[i][j] = i == j ? trace - U[i][i] : -U[i][j];
    cross(G[1], G[2], C[0]);
    cross(G[2], G[0], C[1]);
    cross(G[0], G[1], C[2]);
    const T share = 1.0 / dot(G[0], C[0]);
    for (int i = 0; i < 3; ++i) w[i] = share * dot(C[i], a);
  }

  /// w of (*) from the mean gradient of velocities.
  GEIST_INLINE void spin(const T (&L)[3][3], T (&w)[3]) const {
    T A[3][3];
    turned_in(L, A);
    const T axial[3] = {A[2][1] - A[1][2], A[0][2] - A[2][0], A[1][0] - A[0][1]};
    solve(axial, w);
  }

  /// Rates Rᵀ v − w × x̂ of û.
  GEIST_INLINE void rates(const MeanGradient<T>& mean, const Corners<T>& x, const Corners<T>& v,
                          Corners<T>& rate) const {
    T L[3][3], w[3], arm[3];
    mean_of_gradient(mean, to_modes(v), L);
    spin(L, w);
    for (int a = 0; a < 8; ++a) {
      into(v[a], rate[a]);
      cross(w, x[a], arm);
      for (int i = 0; i < 3; ++i) rate[a][i] = rate[a][i] - arm[i];
    }
  }

  /// f̂ → f = R (f̂ − s × B/V).
  GEIST_INLINE void turn_out(const MeanGradient<T>& mean, const Corners<T>& x, Corners<T>& f) const {
    T m[3], s[3], arm[3];
    cross(x[1], f[1], m);
    for (int a = 2; a < 8; ++a) {  // x̂_0 = 0
      cross(x[a], f[a], arm);
      for (int i = 0; i < 3; ++i) m[i] = m[i] + arm[i];
    }
    for (T& i : m) i = mean.inverse_volume * i;
    solve(m, s);
    Modes<T> F;
    for (int k = 1; k < 7; ++k) cross(mean.g[k], s, F[k]);
    for (int i = 0; i < 3; ++i) F[7][i] = constant<T>(0);
    Corners<T> turning;
    to_corners(F, turning);
    for (int a = 0; a < 8; ++a) {
      T g[3];
      for (int i = 0; i < 3; ++i) g[i] = f[a][i] + turning[a][i];
      for (int i = 0; i < 3; ++i) f[a][i] = dot(R[i], g);
    }
  }
};

/// Rates Rᵀ γ_k · v − w × q̂_k of the q̂_k.
template <class T>
GEIST_INLINE void turned_rates(const UniformStrain<T>& e, const TurningAxes<T>& axes, const T (&q)[4][3],
                               const Corners<T>& v, T (&rate)[4][3]) {
  const Modes<T> modes = to_modes(v);
  T L[3][3], w[3], own[4][3], arm[3];
  mean_of_gradient(e.m, modes, L);
  axes.spin(L, w);
  e.hourglass(modes, L, own);
  for (int k = 0; k < 4; ++k) {
    axes.into(own[k], rate[k]);
    cross(w, q[k], arm);
    for (int i = 0; i < 3; ++i) rate[k][i] = rate[k][i] - arm[i];
  }
}

/// σ̂ ← σ̂ + [s]×, which takes out the moment m = −Σ q̂_k × Q̂_k.
template <class T>
GEIST_INLINE void balance_moment(const UniformStrain<T>& e, const TurningAxes<T>& axes, const T (&q)[4][3],
                                 const T (&Q)[4][3], T (&sigma)[3][3]) {
  T m[3], s[3], arm[3];
  cross(Q[0], q[0], m);
  for (int k = 1; k < 4; ++k) {
    cross(Q[k], q[k], arm);
    for (int i = 0; i < 3; ++i) m[i] = m[i] + arm[i];
  }
  for (T& i : m) i = e.m.inverse_volume * i;
  axes.solve(m, s);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sigma[k][j] = sigma[k][j] + s[i], sigma[j][k] = sigma[j][k] - s[i];
  }
}

/// Q_k = R Q̂_k of the q̂_k = Rᵀ q_k, and what they add to σ̂. Returns the power dissipated.
template <class Law, class T>
GEIST_INLINE T turned_resistance(const Law& law, const UniformStrain<T>& e, const TurningAxes<T>& axes,
                                 const T (&q)[4][3], const Corners<T>& v, T (&sigma)[3][3], T (&Q)[4][3]) {
  T turned[4][3], rate[4][3], resisting[4][3];
  for (int k = 0; k < 4; ++k) axes.into(q[k], turned[k]);
  if constexpr (Law::uses_velocity) turned_rates(e, axes, turned, v, rate);
  const T power = law.resist(e, Law::uses_velocity ? rate : turned, resisting);
  balance_moment(e, axes, turned, resisting, sigma);
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i) Q[k][i] = dot(axes.R[i], resisting[k]);
  return power;
}

/// Forces of a one-point law that turns with the element.
template <class Law, class T>
GEIST_INLINE T turning_one_point_forces(const Law& law, const Corners<T>& X, const Corners<T>& u,
                                        const Corners<T>& v, Corners<T>& f) {
  const UniformStrain<T> e(X);
  const Modes<T> w = to_modes(u);
  const TurningAxes<T> axes(e.m, w);
  T L[3][3], sigma[3][3], P[3][3], q[4][3], Q[4][3], power;
  mean_of_gradient(e.m, w, L);
  e.hourglass(w, L, q);
  axes.stress(law.lambda, law.mu, sigma);
  if constexpr (Law::resists_along_q)
    power = law.resist(e, q, Q);
  else
    power = turned_resistance(law, e, axes, q, v, sigma, Q);
  axes.turned_out(sigma, P);
  e.forces(P, Q, f);
  return power;
}

/// The formulation `law`, turning with the element.
template <class Formulation>
struct Corotational {
  static constexpr bool uses_velocity = Formulation::uses_velocity;
  Formulation law;

  template <class T>
  GEIST_INLINE T forces(const Corners<T>& X, const Corners<T>& u, const Corners<T>& v, Corners<T>& f) const {
    if constexpr (OnePointLaw<Formulation>)
      return turning_one_point_forces(law, X, u, v, f);
    else
      return turned_forces(X, u, v, f);
  }

  template <class T>
  GEIST_INLINE Stored<T> energy(const Corners<T>& X, const Corners<T>& u) const {
    Corners<T> x, w;
    TurningAxes<T>(X, u).positions(X, u, x, w);
    return law.energy(X, w);
  }

 private:
  template <class T>
  GEIST_INLINE T turned_forces(const Corners<T>& X, const Corners<T>& u, const Corners<T>& v,
                               Corners<T>& f) const {
    const MeanGradient<T> mean = mean_gradient(to_modes(X));
    const TurningAxes<T> axes(mean, to_modes(u));
    Corners<T> x, w, rate;
    axes.positions(X, u, x, w);
    if constexpr (uses_velocity) axes.rates(mean, x, v, rate);
    const T power = law.forces(X, w, uses_velocity ? rate : w, f);
    axes.turn_out(mean, x, f);
    return power;
  }
};

/// Stress in global axes of a mean stretch U and rotation R: R σ(U − 1) Rᵀ. This is the stress on areas of
/// the undeformed element, turned; Cauchy's differs from it by the order of the strain.
template <class T>
GEIST_INLINE void turned_stress(double lambda, double mu, const TurningAxes<T>& axes, T (&sigma)[3][3]) {
  T S[3][3], RS[3][3];
  axes.stress(lambda, mu, S);
  axes.turned_out(S, RS);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sigma[i][j] = dot(RS[i], axes.R[j]);
}

}  // namespace geist::fe
