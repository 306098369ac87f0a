// The 18-neighbour stencil with finite rotations. docs/theory.md, "Finite rotations of the lattice".
//
// R_i is the rotation of particle i, e the step on the grid, r the radius, Δx = 2 r e + u_j − u_i. The arms
// of a pair, r R_i e and r R_j e, meet at the mid-point if the bond is unstrained:
//
//   m = ½ (R_i + R_j) e,   d = Δx − 2 r m,   E = ½ shear d·d + ½ along (d·m)²
//   f = shear d + along (d·m) m                              force on i
//   g = r f − ½ along (d·m) d,   Σ_c (R_i e_c) × (e_c g)     moment on i
//
// the derivatives of E. d and m turn with the frame, so E does not depend on it, and (x_j − x_i) × f is the
// negative of the sum of both moments. Summed over a site's bonds, S_c = Σ e_c g, only three cross products
// are left. Bending and twisting, ½ Σ_c w_c |(R_j − R_i) e_c|², add w_c (R_j − R_i) e_c to S_c.
//
// Fields hold H = R − I: 2m = 2e + h and d = u_j − u_i − r h with h = (H_i + H_j) e, so that small rotations
// lose no digits. Both ends compute the same bits with opposite signs.
#pragma once
#include "de/stencil.hpp"

namespace geist::de {

/// Where the motion of a lattice with finite rotations is read: u, and H column by column.
struct FiniteView {
  const double* u[3];
  const double* H[9];
};

inline FiniteView finite_view(const Lattice& lattice) {
  FiniteView view;
  for (int c = 0; c < 3; ++c) view.u[c] = lattice.motion[c];
  for (int c = 0; c < 9; ++c) view.H[c] = lattice.rotation[c];
  return view;
}

/// The motion of one site, or eight.
template <class T>
struct FiniteMotion {
  T u[3], H[9];
};

template <class T>
GEIST_INLINE FiniteMotion<T> read_motion(const FiniteView& x, std::size_t s) {
  FiniteMotion<T> at;
  for (int c = 0; c < 3; ++c) at.u[c] = read<T>(x.u[c] + s);
  for (int c = 0; c < 9; ++c) at.H[c] = read<T>(x.H[c] + s);
  return at;
}

/// How the pair (i, its neighbour in direction D) is strained: d and p = 2m.
template <int D, class T>
GEIST_INLINE void relative_displacement(const FiniteMotion<T>& i, const FiniteMotion<T>& j, double r,
                                        T (&d)[3], T (&p)[3]) {
  constexpr int e[3] = {directions[D][0], directions[D][1], directions[D][2]};
  constexpr int A = e[0] ? 0 : e[1] ? 1 : 2, B = e[2] ? 2 : e[1] ? 1 : 0;  // the same in group 1
  for (int a = 0; a < 3; ++a) {
    const T first = i.H[3 * A + a] + j.H[3 * A + a];
    const T h =
        A == B ? combine<e[A], 0>(first, first) : combine<e[A], e[B]>(first, i.H[3 * B + a] + j.H[3 * B + a]);
    d[a] = fma(-r, h, j.u[a] - i.u[a]);
    p[a] = e[a] ? h + 2.0 * e[a] : h;
  }
}

/// q = ½ along (d·m) = ¼ along (d·p), so that f = shear d + q p and g = r f − q d.
template <int D, class T, class Law>
GEIST_INLINE T half_pull(const Law& law, const T (&d)[3], const T (&p)[3]) {
  return 0.25 * law.template along<D>() * fma(d[2], p[2], fma(d[1], p[1], d[0] * p[0]));
}

/// Force of all bonds on the site(s) at s into f, and the sums S_c.
template <class T, class Law, class Bonds>
GEIST_INLINE void add_bonds(const FiniteView& x, const FiniteMotion<T>& i, std::size_t s,
                            const std::ptrdiff_t (&offset)[18], const Law& law, double r, Bonds bonds,
                            T (&f)[6], T (&S)[9]) {
  const auto add_bond = [&]<int D>() __attribute__((always_inline)) {
    T d[3], p[3];
    const FiniteMotion<T> j = read_motion<T>(x, s + offset[D]);
    relative_displacement<D>(i, j, r, d, p);
    const T q = half_pull<D>(law, d, p);
    for (int a = 0; a < 3; ++a) {
      T force;
      if constexpr (Law::template shears<D>)
        force = fma(q, p[a], law.template shear<D>() * d[a]);
      else
        force = q * p[a];
      const T g = bonds.template keep<D>(fma(r, force, -(q * d[a])));
      f[a] = f[a] + bonds.template keep<D>(force);
      for (int c = 0; c < 3; ++c)
        if (directions[D][c]) S[3 * c + a] = directions[D][c] > 0 ? S[3 * c + a] + g : S[3 * c + a] - g;
    }
    if constexpr (Law::bends)
      for (int k = 0; group(D) == 1 && k < 9; ++k)
        S[k] = fma(law.template column<D>(k / 3), bonds.template keep<D>(j.H[k] - i.H[k]), S[k]);
  };
  [&]<int... D>(std::integer_sequence<int, D...>) __attribute__((always_inline)) {
    (add_bond.template operator()<D>(), ...);
  }
  (std::make_integer_sequence<int, 18>{});
}

/// Force and moment of all bonds on the site(s) at s.
template <class T, class Law, class Bonds>
GEIST_INLINE void site_force(const FiniteView& x, std::size_t s, const std::ptrdiff_t (&offset)[18],
                             const Law& law, double r, Bonds bonds, T (&f)[6]) {
  const FiniteMotion<T> i = read_motion<T>(x, s);
  T S[9];
  for (T& sum : S) sum = constant<T>(0);
  for (T& sum : f) sum = constant<T>(0);
  add_bonds(x, i, s, offset, law, r, bonds, f, S);
  for (int c = 0; c < 3; ++c) {
    T column[3] = {i.H[3 * c], i.H[3 * c + 1], i.H[3 * c + 2]};
    column[c] = column[c] + 1.0;
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, z = (a + 2) % 3;
      f[3 + a] = fma(column[b], S[3 * c + z], fma(-column[z], S[3 * c + b], f[3 + a]));
    }
  }
}

/// Energy of the bond in direction D at the site(s) at s, as if it existed.
template <int D, class T, class Law>
GEIST_INLINE T bond_energy(const FiniteView& x, std::size_t s, std::ptrdiff_t offset, const Law& law,
                           double r) {
  const FiniteMotion<T> i = read_motion<T>(x, s), j = read_motion<T>(x, s + offset);
  T d[3], p[3];
  relative_displacement<D>(i, j, r, d, p);
  const T dp = d[0] * p[0] + d[1] * p[1] + d[2] * p[2], q = half_pull<D>(law, d, p);
  T twice = q * dp;
  if constexpr (Law::template shears<D>)
    twice = law.template shear<D>() * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) + q * dp;
  if constexpr (Law::bends && group(D) == 1)
    for (int k = 0; k < 9; ++k)
      twice = twice + law.template column<D>(k / 3) * (j.H[k] - i.H[k]) * (j.H[k] - i.H[k]);
  return 0.5 * twice;
}

}  // namespace geist::de
