// Assumed strain: one-point integration, stabilised by the material and the element's shape alone. Exact in
// bending, no locking for ν → ½, no coefficient.
//
// It is the element with twelve enhanced strains of Simo, Armero & Taylor, CMAME 110 (1993) 359–386 (the
// incompatible modes 1 − ξ_j² of Taylor, Beresford & Wilson, IJNME 10 (1976) 1211–1219, and a dilatation with
// each of ηζ, ζξ, ξη), taken on the parallelepiped of the centre's Jacobian as Puso, IJNME 49 (2000)
// 1029–1064, does, and condensed by hand. (Belytschko & Bindeman, CMAME 105 (1993) 225–260, assume such
// strains instead of deriving them.) To the uniform strain element's V w(L) it adds the energy of what its q
// (uniform_strain.hpp) strain. With q_1, q_2, q_3 for the patterns ηζ, ζξ, ξη, edges c_j, reciprocal axes aʲ
// and (n, i, j) cyclic that is
//
//   ⅛ sym [ Σ_n ξ_n (q_j ⊗ aⁱ + q_i ⊗ aʲ) + q_7 ⊗ (ηζ a¹ + ζξ a² + ξη a³) ]
//
// whose terms do not work on each other.
//
// Linear terms: the incompatible mode −2 ξ_n α ⊗ aⁿ with free α relieves all traction on the plane across aⁿ;
// plane stress in the plane of c_i and c_j is left. With metric M_ab = c_a·c_b, D = M_ii M_jj − M_ij², and
// strains along the edges e_ii = q_j·c_i, e_jj = q_i·c_j, 2 e_ij = q_i·c_i + q_j·c_j,
//
//   E_n = V/3 [½ E' t² − 2 μ det e/D],   t = (M_jj e_ii + M_ii e_jj − 2 M_ij e_ij)/D,   E' = E/(1 − ν²)
//
// Bilinear terms: a free dilatation with each relieves the pressure, the deviator is left; ⅛ aʲ is g_j/V, so
//
//   E_7 = μ/(18 V) [|q_7|² Σ g_j·g_j + ⅓ Σ (q_7·g_j)²]
//
// All of these are invariants: no axes of the element's own are needed, and neither a rotation nor another
// order of the corners changes the result but for rounding. E_n and E_7 are energies of strain; together they
// vanish only with q = 0.
#pragma once
#include <string_view>

#include "fe/uniform_strain.hpp"

namespace geist::fe {

struct AssumedStrain {
  static constexpr std::string_view name = "assumed-strain";
  static constexpr bool uses_velocity = false;
  static constexpr bool resists_along_q = false;
  double lambda, mu, plane;  ///< plane = E/(1 − ν²) = 4 μ (λ+μ)/(λ+2μ)

  explicit AssumedStrain(const Parameters& p)
      : lambda(p.lambda), mu(p.mu), plane(4 * p.mu * (p.lambda + p.mu) / (p.lambda + 2 * p.mu)) {}

  template <class T>
  GEIST_INLINE T forces(const Corners<T>& X, const Corners<T>& u, const Corners<T>& v, Corners<T>& f) const {
    return one_point_forces(*this, X, u, v, f);
  }

  /// Q_k = ∂(ΣE_n + E_7)/∂q_k.
  template <class T>
  GEIST_INLINE T resist(const UniformStrain<T>& e, const T (&q)[4][3], T (&Q)[4][3]) const {
    const auto* const c = &e.x.at[1];
    T along[3][3];  // Q_m = Σ_a along[m][a] c_a
    linear_terms(c, e.m.volume, q, along);
    for (int m = 0; m < 3; ++m)
      for (int d = 0; d < 3; ++d)
        Q[m][d] = fma(along[m][2], c[2][d], fma(along[m][1], c[1][d], along[m][0] * c[0][d]));
    bilinear_terms(&e.m.g.at[1], e.m.inverse_volume, q[3], Q[3]);
    return constant<T>(0);
  }

  template <class T>
  GEIST_INLINE Stored<T> energy(const Corners<T>& X, const Corners<T>& u) const {
    const UniformStrain<T> e(X);
    const Modes<T> w = to_modes(u);
    T L[3][3], q[4][3], Q[4][3];
    mean_of_gradient(e.m, w, L);
    e.hourglass(w, L, q);
    resist(e, q, Q);
    const T twice = (dot(Q[0], q[0]) + dot(Q[1], q[1])) + (dot(Q[2], q[2]) + dot(Q[3], q[3]));
    return {fma(e.m.volume, energy_density(lambda, mu, L), 0.5 * twice), constant<T>(0)};
  }

 private:
  /// Derivatives of Σ E_n with respect to q_m·c_a, from the edges c.
  template <class T>
  GEIST_INLINE void linear_terms(const T (*c)[3], const T& volume, const T (&q)[4][3],
                                 T (&along)[3][3]) const {
    const T M[3] = {dot(c[0], c[0]), dot(c[1], c[1]), dot(c[2], c[2])};
    const T twist[3] = {dot(q[0], c[0]), dot(q[1], c[1]), dot(q[2], c[2])};
    const T share = (1.0 / 3) * volume;
    T shear[3];
    for (int n = 0; n < 3; ++n) {
      const int i = (n + 1) % 3, j = (n + 2) % 3;
      const T M_ij = dot(c[i], c[j]), per_area = 1.0 / fma(M[i], M[j], -(M_ij * M_ij));
      const T e_ii = dot(q[j], c[i]), e_jj = dot(q[i], c[j]), twice_e_ij = twist[i] + twist[j];
      const T t = per_area * fma(M[j], e_ii, fma(M[i], e_jj, -(M_ij * twice_e_ij)));
      const T weight = share * per_area, p = plane * weight * t, m = (2 * mu) * weight;
      along[j][i] = fma(p, M[j], -(m * e_jj));
      along[i][j] = fma(p, M[i], -(m * e_ii));
      shear[n] = fma(0.5 * m, twice_e_ij, -(p * M_ij));
    }
    for (int n = 0; n < 3; ++n) along[n][n] = shear[(n + 1) % 3] + shear[(n + 2) % 3];
  }

  /// Derivative of E_7, from the mean gradients g.
  template <class T>
  GEIST_INLINE void bilinear_terms(const T (*g)[3], const T& inverse_volume, const T (&q)[3],
                                   T (&Q)[3]) const {
    const T square = dot(g[0], g[0]) + dot(g[1], g[1]) + dot(g[2], g[2]);
    const T stiffness = (mu / 9) * inverse_volume;
    const T s[3] = {(1.0 / 3) * dot(q, g[0]), (1.0 / 3) * dot(q, g[1]), (1.0 / 3) * dot(q, g[2])};
    for (int d = 0; d < 3; ++d)
      Q[d] = stiffness * fma(s[2], g[2][d], fma(s[1], g[1][d], fma(s[0], g[0][d], square * q[d])));
  }
};

}  // namespace geist::fe
