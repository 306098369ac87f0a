// Modes of a hexahedron: a field at the eight corners written as a trilinear polynomial, and the mean
// gradient.
//
// What an element computes needs sums and differences over its corners; taken once, in the form of
//
//   c_k = Σ_a h_k(ξ_a) x_a,   h = 1, ξ, η, ζ, ηζ, ζξ, ξη, ξηζ   (k = 0 … 7; h_k(ξ_a) = ±1)
//
// so that x(ξ) = ⅛ Σ_k h_k(ξ) c_k. Forces go back by the transpose, f_a = Σ_k h_k(ξ_a) F_k.
//
// The volume is a polynomial of the c_k, and the uniform gradient of Flanagan & Belytschko, "A uniform strain
// hexahedron and quadrilateral with orthogonal hourglass control", IJNME 17 (1981) 679–706, is its
// derivative:
//
//   64 V = c1·(c2×c3) + ⅓ [c1·(c6×c5) + c6·(c2×c4) + c5·(c4×c3)]
//   g_k = ∂V/∂c_k,   B_a = ∫ ∂N_a/∂x dV = ∂V/∂x_a = Σ_k h_k(ξ_a) g_k        (no c7, so g7 = 0; g0 = 0)
//   mean of ∂u/∂x = (1/V) Σ_a u_a ⊗ B_a = (1/V) Σ_k û_k ⊗ g_k                û: the modes of u
//
// It is exact on every element with plane or twisted faces, and equal to 2 × 2 × 2 Gauss integration.
#pragma once
#include "core/triple.hpp"

namespace geist::fe {

/// A vector at each corner: [corner][component].
template <class T>
struct Corners {
  T at[8][3];
  GEIST_INLINE T* operator[](int a) { return at[a]; }
  GEIST_INLINE const T* operator[](int a) const { return at[a]; }
};

/// A vector for each mode: [k][component].
template <class T>
struct Modes {
  T at[8][3];
  GEIST_INLINE T* operator[](int k) { return at[k]; }
  GEIST_INLINE const T* operator[](int k) const { return at[k]; }
};

/// c_k = Σ_a h_k(ξ_a) x_a.
template <class T>
GEIST_INLINE Modes<T> to_modes(const Corners<T>& x) {
  Modes<T> c;
  for (int i = 0; i < 3; ++i) {
    // sums s and differences d along ξ; then along η, below (b) and above (t); then along ζ
    const T s0 = x[0][i] + x[1][i], d0 = x[1][i] - x[0][i], s1 = x[3][i] + x[2][i], d1 = x[2][i] - x[3][i];
    const T s2 = x[4][i] + x[5][i], d2 = x[5][i] - x[4][i], s3 = x[7][i] + x[6][i], d3 = x[6][i] - x[7][i];
    const T one_b = s0 + s1, eta_b = s1 - s0, xi_b = d0 + d1, xieta_b = d1 - d0;
    const T one_t = s2 + s3, eta_t = s3 - s2, xi_t = d2 + d3, xieta_t = d3 - d2;
    c[0][i] = one_t + one_b, c[3][i] = one_t - one_b;
    c[1][i] = xi_t + xi_b, c[5][i] = xi_t - xi_b;
    c[2][i] = eta_t + eta_b, c[4][i] = eta_t - eta_b;
    c[6][i] = xieta_t + xieta_b, c[7][i] = xieta_t - xieta_b;
  }
  return c;
}

/// f_a = Σ_k h_k(ξ_a) F_k without k = 0: the forces of an element on its nodes add up to zero.
template <class T>
GEIST_INLINE void to_corners(const Modes<T>& F, Corners<T>& f) {
  for (int i = 0; i < 3; ++i) {
    const T xi_b = F[1][i] - F[5][i], eta_b = F[2][i] - F[4][i], xieta_b = F[6][i] - F[7][i];
    const T xi_t = F[1][i] + F[5][i], eta_t = F[2][i] + F[4][i], xieta_t = F[6][i] + F[7][i];
    const T s0 = eta_b + F[3][i], s1 = eta_b - F[3][i], s2 = F[3][i] - eta_t, s3 = F[3][i] + eta_t;
    const T d0 = xi_b - xieta_b, d1 = xi_b + xieta_b, d2 = xi_t - xieta_t, d3 = xi_t + xieta_t;
    f[0][i] = -s0 - d0, f[1][i] = d0 - s0, f[2][i] = s1 + d1, f[3][i] = s1 - d1;
    f[4][i] = s2 - d2, f[5][i] = s2 + d2, f[6][i] = s3 + d3, f[7][i] = s3 - d3;
  }
}

/// Volume V and its derivatives g_k with respect to the modes (see above); g[0] and g[7] are not set.
template <class T>
struct MeanGradient {
  Modes<T> g;
  T volume, inverse_volume;
};

template <class T>
GEIST_INLINE MeanGradient<T> mean_gradient(const Modes<T>& c) {
  MeanGradient<T> m;
  constexpr double third = 1.0 / 3, scale = 1.0 / 64;
  for (int i = 0; i < 3;
       ++i) {  // axes i, j, k in cyclic order; c[4 + i] is the mode of axes j and k together
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    T a[3], b[3];
    cross(c[1 + j], c[1 + k], a);
    cross(c[4 + k], c[4 + j], b);
    for (int d = 0; d < 3; ++d) m.g[1 + i][d] = scale * fma(third, b[d], a[d]);
    cross(c[4 + k], c[1 + j], a);
    cross(c[1 + k], c[4 + j], b);
    for (int d = 0; d < 3; ++d) m.g[4 + i][d] = (scale * third) * (a[d] + b[d]);
  }
  m.volume = c[1][0] * m.g[1][0];
  for (int k = 2; k < 7; ++k) m.volume = fma(c[k][0], m.g[k][0], m.volume);
  m.inverse_volume = 1.0 / m.volume;
  return m;
}

/// Mean of ∂u_i/∂x_j over the element, L[i][j], from the modes of u.
template <class T>
GEIST_INLINE void mean_of_gradient(const MeanGradient<T>& m, const Modes<T>& u, T (&L)[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      T s = u[1][i] * m.g[1][j];
      for (int k = 2; k < 7; ++k) s = fma(u[k][i], m.g[k][j], s);
      L[i][j] = s * m.inverse_volume;
    }
}

}  // namespace geist::fe
