// Integration over a hexahedron by 2 × 2 × 2 Gauss points, on the modes of modes.hpp.
//
// 8 ∂x/∂ξ = c1 + c6 η + c5 ζ + c7 ηζ (and cyclically) does not depend on ξ, so that the eight points share
// four values along each axis: twelve small sums instead of 8 × 8 × 3 products, and as many to return the
// forces. With
//
//   J' = 8 ∂x/∂ξ,  C = cof J' (its rows C_j = ∂x'/∂ξ_k × ∂x'/∂ξ_l),  Δ = det J' = 512 det J
//   ∂u_α/∂x_β = (1/Δ) Σ_j (8 ∂u_α/∂ξ_j) C_jβ
//   f_a = −Σ_points σ · (∂N_a/∂x) det J = −(1/512) Σ_k h_k(ξ_a) Σ_points Σ_j (∂h_k/∂ξ_j) σ · C_j
//
// one point needs one division and no inverse matrix.
#pragma once
#include "fe/hooke.hpp"
#include "fe/modes.hpp"

namespace geist::fe {

/// 1/√3: the Gauss points' coordinates are ± this.
inline constexpr double gauss_point = 0.57735026918962576451;
/// dV of a Gauss point is Δ times this.
inline constexpr double gauss_volume = 1.0 / 512;

/// A vector for each of three natural axes and each pair of signs of the other two: [axis
/// j][point][component], where bit 0 of `point` is the sign along axis j + 1 and bit 1 that along j + 2.
template <class T>
struct AxisValues {
  T at[3][4][3];
  GEIST_INLINE T* operator()(int axis, int point) { return at[axis][point]; }
  GEIST_INLINE const T* operator()(int axis, int point) const { return at[axis][point]; }
};

/// Which of the four values along an axis belongs to Gauss point s (bits 0–2: signs of ξ, η, ζ).
constexpr int point_on_axis(int s, int axis) {
  return ((s >> ((axis + 1) % 3)) & 1) | (((s >> ((axis + 2) % 3)) & 1) << 1);
}

/// 8 ∂x/∂ξ_j at the Gauss points from the modes of x.
template <class T>
GEIST_INLINE AxisValues<T> natural_gradient(const Modes<T>& c) {
  AxisValues<T> G;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const T a = c[1 + j][i], b = gauss_point * c[4 + (j + 2) % 3][i];
      const T d = gauss_point * c[4 + (j + 1) % 3][i], e = (1.0 / 3) * c[7][i];
      const T below = a - b, above = a + b, d_below = d - e, d_above = d + e;
      G(j, 0)[i] = below - d_below, G(j, 1)[i] = above - d_above;
      G(j, 2)[i] = below + d_below, G(j, 3)[i] = above + d_above;
    }
  return G;
}

/// F_k += Σ_points Σ_j (∂h_k/∂ξ_j) t_j: the transpose of natural_gradient.
template <class T>
GEIST_INLINE void add_transposed(const AxisValues<T>& t, Modes<T>& F) {
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const T s0 = t(j, 0)[i] + t(j, 1)[i], d0 = t(j, 1)[i] - t(j, 0)[i];
      const T s1 = t(j, 2)[i] + t(j, 3)[i], d1 = t(j, 3)[i] - t(j, 2)[i];
      T *b = F[4 + (j + 2) % 3], *d = F[4 + (j + 1) % 3];
      F[1 + j][i] = F[1 + j][i] + (s0 + s1);
      b[i] = fma(gauss_point, d0 + d1, b[i]);
      d[i] = fma(gauss_point, s1 - s0, d[i]);
      F[7][i] = fma(1.0 / 3, d1 - d0, F[7][i]);
    }
}

/// Cofactors C_j, determinant Δ and Δ ∂u/∂x at a Gauss point.
template <class T>
struct GaussPoint {
  T C[3][3], det, L[3][3];
};

template <class T>
GEIST_INLINE GaussPoint<T> gauss_point_values(const AxisValues<T>& x, const AxisValues<T>& u, int s) {
  GaussPoint<T> p;
  const T *x0 = x(0, point_on_axis(s, 0)), *x1 = x(1, point_on_axis(s, 1)), *x2 = x(2, point_on_axis(s, 2));
  const T *u0 = u(0, point_on_axis(s, 0)), *u1 = u(1, point_on_axis(s, 1)), *u2 = u(2, point_on_axis(s, 2));
  cross(x1, x2, p.C[0]);
  cross(x2, x0, p.C[1]);
  cross(x0, x1, p.C[2]);
  p.det = dot(x0, p.C[0]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) p.L[i][j] = fma(u2[i], p.C[2][j], fma(u1[i], p.C[1][j], u0[i] * p.C[0][j]));
  return p;
}

/// F += modal forces of the elastic energy with constants λ, μ, integrated at 2 × 2 × 2 points.
template <class T>
GEIST_INLINE void add_gauss_forces(double lambda, double mu, const Modes<T>& X, const Modes<T>& u,
                                   Modes<T>& F) {
  const AxisValues<T> x = natural_gradient(X), w = natural_gradient(u);
  AxisValues<T> t;
  for (int j = 0; j < 3; ++j)
    for (int p = 0; p < 4; ++p)
      for (int i = 0; i < 3; ++i) t(j, p)[i] = constant<T>(0);
#pragma GCC unroll 8
  for (int s = 0; s < 8; ++s) {
    const GaussPoint<T> p = gauss_point_values(x, w, s);
    T sigma[3][3];
    hooke(-gauss_volume * lambda, -gauss_volume * mu, p.L, sigma);
    const T share = 1.0 / p.det;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) sigma[i][j] = sigma[j][i] = share * sigma[i][j];
    for (int j = 0; j < 3; ++j) {
      T* out = t(j, point_on_axis(s, j));
      for (int i = 0; i < 3; ++i)
        out[i] =
            fma(sigma[i][2], p.C[j][2], fma(sigma[i][1], p.C[j][1], fma(sigma[i][0], p.C[j][0], out[i])));
    }
  }
  add_transposed(t, F);
}

/// Elastic energy with constants λ, μ, integrated at 2 × 2 × 2 points.
template <class T>
GEIST_INLINE T gauss_energy(double lambda, double mu, const Modes<T>& X, const Modes<T>& u) {
  const AxisValues<T> x = natural_gradient(X), w = natural_gradient(u);
  T energy = constant<T>(0);
  for (int s = 0; s < 8; ++s) {
    const GaussPoint<T> p = gauss_point_values(x, w, s);
    energy = energy + gauss_volume * energy_density(lambda, mu, p.L) / p.det;
  }
  return energy;
}

}  // namespace geist::fe
