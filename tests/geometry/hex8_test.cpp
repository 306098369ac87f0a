// Hexahedra: shape functions, map and inverse map, validity, volumes.
#include "geometry/hex8.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace geist::hex8 {
namespace {

/// A brick [0, a] × [0, b] × [0, c].
Corners brick(double a, double b, double c) {
  Corners x;
  for (int i = 0; i < 8; ++i) {
    const Vec3 s = corner_xi[i];
    x[i] = {a * (1 + s.x) / 2, b * (1 + s.y) / 2, c * (1 + s.z) / 2};
  }
  return x;
}

/// A brick with every corner moved by up to `amount`, at an offset.
Corners distorted(int seed, double amount, Vec3 offset = {}) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-amount, amount);
  Corners x = brick(1.0, 1.3, 0.8);
  for (Vec3& p : x) p += offset + Vec3{shift(random), shift(random), shift(random)};
  return x;
}

TEST(Hex8, ShapeFunctionsAreOneAtTheirCornerAndAddUpToOne) {
  for (int a = 0; a < 8; ++a) {
    const auto N = shape(corner_xi[a]);
    for (int b = 0; b < 8; ++b) EXPECT_EQ(N[b], a == b ? 1 : 0);
  }
  const auto N = shape({0.3, -0.7, 0.1});
  double sum = 0;
  for (double n : N) sum += n;
  EXPECT_NEAR(sum, 1, 1e-15);
  EXPECT_NEAR(N[6], 1.3 * 0.3 * 1.1 / 8, 1e-16);  // (8) written out
}

TEST(Hex8, GradientsAreTheDerivativesOfTheShapeFunctions) {
  const Vec3 xi{0.2, -0.4, 0.6};
  const double h = 1e-5;
  const auto g = shape_gradient(xi);
  const Corners x = distorted(1, 0.2);
  const Mat3 J = jacobian(x, xi);
  for (int d = 0; d < 3; ++d) {
    Vec3 step;
    step[d] = h;
    const auto up = shape(xi + step), down = shape(xi - step);
    for (int a = 0; a < 8; ++a) EXPECT_NEAR(g[a][d], (up[a] - down[a]) / (2 * h), 1e-10);
    const Vec3 column = (1 / (2 * h)) * (map(x, xi + step) - map(x, xi - step));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(J[i][d], column[i], 1e-10);
  }
}

TEST(Hex8, PositionGradientReproducesALinearField) {
  const Corners x = distorted(2, 0.2);
  const Vec3 slope{2, -3, 5};
  Vec3 found;
  const auto g = position_gradient(x, {0.1, 0.5, -0.8});
  for (int a = 0; a < 8; ++a) found += dot(slope, x[a]) * g[a];
  EXPECT_NEAR(norm(found - slope), 0, 1e-13);
}

TEST(Hex8, InverseMapFindsPointsInsideAndOutside) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> natural(-1.3, 1.3);
  for (int seed = 0; seed < 50; ++seed) {
    const Corners x = distorted(seed, 0.15, {30, -20, 10});
    ASSERT_TRUE(valid(x));
    for (int i = 0; i < 20; ++i) {
      const Vec3 xi{natural(random), natural(random), natural(random)};
      const Inverse found = inverse_map(x, map(x, xi));
      ASSERT_TRUE(found.converged);
      EXPECT_LT(norm(found.xi - xi), 1e-11);
      EXPECT_EQ(contains(found.xi), contains(xi));
    }
  }
}

TEST(Hex8, InverseMapCopesWithTheOrigin) {
  Corners x = brick(2, 2, 2);
  for (Vec3& p : x) p -= Vec3{1, 1, 1};
  const Inverse centre = inverse_map(x, {0, 0, 0});  // ‖x‖ = 0
  EXPECT_TRUE(centre.converged);
  EXPECT_LT(norm(centre.xi), 1e-15);
  const Inverse tiny = inverse_map(brick(1e-6, 1e-6, 1e-6), {0.25e-6, 0.5e-6, 0.75e-6});
  EXPECT_TRUE(tiny.converged);
  EXPECT_LT(norm(tiny.xi - Vec3{-0.5, 0, 0.5}), 1e-12);
}

TEST(Hex8, InverseMapOfFarPointsIsFinite) {
  const Corners x = distorted(3, 0.25);
  for (double far : {3.0, 10.0, 1e3, 1e8})
    for (Vec3 s : corner_xi) {
      const Inverse found = inverse_map(x, far * s);
      EXPECT_TRUE(std::isfinite(norm(found.xi)));
      if (found.converged) {
        EXPECT_FALSE(contains(found.xi)) << far;
        EXPECT_LT(norm(map(x, found.xi) - far * s), 1e-6 * far);
      }
    }
}

TEST(Hex8, ContainsHonoursItsTolerance) {
  EXPECT_TRUE(contains({1, -1, 1}));
  EXPECT_FALSE(contains({1.01, 0, 0}));
  EXPECT_TRUE(contains({1.01, 0, 0}, 0.02));
  EXPECT_FALSE(contains({0, std::nan(""), 0}));
}

TEST(Hex8, InvalidElementsAreFound) {
  EXPECT_TRUE(valid(brick(1, 1, 1)));
  EXPECT_NEAR(smallest_determinant(brick(2, 3, 4)), 3, 1e-14);
  Corners inside_out = brick(1, 1, 1);
  for (int a = 0; a < 4; ++a) std::swap(inside_out[a], inside_out[a + 4]);
  EXPECT_FALSE(valid(inside_out));
  Corners pushed_in = brick(1, 1, 1);
  pushed_in[6] = {0.3, 0.3, 0.3};  // concave at corner 6 only
  EXPECT_FALSE(valid(pushed_in));
  Corners flat = brick(1, 1, 0);
  EXPECT_FALSE(valid(flat));
}

TEST(Hex8, VolumesAreExact) {
  EXPECT_NEAR(volume(brick(2, 3, 4)), 24, 1e-13);
  // Pyramid frustum: bottom 2 × 2, top 1 × 1, height 3: V = h/3 (A + √(A B) + B) = 7
  Corners frustum;
  for (int a = 0; a < 8; ++a) {
    const Vec3 s = corner_xi[a];
    const double half = s.z < 0 ? 1 : 0.5;
    frustum[a] = {half * s.x, half * s.y, s.z < 0 ? 0.0 : 3.0};
  }
  EXPECT_NEAR(volume(frustum), 7, 1e-14);
  const auto shares = corner_volumes(frustum);
  double sum = 0;
  for (double v : shares) sum += v;
  EXPECT_NEAR(sum, 7, 1e-14);
  // ∫ z dV = h²/12 (A + 2 √(A B) + 3 B) = 8.25 must be Σ shares z, since z is a combination of shape
  // functions
  EXPECT_NEAR((shares[4] + shares[5] + shares[6] + shares[7]) * 3, 8.25, 1e-14);
}

}  // namespace
}  // namespace geist::hex8
