// Finite rotations against increments: the published algorithm (19)–(23) with axes that turn with the pair.
//
// The paper adds up Δd = Δt v_c in the axes n, s, t of a pair, v_c the relative velocity at the mid-point of
// the two centres, and leaves open how the axes turn. Here n follows the centres and s, t turn about it with
// the mean spin. The total form needs no axes. Both are objective and the same to first order in the strain
// (displacements by 2r, relative rotations): what they differ by is of second order, whatever the common
// rotation, once Δt is small enough.
#include <gtest/gtest.h>

#include <cmath>

#include "de/elastic_bond.hpp"
#include "de/support.hpp"

namespace geist::de {
namespace {

using namespace testing;

/// Where a particle is, and how turned.
struct Pose {
  Vec3 x;
  Mat3 R;
};

/// Rigid motion of more than a radian about changing axes, and beside it a deformation of size `strain` that
/// comes and partly goes.
struct Path {
  Vec3 X_i, X_j;
  double strain;

  Mat3 common(double t) const {
    return rotation_by(t * t * Vec3{0.4, -0.8, 0.3}) * rotation_by({0, t, 1.3 * t});
  }
  Pose at(double t, Vec3 X, Vec3 shift, Vec3 turn) const {
    const double now = strain * (std::sin(2.2 * t) + 0.3 * t * t);
    return {common(t) * (X + now * shift) + Vec3{3 * t, -t * t, 0}, common(t) * rotation_by(now * turn)};
  }
  Pose i(double t) const { return at(t, X_i, {0.1, 0.3, -0.2}, {0.5, -0.4, 0.9}); }
  Pose j(double t) const { return at(t, X_j, {0.2, -0.3, 0.1}, {-0.2, 0.7, 0.1}); }
};

/// ω of the rotation from a to b in a time dt, in global axes, to second order.
Vec3 spin(const Mat3& a, const Mat3& b, double dt) {
  Vec3 sum;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3 from{a[0][c], a[1][c], a[2][c]}, to{b[0][c], b[1][c], b[2][c]};
    sum += cross(from, to);
  }
  return (0.5 / dt) * sum;
}

/// Force on i at t = 1, by increments.
Vec3 incremental_force(const Path& path, const ElasticBond& law, int steps) {
  const double dt = 1.0 / steps;
  Vec3 n = 1 / norm(path.X_j - path.X_i) * (path.X_j - path.X_i);
  Vec3 s = cross(n, {0.3, 0.5, 0.8}), t, d;
  s = 1 / norm(s) * s, t = cross(n, s);
  for (int step = 0; step < steps; ++step) {
    const Pose i0 = path.i(step * dt), i1 = path.i((step + 1) * dt);
    const Pose j0 = path.j(step * dt), j1 = path.j((step + 1) * dt);
    const Vec3 v_i = (1 / dt) * (i1.x - i0.x), v_j = (1 / dt) * (j1.x - j0.x);
    const Vec3 omega_i = spin(i0.R, i1.R, dt), omega_j = spin(j0.R, j1.R, dt);
    const Vec3 between = 0.5 * (j0.x + j1.x) - 0.5 * (i0.x + i1.x), arm = 0.5 * between;
    const Vec3 v = (v_j - cross(omega_j, arm)) - (v_i + cross(omega_i, arm));  // (19)–(21)
    const Vec3 axis = 1 / norm(between) * between;
    const Vec3 twist = dot(0.5 * (omega_i + omega_j), axis) * axis;
    const Vec3 Omega = (1 / dot(between, between)) * cross(between, v_j - v_i) + twist;
    const Mat3 half = rotation_by(0.5 * dt * Omega);
    n = half * n, s = half * s, t = half * t;
    d += dt * Vec3{dot(n, v), dot(s, v), dot(t, v)};  // (22)(23)
    n = half * n, s = half * s, t = half * t;
  }
  return law.k_n * d.x * n + law.k_s * (d.y * s + d.z * t);  // (3)(4)
}

/// Force on i at t = 1 by the kernel.
Vec3 total_force(const Path& path, Lattice& pair, std::size_t i, std::size_t j) {
  pair.motion.set(i, path.i(1).x - path.X_i), set_rotation(pair, i, path.i(1).R);
  pair.motion.set(j, path.j(1).x - path.X_j), set_rotation(pair, j, path.j(1).R);
  return kernel_forces(pair).force[i];
}

/// |difference| / |force| of both forms for a bond in that direction.
double difference(const std::array<int, 3>& e, double strain, int steps) {
  const auto kind = [&](int i, int j, int k) {
    return (i == 1 && j == 1 && k == 1) || (i == 1 + e[0] && j == 1 + e[1] && k == 1 + e[2]) ? free_particle
                                                                                             : 0;
  };
  Lattice pair = finite(make_lattice({3, 3, 3}, kind), false);
  const std::size_t i = pair.grid.index(1, 1, 1), j = pair.grid.index(1 + e[0], 1 + e[1], 1 + e[2]);
  const Path path{pair.grid.centre(i), pair.grid.centre(j), strain};
  const Vec3 found = total_force(path, pair, i, j);
  const ElasticBond law = ElasticBond::from(pair.material, pair.radius());
  return norm(found - incremental_force(path, law, steps)) / norm(found);
}

TEST(FiniteIncremental, AgreesToSecondOrderInTheStrain) {
  for (const auto& e : {directions[9], directions[15], directions[12], directions[13]}) {
    const double coarse = difference(e, 1e-2, 4000), fine = difference(e, 1e-3, 4000);
    EXPECT_LT(coarse, 4e-2);
    EXPECT_NEAR(coarse / fine, 10, 1.5);  // relative to a force of first order
    ::testing::Test::RecordProperty("strain 1e-2, 1e-3", std::to_string(coarse) + " " + std::to_string(fine));
  }
}

/// At a strain so small that the difference of the forms is not seen.
TEST(FiniteIncremental, ConvergesWithTheSecondPowerOfTheStep) {
  for (const auto& e : {directions[9], directions[12]})
    EXPECT_NEAR(difference(e, 1e-7, 100) / difference(e, 1e-7, 200), 4, 0.1);
}

}  // namespace
}  // namespace geist::de
