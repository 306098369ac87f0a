// Locator against trying every element.
#include "geometry/locator.hpp"

#include <gtest/gtest.h>

#include <random>

#include "geometry/block.hpp"
#include "geometry/hex8.hpp"

namespace geist {
namespace {

/// Two blocks of very different element sizes, inner nodes moved about.
Mesh distorted_mesh(Vec3 offset = {}) {
  std::array<Vec3, 8> corners = corners_of({offset, offset + Vec3{4, 3, 2}});
  corners[6] += Vec3{0.5, 0.4, 0.3}, corners[0] -= Vec3{0.2, 0.4, 0.1};
  Mesh mesh;
  append_block(mesh, {}, corners, {4, 3, 2});
  append_block(mesh, {}, corners_of({offset + Vec3{-2, 0, 0}, offset + Vec3{-1, 1, 1}}), {8, 8, 8});
  std::mt19937 random(4);
  for (std::size_t i = 0; i < mesh.nodes(); ++i) {
    const double size = i < 60 ? 0.1 : 0.01;  // the coarse block has 5 × 4 × 3 nodes
    std::uniform_real_distribution<double> shift(-size, size);
    mesh.points[i] += Vec3{shift(random), shift(random), shift(random)};
  }
  return mesh;
}

std::optional<Location> try_all(const Mesh& mesh, Vec3 p, double slack) {
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto found = hex8::inverse_map(hex8::corners(mesh, e), p);
    if (found.converged && hex8::contains(found.xi, slack))
      return Location{static_cast<std::int32_t>(e), found.xi};
  }
  return std::nullopt;
}

TEST(Locator, FindsPointsOfEveryElement) {
  for (const Vec3 offset : {Vec3{}, Vec3{-300, 200, 1000}}) {
    const Mesh mesh = distorted_mesh(offset);
    const Locator locator(mesh);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> natural(-0.999, 0.999);
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      for (int i = 0; i < 5; ++i) {
        const Vec3 xi{natural(random), natural(random), natural(random)};
        const auto found = locator.find(hex8::map(hex8::corners(mesh, e), xi));
        ASSERT_TRUE(found);
        EXPECT_EQ(found->element, static_cast<std::int32_t>(e));
        EXPECT_LT(norm(found->xi - xi), 1e-9);  // positions are good to 1e-13 of elements of 0.1
      }
  }
}

TEST(Locator, AgreesWithTryingAllElements) {
  const Mesh mesh = distorted_mesh();
  const Locator locator(mesh);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> x(-3, 6), y(-1.5, 4.5), z(-1, 4);
  int inside = 0, outside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p{x(random), y(random), z(random)};
    const auto found = locator.find(p), expected = try_all(mesh, p, 1e-7);
    ASSERT_EQ(found.has_value(), expected.has_value());
    ++(found ? inside : outside);
    if (!found) continue;
    EXPECT_EQ(found->element, expected->element);
    EXPECT_LT(norm(hex8::map(hex8::corners(mesh, found->element), found->xi) - p), 1e-12);
  }
  EXPECT_GT(inside, 300);
  EXPECT_GT(outside, 300);
}

TEST(Locator, FindsPointsOnFacesEdgesAndCorners) {
  const Mesh mesh = distorted_mesh();
  const Locator locator(mesh);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const double a : {-1.0, 0.0, 1.0})
      for (const double b : {-1.0, 0.0, 1.0})
        for (const double c : {-1.0, 0.0, 1.0}) {
          const Vec3 p = hex8::map(hex8::corners(mesh, e), {a, b, c});
          const auto found = locator.find(p);
          ASSERT_TRUE(found);
          EXPECT_LE(found->element, static_cast<std::int32_t>(e));  // the first of those that share it
          EXPECT_LT(norm(hex8::map(hex8::corners(mesh, found->element), found->xi) - p), 1e-12);
        }
}

TEST(Locator, HonoursItsSlack) {
  Mesh mesh;
  append_block(mesh, {}, corners_of({{0, 0, 0}, {1, 1, 1}}), {1, 1, 1});
  const Locator locator(mesh);
  const Vec3 just_outside{1 + 1e-7, 0.5, 0.5}, just_inside{1 - 1e-7, 0.5, 0.5};  // ξ = 1 ± 2e-7
  EXPECT_FALSE(locator.find(just_outside));
  EXPECT_TRUE(locator.find(just_outside, 1e-6));
  EXPECT_TRUE(locator.find(just_inside));
  EXPECT_FALSE(locator.find(just_inside, -1e-6));
}

TEST(Locator, AvoidsElementsOfAStranger) {
  Mesh mesh;
  append_block(mesh, {}, corners_of({{0, 0, 0}, {2, 1, 1}}), {2, 1, 1});
  const Locator locator(mesh);
  const std::int32_t shared = mesh.elements[0][1], of_first_only = mesh.elements[0][0];
  const Vec3 on_shared_face{1, 0.5, 0.5};
  EXPECT_EQ(locator.find(on_shared_face)->element, 0);
  EXPECT_EQ(locator.find(on_shared_face, 1e-7, of_first_only)->element, 1);
  EXPECT_FALSE(locator.find(on_shared_face, 1e-7, shared));
}

TEST(Locator, FindsTheFirstBeforeAnElement) {
  Mesh mesh;
  append_block(mesh, {}, corners_of({{0, 0, 0}, {2, 1, 1}}), {2, 1, 1});
  append_block(mesh, {}, corners_of({{0.5, 0, 0}, {1.5, 1, 1}}), {1, 1, 1});
  const Locator locator(mesh);
  const Vec3 p{0.75, 0.4, 0.6};  // in elements 0 and 2
  EXPECT_FALSE(locator.find_before(0, p));
  EXPECT_EQ(locator.find_before(2, p)->element, 0);
  EXPECT_EQ(locator.find(p)->element, 0);
  EXPECT_FALSE(locator.find_before(1, {1.75, 0.4, 0.6}));
}

/// Two specks at the ends of a long diagonal, and a plate askew: far fewer cells than their boxes would hold.
TEST(Locator, CopesWithEmptyBoxes) {
  Mesh mesh;
  append_block(mesh, {}, corners_of({{0, 0, 0}, {1, 1, 1}}), {4, 4, 4});
  append_block(mesh, {}, corners_of({{1e6, 1e6, 1e6}, {1e6 + 1, 1e6 + 1, 1e6 + 1}}), {4, 4, 4});
  std::array<Vec3, 8> askew = corners_of({{0, 0, 10}, {40, 40, 10.5}});
  for (Vec3& p : askew) p.z += p.x + p.y;
  append_block(mesh, {}, askew, {80, 80, 1});
  const Locator locator(mesh);
  for (std::size_t e = 0; e < mesh.elements.size(); e += 7) {
    const auto found = locator.find(hex8::map(hex8::corners(mesh, e), {0.3, -0.2, 0.1}));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->element, static_cast<std::int32_t>(e));
  }
}

TEST(Locator, OfNothingFindsNothing) {
  const Mesh mesh;
  const Locator locator(mesh);
  EXPECT_FALSE(locator.find({0, 0, 0}));
}

}  // namespace
}  // namespace geist
