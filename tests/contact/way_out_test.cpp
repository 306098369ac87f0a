// The shortest way out of half-spaces: against Dykstra's projections, which know nothing of active sets.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact/support.hpp"

namespace geist::contact {
namespace {

using namespace testing;

TouchPoint half_space(Vec3 n, double overlap) { return {0, {1, 0, 0, 0}, {}, n, overlap, overlap}; }

/// The smallest d with n_i·d ≥ δ_i, by Dykstra's alternating projections of the origin.
Vec3 projected(const std::vector<TouchPoint>& points, int sweeps) {
  Vec3 d;
  std::vector<Vec3> correction(points.size());
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 y = d + correction[i];
      const Vec3 next = y + std::max(0.0, points[i].overlap - dot(points[i].n, y)) * points[i].n;
      correction[i] = y - next, d = next;
    }
  return d;
}

void expect_optimal(const std::vector<TouchPoint>& points, const Touch& t, double tolerance) {
  const Vec3 d = way(t);
  Vec3 sum;
  for (int i = 0; i < t.count; ++i) {
    EXPECT_GT(t.point[i].lambda, 0);
    EXPECT_NEAR(dot(t.point[i].n, d), t.point[i].overlap, tolerance);  // what carries is just met
    sum += t.point[i].lambda * t.point[i].n;
  }
  EXPECT_LE(norm(sum - d), 1e-12 * (1 + norm(d)));
  for (const TouchPoint& p : points) EXPECT_GE(dot(p.n, d), p.overlap - tolerance);
}

TEST(WayOut, IsTheSmallestDisplacementThatLeadsClear) {
  Random random(5);
  int carried[4] = {};
  for (int round = 0; round < 3000; ++round) {
    const Vec3 open = random.unit();  // some direction leads out
    std::vector<TouchPoint> points;
    const int n = 1 + round % 6;
    while (static_cast<int>(points.size()) < n)
      if (const Vec3 normal = random.unit(); dot(normal, open) > 0.2)
        points.push_back(half_space(normal, random.number(0.05, 1)));
    const Touch t = shortest_way_out(points);
    ASSERT_GE(t.count, 1);
    ++carried[t.count];
    expect_optimal(points, t, 1e-8);
    EXPECT_LE(norm(way(t) - projected(points, 3000)), 1e-3);
  }
  for (int n = 1; n <= 3; ++n) EXPECT_GT(carried[n], 30);
}

TEST(WayOut, IsTheDeepestOfOneDirection) {
  Random random(6);
  for (int round = 0; round < 200; ++round) {
    const Vec3 n = random.unit();
    std::vector<TouchPoint> points;
    double deepest = 0;
    for (int i = 0; i < 1 + round % 6; ++i) {
      points.push_back(half_space(n, random.number(0.1, 1)));
      deepest = std::max(deepest, points.back().overlap);
    }
    const Touch t = shortest_way_out(points);
    EXPECT_NEAR(t.overlap, deepest, 1e-14);
    EXPECT_NEAR(t.lambda_sum(), deepest, 1e-14);
  }
}

TEST(WayOut, CountsNearlyParallelOnesOnce) {
  Random random(7);
  for (double angle = 1e-12; angle < 0.1; angle *= 3)
    for (int round = 0; round < 50; ++round) {
      std::vector<TouchPoint> points;
      for (int i = 0; i < 4; ++i) {
        Vec3 n = Vec3{0, 0, 1} + random.vector(angle);
        points.push_back(half_space((1 / norm(n)) * n, 0.3));
      }
      const Touch t = shortest_way_out(points);
      EXPECT_NEAR(t.overlap, 0.3, 0.3 * 30 * angle * angle + 1e-9);
      expect_optimal(points, t, 1e-8);
    }
}

TEST(WayOut, OfAGrooveAndACorner) {
  for (const double half : {0.05, 0.4, 0.785, 1.2, 1.5}) {  // of the angle between the normals
    const double c = std::cos(half), s = std::sin(half);
    const Touch t = shortest_way_out(std::vector{half_space({s, 0, c}, 0.2), half_space({-s, 0, c}, 0.2)});
    EXPECT_EQ(t.count, 2);
    EXPECT_NEAR(t.overlap, 0.2 / c, 1e-12 / c);
    EXPECT_NEAR(t.normal.z, 1, 1e-12);
    EXPECT_NEAR(t.lambda_sum(), 0.2 / (c * c), 1e-10 / (c * c));
  }
  const Touch corner = shortest_way_out(
      std::vector{half_space({1, 0, 0}, 0.1), half_space({0, 1, 0}, 0.2), half_space({0, 0, 1}, 0.3)});
  EXPECT_EQ(corner.count, 3);
  EXPECT_LE(norm(way(corner) - Vec3{0.1, 0.2, 0.3}), 1e-15);
}

TEST(WayOut, DoesNotDependOnTheOrder) {
  Random random(8);
  for (int round = 0; round < 300; ++round) {
    std::vector<TouchPoint> points;
    for (int i = 0; i < 5; ++i) {
      Vec3 n = random.unit();
      n.z = std::abs(n.z) + 0.1;
      points.push_back(half_space((1 / norm(n)) * n, random.number(0.1, 1)));
    }
    const Vec3 d = way(shortest_way_out(points));
    std::reverse(points.begin(), points.end());
    EXPECT_LE(norm(way(shortest_way_out(points)) - d), 1e-8 * norm(d));
  }
}

TEST(WayOut, PushesFromBothSidesWhereNoneLeadsOut) {
  const Touch t = shortest_way_out(std::vector{half_space({1, 0, 0}, 0.3), half_space({-1, 0, 0}, 0.1)});
  EXPECT_EQ(t.count, 2);
  EXPECT_NEAR(t.overlap, 0.2, 1e-15);
  EXPECT_NEAR(t.normal.x, 1, 1e-15);
}

TEST(WayOut, StaysFiniteWhereOpposedPushesCancel) {
  const Touch t = shortest_way_out(std::vector{half_space({1, 0, 0}, 0.3), half_space({-1, 0, 0}, 0.3)});
  EXPECT_NEAR(norm(t.normal), 1, 1e-15);
  for (int i = 0; i < t.count; ++i) EXPECT_TRUE(std::isfinite(t.point[i].lambda / t.overlap));
  EXPECT_TRUE(std::isfinite(t.lambda_sum() / t.overlap));
}

TEST(WayOut, CountsEachDirectionOnceWhereNoneLeadsOut) {
  const std::vector points{half_space({1, 0, 0}, 0.3), half_space({1, 0, 0}, 0.3),
                           half_space({-1, 0, 0}, 0.2), half_space({-1, 0, 0}, 0.2)};
  EXPECT_NEAR(shortest_way_out(points).overlap, 0.1, 1e-15);
}

TEST(WayOut, PushesFromTheDeepestWhereNoneLeadsOut) {
  const std::vector points{half_space({0, 0, 1}, 0.01), half_space({0, 0, -1}, 0.01),
                           half_space({0, 1, 0}, 0.01), half_space({1, 0, 0}, 0.5)};
  const Touch t = shortest_way_out(points);
  ASSERT_EQ(t.count, 3);
  EXPECT_GT(t.normal.x, 0.9);
}

}  // namespace
}  // namespace geist::contact
