// The 18-neighbour stencil: kinematics of one bond, and the force and moment of all bonds on a site.
//
// Source: (3)–(5), (19)–(23) of the journal paper in total form. With the pair's directions frozen (small
// displacement) the increments of (22)(23) add up to
//
//   d = (u_j − u_i) − (L/2)(θ_i + θ_j) × n,       L n = 2 r e,  e the step on the grid from i to j,
//
// so d = (u_j − u_i) − r (θ_i + θ_j) × e, and no bond has a history. The force on i is f = K d at the
// mid-point, its moment r e × f (13). Both ends compute the same bits with opposite signs, so momentum is
// kept to round-off.
//
// Symbols: u displacement, θ rotation, r radius, f force, m moment; T is double or Pack (eight sites of a
// row).
#pragma once
#include <cstdint>
#include <utility>

#include "core/pack.hpp"
#include "de/elastic_bond.hpp"
#include "model/lattice.hpp"

namespace geist::de {

/// Where motion is read: six component arrays.
struct MotionView {
  const double* c[6];
};

inline MotionView view(const Field<6>& f) { return {{f[0], f[1], f[2], f[3], f[4], f[5]}}; }

template <class T>
GEIST_INLINE T read(const double* p) {
  if constexpr (std::is_same_v<T, Pack>)
    return load(p);
  else
    return *p;
}

/// a p + b q for a, b in {−1, 0, 1} known to the compiler.
template <int a, int b, class T>
GEIST_INLINE T combine(T p, T q) {
  if constexpr (a == 0 && b == 0)
    return constant<T>(0);
  else if constexpr (b == 0)
    return a > 0 ? p : -p;
  else if constexpr (a == 0)
    return b > 0 ? q : -q;
  else if constexpr (a > 0)
    return b > 0 ? p + q : p - q;
  else
    return b > 0 ? q - p : -(p + q);
}

/// c = p × e
template <int ex, int ey, int ez, class T>
GEIST_INLINE void cross_step(const T (&p)[3], T (&c)[3]) {
  c[0] = combine<ez, -ey>(p[1], p[2]);
  c[1] = combine<ex, -ez>(p[2], p[0]);
  c[2] = combine<ey, -ex>(p[0], p[1]);
}

/// Relative displacement d of the pair (i, its neighbour in direction D) at the mid-point.
template <int D, class T>
GEIST_INLINE void relative_displacement(const T (&i)[6], const T (&j)[6], double r, T (&d)[3]) {
  constexpr int ex = directions[D][0], ey = directions[D][1], ez = directions[D][2];
  const T spin[3] = {i[3] + j[3], i[4] + j[4], i[5] + j[5]};
  T turn[3];
  cross_step<ex, ey, ez>(spin, turn);
  for (int c = 0; c < 3; ++c) d[c] = fma(-r, turn[c], j[c] - i[c]);
  if constexpr (ex != 0 && ey == 0 && ez == 0) d[0] = j[0] - i[0];
  if constexpr (ey != 0 && ex == 0 && ez == 0) d[1] = j[1] - i[1];
  if constexpr (ez != 0 && ex == 0 && ey == 0) d[2] = j[2] - i[2];
}

/// All bonds exist.
struct AllBonds {
  template <int D, class T>
  GEIST_INLINE T keep(T f) const {
    return f;
  }
};

/// Eight sites' bonds by their words: what a missing bond would give is cut to zero, whatever it was.
struct SomeBonds {
  PackInt word;
  template <int D>
  GEIST_INLINE Pack keep(Pack f) const {
    return where_set<D>(word, f);
  }
};

/// One site's bonds by its word.
struct SiteBonds {
  std::uint32_t word;
  template <int D>
  GEIST_INLINE double keep(double f) const {
    return word >> D & 1 ? f : 0.0;
  }
};

/// Force and moment of all bonds on the site(s) at s.
template <class T, class Law, class Bonds>
GEIST_INLINE void site_force(const MotionView& x, std::size_t s, const std::ptrdiff_t (&offset)[18],
                             const Law& law, double r, Bonds bonds, T (&f)[6]) {
  T i[6];
  const double one = hidden_one;
  for (int c = 0; c < 6; ++c) i[c] = read<T>(x.c[c] + s), f[c] = constant<T>(0);
  const auto add_bond = [&]<int D>() __attribute__((always_inline)) {
    constexpr int ex = directions[D][0], ey = directions[D][1], ez = directions[D][2];
    constexpr bool shears = Law::template shears<D>;  // else f is along e: no moment, nothing across
    T j[6], d[3], fc[3], arm[3];
    for (int c = 0; c < 6; ++c) j[c] = read<T>(x.c[c] + s + offset[D]);
    relative_displacement<D>(i, j, r, d);
    bond_force<D>(law, d, fc);
    for (int c = 0; c < 3; ++c) {
      fc[c] = bonds.template keep<D>(fc[c]);
      if (shears || directions[D][c] != 0) f[c] = add_by_fma(one, fc[c], f[c]);
    }
    cross_step<ex, ey, ez>(fc, arm);  // fc × e; the moment is r e × fc
    for (int c = 0; shears && c < 3; ++c) f[3 + c] = f[3 + c] - arm[c];
    if constexpr (Law::bends)  // by itself: the lambda is looked into once Law is known, D not yet
      for (int c = 3; group(D) == 1 && c < 6; ++c)
        f[c] = f[c] + bonds.template keep<D>(law.template turn<D>(c - 3) * (j[c] - i[c]));
  };
  [&]<int... D>(std::integer_sequence<int, D...>) __attribute__((always_inline)) {
    (add_bond.template operator()<D>(), ...);
  }
  (std::make_integer_sequence<int, 18>{});
  for (int c = 3; c < 6; ++c) f[c] = f[c] * r;
}

/// Energy ½ f·d + ½ m·(θ_j − θ_i) of the bond in direction D at the site(s) at s, as if it existed.
template <int D, class T, class Law>
GEIST_INLINE T bond_energy(const MotionView& x, std::size_t s, std::ptrdiff_t offset, const Law& law,
                           double r) {
  T i[6], j[6], d[3], f[3];
  for (int c = 0; c < 6; ++c) i[c] = read<T>(x.c[c] + s), j[c] = read<T>(x.c[c] + s + offset);
  relative_displacement<D>(i, j, r, d);
  bond_force<D>(law, d, f);
  T twice = f[0] * d[0] + f[1] * d[1] + f[2] * d[2];
  if constexpr (Law::bends && group(D) == 1)
    for (int c = 3; c < 6; ++c)
      twice = twice + r * law.template turn<D>(c - 3) * (j[c] - i[c]) * (j[c] - i[c]);
  return 0.5 * twice;
}

}  // namespace geist::de
