// Vec3 and Mat3 against formulas written out by index.
#include "core/vec.hpp"

#include <gtest/gtest.h>

#include <random>

namespace geist {
namespace {

/// ε_ijk from the parity of its indices.
int levi_civita(int i, int j, int k) { return (i - j) * (j - k) * (k - i) / 2; }

class RandomVectors : public ::testing::Test {
 protected:
  Vec3 vector() { return {number(), number(), number()}; }
  Mat3 matrix() { return {{vector(), vector(), vector()}}; }
  double number() { return uniform_(random_); }

 private:
  std::mt19937 random_{11};
  std::uniform_real_distribution<double> uniform_{-2, 2};
};

TEST(Vec3, ComponentsAreReachedByIndexAndByName) {
  Vec3 a{1, 2, 3};
  EXPECT_EQ(a[0], 1);
  EXPECT_EQ(a[1], 2);
  EXPECT_EQ(a[2], 3);
  a[0] = 4, a[1] = 5, a[2] = 6;
  EXPECT_EQ(a, (Vec3{4, 5, 6}));
  EXPECT_EQ(Vec3{}, (Vec3{0, 0, 0}));
}

TEST(Vec3, ArithmeticIsByComponent) {
  Vec3 a{1, 2, 3};
  const Vec3 b{10, 20, 40};
  EXPECT_EQ(a + b, (Vec3{11, 22, 43}));
  EXPECT_EQ(b - a, (Vec3{9, 18, 37}));
  EXPECT_EQ(-a, (Vec3{-1, -2, -3}));
  EXPECT_EQ(2 * a, (Vec3{2, 4, 6}));
  EXPECT_EQ(a * 2, 2 * a);
  a += b;
  EXPECT_EQ(a, (Vec3{11, 22, 43}));
  a -= b;
  a *= 3;
  EXPECT_EQ(a, (Vec3{3, 6, 9}));
  EXPECT_FALSE(a == b);
}

TEST_F(RandomVectors, DotCrossAndNormAreTheIndexFormulas) {
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Vec3 a = vector(), b = vector(), c = cross(a, b);
    double squares = 0, product = 0;
    for (int i = 0; i < 3; ++i) {
      double expected = 0;
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) expected += levi_civita(i, j, k) * a[j] * b[k];
      EXPECT_NEAR(c[i], expected, 1e-15 * 8);  // two products of at most 4
      squares += a[i] * a[i], product += a[i] * b[i];
    }
    EXPECT_NEAR(norm(a) * norm(a), squares, 1e-15 * 12);
    EXPECT_NEAR(dot(a, b), product, 1e-15 * 12);
  }
}

TEST_F(RandomVectors, MatrixTimesVectorAndDeterminant) {
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Mat3 m = matrix();
    const Vec3 x = vector(), y = m * x;
    double determinant = 0;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(y[i], m[i][0] * x[0] + m[i][1] * x[1] + m[i][2] * x[2], 1e-14);
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) determinant += levi_civita(i, j, k) * m[0][i] * m[1][j] * m[2][k];
    }
    EXPECT_NEAR(det(m), determinant, 1e-13);
  }
}

TEST_F(RandomVectors, InverseUndoesTheMatrixFromBothSides) {
  for (int repeat = 0; repeat < 50; ++repeat) {
    const Mat3 m = matrix();
    if (std::abs(det(m)) < 0.5) continue;  // |m| ≤ 2√9, so the condition number stays below about 400
    const Mat3 i = inverse(m);
    const Vec3 x = vector();
    EXPECT_LT(norm(m * (i * x) - x), 1e-12);
    EXPECT_LT(norm(i * (m * x) - x), 1e-12);
  }
}

}  // namespace
}  // namespace geist
