// Balls and cylinders of hexahedra: counts, shapes of elements, surface, symmetry, cuts; graded blocks.
#include "geometry/solids.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

#include "geometry/block.hpp"
#include "geometry/hex8.hpp"

namespace geist {
namespace {

constexpr double pi = std::numbers::pi;
const Ball unit{{0, 0, 0}, 1};

Mesh mesh_with(const Body& body, const Gradings& gradings = {}, const std::vector<Box>& minus = {}) {
  Mesh mesh;
  append(mesh, {}, mesh_of(body, gradings), minus);
  return mesh;
}

double volume_of(const Mesh& mesh) {
  double v = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) v += hex8::volume(hex8::corners(mesh, e));
  return v;
}

/// Smallest det J / (product of the lengths of its columns) at a corner of any element: 1 for bricks, 0 where
/// edges lie in a plane.
double scaled_jacobian(const Mesh& mesh) {
  double least = 1;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const Vec3 corner : hex8::corner_xi) {
      const Mat3 J = hex8::jacobian(hex8::corners(mesh, e), corner);
      double lengths = 1;
      for (int c = 0; c < 3; ++c) lengths *= norm({J[0][c], J[1][c], J[2][c]});
      least = std::min(least, det(J) / lengths);
    }
  return least;
}

/// How often each facet occurs, by its nodes in ascending order.
std::map<std::array<std::int32_t, 4>, int> occurrences(const Mesh& mesh) {
  constexpr int corners[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                 {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  std::map<std::array<std::int32_t, 4>, int> number;
  for (const auto& element : mesh.elements)
    for (const auto& face : corners) {
      std::array<std::int32_t, 4> nodes{element[face[0]], element[face[1]], element[face[2]],
                                        element[face[3]]};
      std::sort(nodes.begin(), nodes.end());
      ++number[nodes];
    }
  return number;
}

/// Every facet belongs to one element and the surface, or to two; and no node is there twice.
void expect_conforming(const Mesh& mesh) {
  std::size_t exterior = 0;
  for (const auto& [nodes, times] : occurrences(mesh)) {
    EXPECT_LE(times, 2);
    exterior += times == 1;
  }
  EXPECT_EQ(exterior_facets(mesh).size(), exterior);
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    for (std::size_t j = 0; j < i; ++j) ASSERT_GT(norm(mesh.points[i] - mesh.points[j]), 1e-3);
}

double area_of(const Mesh& mesh, const Facet& facet) {
  const auto shares = tributary_areas(mesh, facet);
  return shares[0] + shares[1] + shares[2] + shares[3];
}

/// Gradings that make a ball finest at its poles along z.
Gradings towards_poles(double ratio) {
  const Grading middle{Towards::middle, ratio};
  return {{middle, middle, {}}, {Towards::high, ratio}};
}

const std::vector<std::array<int, 2>> finenesses{{2, 1}, {3, 5}, {4, 2}, {8, 4}, {12, 3}, {5, 8}};

TEST(Ball, HasACoreAndShells) {
  for (const auto& [n, m] : finenesses) {
    const Mesh mesh = mesh_with(BallBody{unit, n, m});
    EXPECT_EQ(mesh.elements.size(), std::size_t(n * n * n + 6 * n * n * m));
    EXPECT_EQ(mesh.elements.size(), element_count(BallBody{unit, n, m}));
    EXPECT_EQ(mesh.nodes(), std::size_t((n + 1) * (n + 1) * (n + 1) + m * (6 * n * n + 2)));
  }
}

TEST(Ball, IsConforming) {
  for (const auto& [n, m] : {std::array{2, 1}, {3, 2}, {6, 3}})
    expect_conforming(mesh_with(BallBody{unit, n, m}));
}

TEST(Ball, HasItsSurfaceAtTheRadius) {
  const Vec3 centre{1, -2, 3};
  const Mesh mesh = mesh_with(BallBody{{centre, 2.5}, 6, 3}, towards_poles(3));
  const auto facets = exterior_facets(mesh);
  EXPECT_EQ(facets.size(), 6u * 6 * 6);
  for (const Facet& facet : facets)
    for (const std::int32_t node : facet.node) EXPECT_NEAR(norm(mesh.points[node] - centre), 2.5, 2e-15);
}

TEST(Ball, HasElementsOfGoodShape) {
  for (const auto& [n, m] : finenesses)
    EXPECT_GT(scaled_jacobian(mesh_with(BallBody{unit, n, m})), 0.65) << n;
  EXPECT_GT(scaled_jacobian(mesh_with(BallBody{unit, 24, 12})), 0.7);
  for (const double ratio : {2.0, 5.0, 20.0})
    for (const Towards z : {Towards::low, Towards::high, Towards::middle, Towards::ends}) {
      const Gradings gradings{{{{Towards::middle, ratio}, {Towards::low, ratio}, {z, ratio}}}, {z, ratio}};
      EXPECT_GT(scaled_jacobian(mesh_with(BallBody{unit, 8, 4}, gradings)), 0.6) << ratio;
    }
}

TEST(Ball, HasSurfaceElementsOfNearlyOneSize) {
  for (const auto& [n, m] : finenesses) {
    const Mesh mesh = mesh_with(BallBody{unit, n, m});
    double least = 1e9, most = 0;
    for (const Facet& facet : exterior_facets(mesh)) {
      least = std::min(least, area_of(mesh, facet)), most = std::max(most, area_of(mesh, facet));
    }
    EXPECT_LT(most / least, 1.45) << n;
  }
}

TEST(Ball, ApproachesTheSpheresVolumeWithTheSquareOfTheFineness) {
  const auto missing = [](int n) { return 4 * pi / 3 - volume_of(mesh_with(BallBody{unit, n, n / 2})); };
  EXPECT_GT(missing(4), 0);
  EXPECT_NEAR(missing(4) / missing(8), 4, 0.2);
  EXPECT_NEAR(missing(8) / missing(16), 4, 0.05);
}

using Place = std::array<double, 3>;

std::set<Place> places(const Mesh& mesh, const Place& sign) {
  std::set<Place> all;
  for (const Vec3 p : mesh.points)
    all.insert({sign[0] * p.x + 0.0, sign[1] * p.y + 0.0, sign[2] * p.z + 0.0});
  return all;
}

TEST(Ball, IsItsOwnMirrorImageToTheBit) {
  const Grading middle{Towards::middle, 3}, ends{Towards::ends, 2}, high{Towards::high, 4};
  for (const int n : {4, 5})
    for (const Gradings& gradings : {Gradings{}, Gradings{{middle, ends, middle}, high}}) {
      const Mesh mesh = mesh_with(BallBody{{{0, 0, 0}, 1.7}, n, 3}, gradings);
      const std::set<Place> all = places(mesh, {1, 1, 1});
      EXPECT_EQ(places(mesh, {-1, 1, 1}), all);
      EXPECT_EQ(places(mesh, {1, -1, 1}), all);
      EXPECT_EQ(places(mesh, {1, 1, -1}), all);
    }
}

TEST(Ball, CanBeCutAtItsPlanesOfSymmetry) {
  const Vec3 c{0.1, 0.7, 1000};
  const BallBody body{{c, 0.3}, 6, 3};
  const Grading middle{Towards::middle, 4};
  const Gradings gradings{{middle, middle, {Towards::ends, 3}}, {Towards::high, 3}};
  const Vec3 r{0.3, 0.3, 0.3};
  const std::vector<Box> minus{{c - r, {c.x, c.y + 0.3, c.z + 0.3}},
                               {{c.x, c.y - 0.3, c.z - 0.3}, {c.x + 0.3, c.y, c.z + 0.3}},
                               {{c.x, c.y, c.z - 0.3}, c + Vec3{0.3, 0.3, 0}}};
  const double whole = volume_of(mesh_with(body, gradings));
  for (std::size_t cuts = 1; cuts <= 3; ++cuts) {
    const Mesh mesh = mesh_with(body, gradings, {minus.begin(), minus.begin() + static_cast<long>(cuts)});
    EXPECT_EQ(mesh.elements.size(), std::size_t(element_count(body)) >> cuts);
    EXPECT_NEAR(volume_of(mesh) / whole, std::pow(0.5, cuts), 1e-9);
  }
}

TEST(Ball, CannotBeCutThroughElements) {
  const Box half{{-1, -1, -1}, {1, 1, 0}};
  EXPECT_THROW(mesh_with(BallBody{unit, 5, 2}, {}, {half}), std::invalid_argument);
  EXPECT_THROW(mesh_with(BallBody{unit, 6, 3}, {{{{}, {}, {Towards::high, 2}}}, {}}, {half}),
               std::invalid_argument);
  EXPECT_NO_THROW(mesh_with(BallBody{unit, 6, 3}, {}, {half}));
}

TEST(Ball, SharesTheNodesOfItsHalves) {
  const Hexahedra ball = mesh_of(BallBody{unit, 4, 2});
  Mesh mesh;
  append(mesh, {}, ball, {{{-1, -1, -1}, {1, 1, 0}}});
  append(mesh, {}, ball, {{{-1, -1, 0}, {1, 1, 1}}});
  EXPECT_EQ(mesh.nodes(), ball.points.size());
  expect_conforming(mesh);
}

TEST(Ball, IsFinestWhereItIsGradedTo) {
  const auto finest = [](const Mesh& mesh) {
    const auto facets = exterior_facets(mesh);
    const auto smaller = [&](const Facet& a, const Facet& b) { return area_of(mesh, a) < area_of(mesh, b); };
    return *std::min_element(facets.begin(), facets.end(), smaller);
  };
  const Mesh plain = mesh_with(BallBody{unit, 12, 6}),
             graded = mesh_with(BallBody{unit, 12, 6}, towards_poles(8));
  const Facet top = finest(graded);
  const Vec3 middle = hex8::map(hex8::corners(graded, top.element), {0, 0, 1});
  EXPECT_GT(std::abs(middle.z), 0.99);
  EXPECT_LT(area_of(graded, top), area_of(plain, finest(plain)) / 5);
  // As thin as it is wide.
  const double depth = hex8::volume(hex8::corners(graded, top.element)) / area_of(graded, top);
  EXPECT_NEAR(depth / std::sqrt(area_of(graded, top)), 0.8, 0.3);
}

TEST(Cylinder, HasACoreShellsAndLayers) {
  const CylinderBody body{{{0, 0, 0}, {0, 0, 3}, 1}, 4, 3, 5};
  const Mesh mesh = mesh_with(body);
  EXPECT_EQ(mesh.elements.size(), 5u * (16 + 4 * 4 * 3));
  EXPECT_EQ(mesh.elements.size(), element_count(body));
  EXPECT_EQ(mesh.nodes(), 6u * (25 + 16 * 3));
  EXPECT_EQ(exterior_facets(mesh).size(), 2u * (16 + 48) + 16 * 5);
  expect_conforming(mesh);
}

TEST(Cylinder, LiesAlongAnyAxis) {
  const Vec3 from{1, 2, 3};
  for (const Vec3 axis : {Vec3{2, 0, 0}, {0, 2, 0}, {0, 0, -2}, {1, -1, std::sqrt(2.0)}}) {
    const Cylinder shape{from, from + axis, 0.5};
    const Mesh mesh = mesh_with(CylinderBody{shape, 4, 2, 3});
    // A prism over a regular polygon of 16 sides.
    EXPECT_NEAR(volume_of(mesh), 2 * 0.25 * 8 * std::sin(2 * pi / 16), 1e-13);
    EXPECT_GT(scaled_jacobian(mesh), 0.7);
    for (const Facet& facet : exterior_facets(mesh))
      for (const std::int32_t node : facet.node) {
        const Vec3 p = mesh.points[node] - from;
        const double along = dot(p, axis) / 2, away = norm(p - (along / 2) * axis);
        const bool end = std::abs(along) < 1e-14 || std::abs(along - 2) < 1e-14;
        EXPECT_TRUE(end || std::abs(away - 0.5) < 1e-14) << along << " " << away;
        EXPECT_LT(away, 0.5 + 1e-14);
      }
  }
}

TEST(Cylinder, AcrossACoordinateAxisItsDirectionsAreTheOthers) {
  const Gradings gradings{{{{Towards::high, 3}, {Towards::low, 1}, {Towards::low, 3}}}, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    Vec3 to;
    to[c] = 2;
    const Mesh mesh = mesh_with(CylinderBody{{{0, 0, 0}, to, 1}, 4, 2, 4}, gradings);
    // Element 0 is at the low end of all three; element 3 at the high end of the first one.
    const auto first = hex8::corners(mesh, 0), last = hex8::corners(mesh, 3), above = hex8::corners(mesh, 48);
    EXPECT_GT(norm(first[1] - first[0]), norm(last[1] - last[0]));
    EXPECT_LT(hex8::map(first, {})[(c + 1) % 3], hex8::map(last, {})[(c + 1) % 3]);
    EXPECT_EQ(first[0][c], 0);
    EXPECT_GT(above[0][c], 0);
  }
}

TEST(Cylinder, CanBeQuarteredAndGraded) {
  const CylinderBody body{{{0, 0, -1}, {0, 0, 1}, 1}, 4, 3, 6};
  const Grading middle{Towards::middle, 4};
  const Gradings gradings{{middle, middle, {Towards::high, 5}}, {Towards::high, 2}};
  const Mesh whole = mesh_with(body, gradings);
  EXPECT_GT(scaled_jacobian(whole), 0.6);
  const std::set<Place> all = places(whole, {1, 1, 1});
  EXPECT_EQ(places(whole, {-1, 1, 1}), all);
  EXPECT_EQ(places(whole, {1, -1, 1}), all);
  const Mesh quarter = mesh_with(body, gradings, {{{-1, -1, -1}, {0, 1, 1}}, {{0, -1, -1}, {1, 0, 1}}});
  EXPECT_EQ(quarter.elements.size() * 4, whole.elements.size());
  EXPECT_NEAR(volume_of(quarter) * 4, volume_of(whole), 1e-13);
}

TEST(GradedBlock, HasItsPlanesWhereTheStationsAre) {
  const Gradings gradings{{{{Towards::high, 4}, {Towards::middle, 2}, {Towards::low, 1}}}, {}};
  const Mesh mesh = mesh_with(BlockBody{corners_of({{0, 0, 0}, {2, 2, 2}}), {5, 4, 3}}, gradings);
  const std::vector<double> x = stations(5, {Towards::high, 4}), y = stations(4, {Towards::middle, 2});
  ASSERT_EQ(mesh.elements.size(), 60u);
  for (int e = 0; e < 60; ++e) {
    const Vec3 low = mesh.points[mesh.elements[e][0]], high = mesh.points[mesh.elements[e][6]];
    const int i = e % 5, j = e / 5 % 4, k = e / 20;
    EXPECT_LT(norm(low - Vec3{1 + x[i], 1 + y[j], 2 * k / 3.0}), 1e-14);
    EXPECT_LT(norm(high - Vec3{1 + x[i + 1], 1 + y[j + 1], 2 * (k + 1) / 3.0}), 1e-14);
  }
  EXPECT_NEAR(volume_of(mesh), 8, 1e-13);
}

}  // namespace
}  // namespace geist
