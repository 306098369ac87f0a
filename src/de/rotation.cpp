#include "de/rotation.hpp"

#include <cmath>

#include "core/parallel.hpp"
#include "de/drift.hpp"

namespace geist::de {
namespace {

/// Where cos α < 0, the axis is better known from R + Rᵀ = 2 cos α I + 2 (1 − cos α) n nᵀ; of its columns the
/// longest, on the side of `about`.
Vec3 axis_of(const Mat3& R, double cosine, Vec3 about) {
  Vec3 longest;
  for (std::size_t c = 0; c < 3; ++c) {
    Vec3 column;
    for (std::size_t a = 0; a < 3; ++a) column[a] = R[a][c] + R[c][a] - (a == c ? 2 * cosine : 0);
    if (dot(column, column) > dot(longest, longest)) longest = column;
  }
  return (dot(longest, about) < 0 ? -1 : 1) / norm(longest) * longest;
}

}  // namespace

void turn(Lattice& lattice, double dt) {
  for_each(
      lattice.grid.size() / lanes, [turn = Turn(lattice, dt)](std::size_t pack) { turn(lanes * pack); }, 512);
}

Mat3 rotation_matrix(const Lattice& lattice, std::size_t s) {
  Mat3 R;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t a = 0; a < 3; ++a)
      R[a][c] = lattice.rotation[static_cast<int>(3 * c + a)][s] + (a == c ? 1 : 0);
  return R;
}

Vec3 rotation_vector(const Lattice& lattice, std::size_t s) {
  if (lattice.kinematics == Kinematics::small) return lattice.motion.vector(s, 3);
  const auto H = [&](int a, int c) { return lattice.rotation[3 * c + a][s]; };
  const Vec3 about = 0.5 * Vec3{H(2, 1) - H(1, 2), H(0, 2) - H(2, 0), H(1, 0) - H(0, 1)};  // n sin α
  const double cosine = 1 + 0.5 * (H(0, 0) + H(1, 1) + H(2, 2)), sine = norm(about);
  const double angle = std::atan2(sine, cosine);
  if (cosine < 0) return angle * axis_of(rotation_matrix(lattice, s), cosine, about);
  return sine > 0 ? angle / sine * about : Vec3{};
}

}  // namespace geist::de
