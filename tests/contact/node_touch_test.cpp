// Nodes on surfaces: flush sides, edges, notches, borders of a coupled lattice, and what they ignore.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/support.hpp"

namespace geist::contact {
namespace {

using namespace testing;

const Box cube{{0, 0, 0}, {1, 1, 1}};

Probed block(const std::array<int, 3>& n) {
  Builder builder;
  builder.hexahedra(cube, n);
  return Probed(builder);
}

TEST(Node, BehindASurfaceIsPushedOutAlongItsNormal) {
  const Probed body = block({3, 4, 5});
  Random random(21);
  for (int i = 0; i < 1000; ++i) {
    const double depth = random.number(1e-9, 0.1);
    const Touch t = body.node({random.number(0.1, 0.9), random.number(0.1, 0.9), 1 - depth}, {0, 0, -1}, 0.2);
    ASSERT_EQ(t.count, 1);
    EXPECT_LE(norm(way(t) - Vec3{0, 0, depth}), 1e-15);
  }
}

TEST(Node, OfAFlushCornerActsWhateverTheLastBitSays) {
  const Probed body = block({2, 2, 2});
  for (const double a : {-1e-15, 0.0, 1e-15, -1e-6, 1e-6})
    for (const double b : {-1e-15, 0.0, 1e-15})
      for (const double x : {0.0, 0.5, 1.0}) {
        const Touch t = body.node({x + a, b, 0.99}, {x < 0.5 ? -1.0 : x > 0.5 ? 1.0 : 0.0, -1, -1}, 0.2);
        ASSERT_EQ(t.count, 1) << x << ' ' << a << ' ' << b;
        EXPECT_LE(norm(way(t) - Vec3{0, 0, 0.01}), 1e-13);
        double weights = 0;
        for (const double w : t.point[0].weight) weights += w;
        EXPECT_NEAR(weights, 1, 1e-15);
      }
}

TEST(Node, BesideABodyTouchesNothing) {
  const Probed body = block({2, 2, 2});
  for (const double beside : {0.02, 0.1, 0.3})
    for (const Vec3 x :
         {Vec3{1 + beside, 0.5, 0.99}, Vec3{-beside, 0.3, 0.9}, Vec3{1 + beside, -beside, 0.95}})
      for (const Vec3 outward : {Vec3{0, 0, -1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}})
        EXPECT_EQ(body.node(x, outward, 0.5).count, 0) << beside;
}

/// A body that rests on a larger one: nodes beside it lie behind its plane by next to nothing.
TEST(Node, BesideABodyAndLevelWithItTouchesNothing) {
  const Probed body = block({2, 2, 2});
  for (const double depth : {1e-15, 1e-13, 1e-11, 1e-9})
    for (const double beside : {0.05, 0.2, 0.4})
      for (const Vec3 x : {Vec3{1 + beside, 0.5, 1 - depth}, Vec3{1 + beside, -beside, 1 - depth},
                           Vec3{-0.5 * beside, 1 + beside, 1 - depth}})
        EXPECT_EQ(body.node(x, {0, 0, -1}, 0.5).count, 0) << depth << ' ' << beside;
}

TEST(Node, ThatFacesAwayOrIsTooDeepIsIgnored) {
  const Probed body = block({2, 2, 2});
  EXPECT_EQ(body.node({0.4, 0.4, 0.95}, {0, 0, 1}, 0.2).count, 0);
  EXPECT_EQ(body.node({0.4, 0.4, 0.95}, {1, 0, 0}, 0.2).count, 0);
  EXPECT_EQ(body.node({0.4, 0.4, 0.79}, {0, 0, -1}, 0.2).count, 0);
  EXPECT_EQ(body.node({0.4, 0.4, 0.81}, {0, 0, -1}, 0.2).count, 1);
  EXPECT_EQ(body.node({0.4, 0.4, 1.0}, {0, 0, -1}, 0.2).count, 0);
  EXPECT_EQ(body.node({0.4, 0.4, 1.01}, {0, 0, -1}, 0.2).count, 0);
}

TEST(Node, NearAConvexEdgeLeavesByTheNearerFace) {
  const Probed body = block({3, 3, 3});
  const Vec3 outward{1, 0, -1};  // a corner of another body, coming from above x = 0
  for (const double a : {0.001, 0.01, 0.03})
    for (const double b : {0.002, 0.011, 0.04}) {
      const Touch t = body.node({a, 0.5, 1 - b}, outward, 0.3);
      EXPECT_LE(norm(way(t) - (a < b ? Vec3{-a, 0, 0} : Vec3{0, 0, b})), 1e-15);
    }
}

TEST(Node, InANotchIsPushedBackToItsEdge) {
  Builder builder;
  builder.hexahedra(cube, {4, 4, 4}, {{{0.5, -1, 0.5}, {2, 2, 2}}});
  const Probed body(builder);
  const Vec3 outward{-1, 0, -1};
  // Within the body, beyond both the wall x = 0.5 and the floor z = 0.5: the edge is nearest.
  for (const double a : {1e-4, 1e-3, 0.01, 0.05})
    for (const double b : {1e-4, 1e-3, 0.01, 0.05})
      for (const double y : {0.4, 0.5}) {
        const Touch t = body.node({0.5 - a, y, 0.5 - b}, outward, 0.2);
        EXPECT_LE(norm(way(t) - Vec3{a, 0, b}), 1e-14) << a << ' ' << b;
      }
}

TEST(Node, OverACoupledLatticeDoesNotTouchTheHexahedraBeside) {
  Builder builder;
  builder.hexahedra(cube, {2, 2, 2}).particles({{1, 0, 0}, {2, 1, 1}}, 0.125).coupled();
  const Probed body(builder);
  for (const double beside : {0.05, 0.1, 0.2})
    for (const double depth : {1e-9, 1e-3, 0.05})
      for (const double y : {0.3, 0.5, 1.0, 1 + beside}) {
        EXPECT_EQ(body.node({1 + beside, y, 1 - depth}, {0, 0, -1}, 0.5).count, 0) << beside << ' ' << y;
        EXPECT_EQ(body.node({1 + beside, y, 1 - depth}, {-1, 0, -1}, 0.5).count, 0) << beside << ' ' << y;
      }
  EXPECT_EQ(body.node({1, 0.3, 0.99}, {0, 0, -1}, 0.5).count, 1);
}

TEST(Node, OnWarpedFacetsGoesWithoutJumps) {
  Builder builder;
  builder.hexahedra(cube, {4, 4, 2}).move_nodes([](Vec3 p) {
    return p + Vec3{0, 0, p.z * 0.05 * std::sin(5 * p.x * p.y + p.x)};
  });
  const Probed body(builder);
  double before = 0;
  Vec3 x_before;
  for (int i = 0; i <= 20'000; ++i) {
    const double t = i / 20'000.0;
    const Vec3 x{0.2 + 0.6 * t, 0.15 + 0.7 * t, 0.9 + 0.02 * std::sin(9 * t)};
    const Touch touched = body.node(x, {0, 0, -1}, 0.3);
    ASSERT_EQ(touched.count, 1);
    if (i) {
      EXPECT_LE(std::abs(touched.overlap - before), 1.01 * norm(x - x_before)) << t;
    }
    before = touched.overlap, x_before = x;
  }
}

}  // namespace
}  // namespace geist::contact
