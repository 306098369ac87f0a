// Rotations of particles: a step, many steps, and the rotation vector.
#include <gtest/gtest.h>

#include <cmath>

#include "de/rotation.hpp"
#include "de/support.hpp"

namespace geist::de {
namespace {

using namespace testing;

constexpr double epsilon = 2.3e-16;

Lattice single() { return finite(full_lattice({1, 1, 1}), false); }

/// Largest entry of a − b.
double difference(const Mat3& a, const Mat3& b) {
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(a[i][c] - b[i][c]));
  return most;
}

/// Largest entry of RᵀR − I.
double skew_of(const Mat3& R) {
  Mat3 transposed, unit = rotation_by({});
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t c = 0; c < 3; ++c) transposed[i][c] = R[c][i];
  return difference(transposed * R, unit);
}

TEST(Rotation, OfAStepIsTheExponential) {
  for (const double angle : {0.0, 1e-9, 1e-5, 1e-3, 0.03}) {
    Lattice lattice = single();
    const Mat3 before = rotation_by({0.4, 2, -1});
    set_rotation(lattice, 0, before);
    const Vec3 psi = angle / norm(Vec3{1, -2, 0.5}) * Vec3{1, -2, 0.5};
    lattice.velocity.set(0, 10.0 * psi, 3);
    turn(lattice, 0.1);
    EXPECT_LE(difference(rotation_matrix(lattice, 0), rotation_by(psi) * before), 4 * epsilon) << angle;
  }
}

/// Whatever a step's angle: orthonormal, about the axis of the spin, and the opposite spin leads back.
TEST(Rotation, OfAStepIsAlwaysARotation) {
  for (const double angle : {0.1, 1.0, 3.0, 10.0}) {
    Lattice lattice = single();
    const Mat3 before = rotation_by({0.4, 2, -1});
    set_rotation(lattice, 0, before);
    const Vec3 n = 1 / norm(Vec3{1, -2, 0.5}) * Vec3{1, -2, 0.5};
    lattice.velocity.set(0, n, 3);
    turn(lattice, angle);
    EXPECT_LE(skew_of(rotation_matrix(lattice, 0)), 4 * epsilon);
    turn(lattice, -angle);
    EXPECT_LE(difference(rotation_matrix(lattice, 0), before), 8 * epsilon);
  }
}

/// Rounding: a random walk of the angle, but none of the right angles.
TEST(Rotation, OfAMillionStepsStaysOrthonormal) {
  Lattice lattice = single();
  constexpr int steps = 1'000'000;
  const Vec3 theta{10 * M_PI, 4, -20 * M_PI};
  lattice.velocity.set(0, 1.0 / steps * theta, 3);
  for (int n = 0; n < steps; ++n) turn(lattice, 1);
  const Mat3 R = rotation_matrix(lattice, 0);
  EXPECT_LE(skew_of(R), 4 * epsilon);
  EXPECT_LE(difference(R, rotation_by(theta)), 1e-12);
  RecordProperty("difference", std::to_string(difference(R, rotation_by(theta)) * 1e15) + "e-15");
}

TEST(Rotation, VectorIsTheLogarithm) {
  for (const double angle : {0.0, 1e-12, 1e-6, 0.5, 1.5, 1.6, 3.0, M_PI - 1e-4, M_PI - 1e-7})
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 0, -1}, Vec3{0.5, -0.7, 0.2}, Vec3{-1, -1, 1}}) {
      Lattice lattice = single();
      const Vec3 theta = angle / norm(axis) * axis;
      set_rotation(lattice, 0, rotation_by(theta));
      EXPECT_LE(norm(rotation_vector(lattice, 0) - theta), 1e-14 + 4 * epsilon * angle) << angle;
    }
}

TEST(Rotation, VectorOfSmallKinematicsIsTheta) {
  Lattice lattice = full_lattice({1, 1, 1});
  lattice.motion.set(0, {1, 20, 300}, 3);
  EXPECT_EQ(rotation_vector(lattice, 0), (Vec3{1, 20, 300}));
}

}  // namespace
}  // namespace geist::de
