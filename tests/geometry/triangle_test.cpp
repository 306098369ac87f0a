// The nearest point of a triangle: against a search that knows nothing of regions, and what any nearest point
// obeys.
#include "geometry/triangle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace geist {
namespace {

struct Triangle {
  Vec3 a, b, c;
};

double size_of(const Triangle& t) { return std::max({norm(t.b - t.a), norm(t.c - t.b), norm(t.a - t.c)}); }

/// Nearest point of a segment, by its own one-dimensional minimum.
Vec3 nearest_on_segment(Vec3 x, Vec3 a, Vec3 b) {
  const Vec3 e = b - a;
  return a + std::clamp(dot(x - a, e) / dot(e, e), 0.0, 1.0) * e;
}

/// The smallest distance: to the plane if the foot lies in the triangle by signs of areas, else to the sides.
double brute_distance(Vec3 x, const Triangle& t) {
  const Vec3 n = cross(t.b - t.a, t.c - t.a);
  const double height = dot(x - t.a, n) / norm(n);
  const Vec3 foot = x - (height / norm(n)) * n;
  const auto left = [&](Vec3 p, Vec3 q) { return dot(cross(q - p, foot - p), n) >= 0; };
  if (left(t.a, t.b) && left(t.b, t.c) && left(t.c, t.a)) return std::abs(height);
  return std::min({norm(x - nearest_on_segment(x, t.a, t.b)), norm(x - nearest_on_segment(x, t.b, t.c)),
                   norm(x - nearest_on_segment(x, t.c, t.a))});
}

/// The smallest distance to points of a grid on the triangle; too large by at most size / n.
double sampled_distance(Vec3 x, const Triangle& t, int n) {
  double least = 1e300;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const double v = static_cast<double>(i) / n, w = static_cast<double>(j) / n;
      least = std::min(least, norm(x - (t.a + v * (t.b - t.a) + w * (t.c - t.a))));
    }
  return least;
}

void expect_on_feature(const NearestPoint& found, const Triangle& t) {
  const auto& w = found.weight;
  const double slack = 1e-14;
  EXPECT_NEAR(w[0] + w[1] + w[2], 1, 1e-14);
  for (const double each : w) EXPECT_GE(each, -slack);
  EXPECT_LE(norm(w[0] * t.a + w[1] * t.b + w[2] * t.c - found.p), 1e-14 * size_of(t));
  const std::map<Feature, std::array<bool, 3>> carries{
      {Feature::face, {true, true, true}},       {Feature::edge_ab, {true, true, false}},
      {Feature::edge_bc, {false, true, true}},   {Feature::edge_ca, {true, false, true}},
      {Feature::corner_a, {true, false, false}}, {Feature::corner_b, {false, true, false}},
      {Feature::corner_c, {false, false, true}}};
  for (int i = 0; i < 3; ++i)
    if (!carries.at(found.feature)[i]) {
      EXPECT_EQ(w[i], 0);
    }
}

class Points {
 public:
  Vec3 next(double scale = 1) { return scale * Vec3{number_(random_), number_(random_), number_(random_)}; }

 private:
  std::mt19937 random_{11};
  std::uniform_real_distribution<double> number_{-1, 1};
};

TEST(NearestPoint, IsNoFartherThanAnyOtherPointOfTheTriangle) {
  Points points;
  std::map<Feature, int> seen;
  for (int i = 0; i < 20'000; ++i) {
    const Triangle t{points.next(), points.next(), points.next()};
    const Vec3 x = points.next(2);
    const NearestPoint found = nearest_point(x, t.a, t.b, t.c);
    ++seen[found.feature];
    expect_on_feature(found, t);
    EXPECT_NEAR(norm(x - found.p), brute_distance(x, t), 1e-12);
    if (i % 100 == 0) {
      const double sampled = sampled_distance(x, t, 100);
      EXPECT_LE(norm(x - found.p), sampled + 1e-12);
      EXPECT_GE(norm(x - found.p), sampled - 0.01 * size_of(t));
    }
  }
  EXPECT_EQ(seen.size(), 7u);
  for (const auto& [feature, count] : seen) EXPECT_GT(count, 100);
}

TEST(NearestPoint, TellsTheSevenFeatures) {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  const auto feature = [&](Vec3 x) { return nearest_point(x, a, b, c).feature; };
  EXPECT_EQ(feature({0.2, 0.2, 3}), Feature::face);
  EXPECT_EQ(feature({0.2, -1, 3}), Feature::edge_ab);
  EXPECT_EQ(feature({1, 1, -3}), Feature::edge_bc);
  EXPECT_EQ(feature({-1, 0.3, 1}), Feature::edge_ca);
  EXPECT_EQ(feature({-1, -1, 1}), Feature::corner_a);
  EXPECT_EQ(feature({3, -1, 1}), Feature::corner_b);
  EXPECT_EQ(feature({-1, 3, 1}), Feature::corner_c);
}

TEST(NearestPoint, HoldsForSlenderTriangles) {
  Points points;
  for (const double thin : {1e-2, 1e-4, 1e-6})
    for (int i = 0; i < 2000; ++i) {
      const Vec3 a = points.next(), b = points.next(), c = a + 0.5 * (b - a) + points.next(thin);
      const Vec3 x = points.next(2);
      const NearestPoint found = nearest_point(x, a, b, c);
      expect_on_feature(found, {a, b, c});
      // The foot's place across the sliver is known to rounding / thinness.
      EXPECT_NEAR(norm(x - found.p), brute_distance(x, {a, b, c}), 1e-14 / thin + 1e-13);
    }
}

TEST(NearestPoint, OfAPointOfTheTriangleIsThatPoint) {
  Points points;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = points.next(), b = points.next(), c = points.next();
    for (const auto& w : {std::array{0.2, 0.3, 0.5}, std::array{0.5, 0.5, 0.0}, std::array{0.0, 0.1, 0.9},
                          std::array{0.7, 0.0, 0.3}, std::array{1.0, 0.0, 0.0}, std::array{0.0, 1.0, 0.0}}) {
      const Vec3 x = w[0] * a + w[1] * b + w[2] * c;
      EXPECT_LE(norm(nearest_point(x, a, b, c).p - x), 1e-11);
    }
  }
}

TEST(NearestPoint, DoesNotDependOnTheOrderOfCorners) {
  Points points;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = points.next(), b = points.next(), c = points.next(), x = points.next(2);
    const Vec3 p = nearest_point(x, a, b, c).p;
    EXPECT_LE(norm(nearest_point(x, b, c, a).p - p), 1e-11);
    EXPECT_LE(norm(nearest_point(x, c, b, a).p - p), 1e-11);
  }
}

}  // namespace
}  // namespace geist
