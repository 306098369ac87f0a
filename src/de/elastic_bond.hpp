// The connective model's elastic bond: one normal and two tangential springs at the mid-point of a pair.
// Source: (3)–(5) of the journal paper.
//
//   f = K d,  K = diag(k_n, k_s, k_s) in the bond's axes   (3)(4)
//   k_n = 2 E r / (5 (1 − 2ν)),  k_s = 2 E r (1 − 4ν) / (5 (1 − 2ν)(1 + ν)),  groups 1 and 2 alike   (5)
//
// With n the unit vector from i to j: f = k_s d + (k_n − k_s)(d·n) n, and E = ½ f·d. k_s ≥ 0 needs ν ≤ 1/4.
#pragma once
#include "core/pack.hpp"
#include "model/material.hpp"

namespace geist::de {

/// Stiffnesses (force/length) of every bond of a lattice.
struct ElasticBond {
  double k_n = 0, k_s = 0;

  static ElasticBond from(const Material& m, double r) {
    const double E = m.young, nu = m.poisson, k_n = 2 * E * r / (5 * (1 - 2 * nu));
    return {k_n, k_n * (1 - 4 * nu) / (1 + nu)};
  }

  /// Force on i of a bond along n = (ex, ey, ez)/|e| at relative displacement d = d_j − d_i, into f; e is −1,
  /// 0 or 1.
  template <int ex, int ey, int ez, class T>
  GEIST_INLINE void force(const T (&d)[3], T (&f)[3]) const {
    constexpr int e[3] = {ex, ey, ez}, length2 = ex * ex + ey * ey + ez * ez;
    T along = constant<T>(0);
    for (int c = 0; c < 3; ++c)
      if (e[c]) along = e[c] > 0 ? along + d[c] : along - d[c];
    along = along * ((k_n - k_s) / length2);
    for (int c = 0; c < 3; ++c) f[c] = e[c] == 0 ? k_s * d[c] : fma(k_s, d[c], e[c] > 0 ? along : -along);
  }
};

}  // namespace geist::de
