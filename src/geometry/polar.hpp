// The rotation in a deformation gradient: F = R U, R orthogonal, U symmetric and positive definite.
//
// Newton's iteration of Higham, SIAM J. Sci. Stat. Comput. 7 (1986) 1160–1174,
//
//   R ← ½ (R + R⁻ᵀ),   R⁻ᵀ = cof R / det R,   from R = F
//
// leaves the rotation alone, however large, and takes every principal stretch σ to ½ (σ + 1/σ): a step s is
// followed by one of about ½ s². Stretches of 1.0001, 1.01 and 1.5 take two, three and five steps. What has
// no positive determinant has no rotation: the result is then not a number.
#pragma once
#include <limits>

#include "core/triple.hpp"

namespace geist {

/// Any lane of a mask?
GEIST_INLINE bool any(bool a) { return a; }
GEIST_INLINE bool any(PackInt a) {
  for (int half = lanes / 2; half > 0; half /= 2)
    for (int l = 0; l < half; ++l) a[l] |= a[l + half];
  return a[0];
}

/// ½ R⁻ᵀ − ½ R; returns the sum of its squares. Not a number if det R ≤ 0.
template <class T>
GEIST_INLINE T newton_step(const T (&R)[3][3], T (&step)[3][3]) {
  cross(R[1], R[2], step[0]);
  cross(R[2], R[0], step[1]);
  cross(R[0], R[1], step[2]);
  const T det = dot(R[0], step[0]), nan = constant<T>(std::numeric_limits<double>::quiet_NaN());
  const T share = det > constant<T>(0) ? 0.5 / det : nan;
  T square = constant<T>(0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      step[i][j] = fma(share, step[i][j], -0.5 * R[i][j]);
      square = fma(step[i][j], step[i][j], square);
    }
  return square;
}

/// R of F = R U to rounding. A lane that has arrived stays as it is, so that no element depends on the others
/// of its block.
template <class T>
GEIST_INLINE void rotation_of(const T (&F)[3][3], T (&R)[3][3]) {
  constexpr int most_steps = 40;          // enough for stretches down to 10⁻¹⁰
  constexpr double small_square = 1e-16;  // then the next step would be ½·10⁻¹⁶
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) R[i][j] = F[i][j];
  T last = constant<T>(1);
  for (int n = 0; n < most_steps; ++n) {
    const auto on_the_way = last > constant<T>(small_square);
    if (!any(on_the_way)) return;
    T step[3][3];
    const T square = newton_step(R, step);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) R[i][j] = on_the_way ? R[i][j] + step[i][j] : R[i][j];
    last = on_the_way ? square : last;
  }
}

}  // namespace geist
