// Boxes cut by planes: volumes and integrals against closed forms.
#include "geometry/polyhedron.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace geist {
namespace {

double integral(const std::vector<WeightedPoint>& points, double (*f)(Vec3)) {
  double sum = 0;
  for (const auto& [x, weight] : points) sum += weight * f(x);
  return sum;
}

double one(Vec3) { return 1; }
double second_degree(Vec3 p) { return p.x * p.x + 2 * p.y * p.z - p.z + 3; }

const Box unit{{0, 0, 0}, {1, 1, 1}};

TEST(ConvexPolyhedron, IsTheBox) {
  const auto points = ConvexPolyhedron(unit).quadrature();
  EXPECT_NEAR(integral(points, one), 1, 1e-14);
  EXPECT_NEAR(integral(points, second_degree), 1.0 / 3 + 0.5 - 0.5 + 3, 1e-13);
}

/// x + y + z ≤ 1 leaves a tetrahedron: ∫ x² = 1/60, ∫ yz = 1/120, ∫ z = 1/24.
TEST(ConvexPolyhedron, CutToATetrahedron) {
  ConvexPolyhedron body(unit);
  const double n = 1 / std::sqrt(3.0);
  body.cut({{n, n, n}, n}, 1e-12);
  const auto points = body.quadrature();
  EXPECT_NEAR(integral(points, one), 1.0 / 6, 1e-14);
  EXPECT_NEAR(integral(points, second_degree), 1.0 / 60 + 2.0 / 120 - 1.0 / 24 + 3.0 / 6, 1e-14);
}

/// Two halves make a whole, wherever the plane lies, through corners and edges too.
TEST(ConvexPolyhedron, HalvesMakeAWhole) {
  for (const Vec3 direction : {Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{1, 2, 3}, Vec3{-1, 1, 0}, Vec3{1, -1, 1}})
    for (const double at : {0.0, 0.2, 0.5, 0.7, 1.0}) {
      const Vec3 n = direction * (1 / norm(direction));
      const double offset = dot(n, Vec3{at, 0.5, 0.5});
      ConvexPolyhedron below(unit), above(unit);
      below.cut({n, offset}, 1e-12), above.cut({-n, -offset}, 1e-12);
      const auto a = below.quadrature(), b = above.quadrature();
      EXPECT_NEAR(integral(a, one) + integral(b, one), 1, 1e-12);
      EXPECT_NEAR(integral(a, second_degree) + integral(b, second_degree), 1.0 / 3 + 3, 1e-12);
    }
}

TEST(ConvexPolyhedron, NothingIsLeftBeyond) {
  ConvexPolyhedron body(unit);
  body.cut({{1, 0, 0}, 0}, 1e-9);
  EXPECT_TRUE(body.empty());
  EXPECT_TRUE(body.quadrature().empty());
}

TEST(Polygon, IsClippedAndIntegrated) {
  const std::vector<Vec3> square{{0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}};
  const double n = std::sqrt(0.5);
  const auto half = clipped(square, {{n, n, 0}, n}, 1e-12);  // x + y ≤ 1
  EXPECT_NEAR(integral(quadrature(half), one), 0.5, 1e-14);
  EXPECT_NEAR(integral(quadrature(half), [](Vec3 p) { return p.x * p.x + p.x * p.y; }), 1.0 / 12 + 1.0 / 24,
              1e-14);
  EXPECT_TRUE(clipped(square, {{1, 0, 0}, -0.1}, 1e-12).empty());
}

TEST(BoxQuadrature, IsExactToTheThirdDegree) {
  const auto points = quadrature(Box{{1, 2, 3}, {2, 4, 6}});
  double sum = 0;
  for (const auto& [x, weight] : points) sum += weight * x.x * x.x * x.x * x.y * x.z * x.z;
  EXPECT_NEAR(sum, (16 - 1) / 4.0 * (16 - 4) / 2.0 * (216 - 27) / 3.0, 1e-10);
}

}  // namespace
}  // namespace geist
