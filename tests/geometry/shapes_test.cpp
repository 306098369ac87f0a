// Solid shapes: what lies inside, and how a margin widens them.
#include "geometry/shapes.hpp"

#include <gtest/gtest.h>

#include <random>

namespace geist {
namespace {

TEST(Shapes, BoxIsClosedAndWidensByItsMargin) {
  const Box box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_TRUE(contains(box, {0.5, 1, 1.5}));
  EXPECT_TRUE(contains(box, {0, 2, 3}));
  for (int c = 0; c < 3; ++c)
    for (const double side : {-1.0, 1.0}) {
      Vec3 p{0.5, 1, 1.5};
      p[c] = side < 0 ? -0.01 : box.high[c] + 0.01;
      EXPECT_FALSE(contains(box, p));
      EXPECT_TRUE(contains(box, p, 0.02));
      p[c] = side < 0 ? 0.01 : box.high[c] - 0.01;
      EXPECT_FALSE(contains(box, p, -0.02));
    }
}

TEST(Shapes, BallIsClosedAndWidensByItsMargin) {
  const Ball ball{{1, 2, 3}, 0.5};
  EXPECT_TRUE(contains(ball, {1, 2, 3}));
  EXPECT_TRUE(contains(ball, {1.5, 2, 3}));
  EXPECT_FALSE(contains(ball, {1.4, 2.4, 3}));  // inside the ball's box, 0.57 away
  EXPECT_TRUE(contains(ball, {1.4, 2.4, 3}, 0.1));
  EXPECT_FALSE(contains(ball, {1.45, 2, 3}, -0.1));
}

TEST(Shapes, ObliqueCylinderIsTheUprightOneTurned) {
  const Vec3 from{1, -2, 0.5};
  // Axes of a frame turned about no coordinate axis: columns of an orthogonal matrix.
  const Vec3 e1{2 / 3.0, -1 / 3.0, 2 / 3.0}, e2{2 / 3.0, 2 / 3.0, -1 / 3.0}, e3{-1 / 3.0, 2 / 3.0, 2 / 3.0};
  const double length = 2, radius = 0.75;
  const Cylinder cylinder{from, from + length * e3, radius};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1.5, 3);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = number(random), y = number(random), z = number(random);
    for (const double margin : {-0.2, 0.0, 0.3}) {
      const bool expected = std::hypot(x, y) <= radius + margin && z >= -margin && z <= length + margin;
      const bool clear = std::abs(std::hypot(x, y) - radius - margin) > 1e-9;  // not on the very surface
      inside += expected;
      if (clear) {
        EXPECT_EQ(contains(cylinder, from + x * e1 + y * e2 + z * e3, margin), expected);
      }
    }
  }
  EXPECT_GT(inside, 100);
}

TEST(Shapes, AnyShapeAnswersAsItself) {
  const Vec3 p{0.6, 0.6, 0.6};
  EXPECT_TRUE(contains(Shape{Box{{0, 0, 0}, {1, 1, 1}}}, p));
  EXPECT_FALSE(contains(Shape{Ball{{0, 0, 0}, 1}}, p));
  EXPECT_TRUE(contains(Shape{Ball{{0, 0, 0}, 1}}, p, 0.1));
  EXPECT_TRUE(contains(Shape{Cylinder{{0, 0, 0}, {0, 0, 1}, 1}}, p));
}

}  // namespace
}  // namespace geist
