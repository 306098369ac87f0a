// Surfaces: which facets, who is beside whom, and what they stand for.
#include "contact/surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "contact/support.hpp"
#include "geometry/block.hpp"

namespace geist::contact {
namespace {

using namespace testing;

/// Neighbours share the edge, run along it the other way, and know each other; returns how many edges end.
int expect_neighbours(const Surface& surface) {
  int ends = 0;
  for (std::size_t f = 0; f < surface.facets.size(); ++f)
    for (int k = 0; k < 4; ++k) {
      const SurfaceFacet& facet = surface.facets[f];
      if (facet.across[k] < 0) {
        ++ends;
        continue;
      }
      const SurfaceFacet& other = surface.facets[facet.across[k]];
      bool mutual = false;
      for (int j = 0; j < 4; ++j)
        mutual |= other.corner[j] == facet.corner[(k + 1) % 4] &&
                  other.corner[(j + 1) % 4] == facet.corner[k] &&
                  other.across[j] == static_cast<std::int32_t>(f);
      EXPECT_TRUE(mutual) << f << ' ' << k;
    }
  return ends;
}

void expect_around(const Surface& surface) {
  std::size_t listed = 0;
  for (std::size_t i = 0; i < surface.nodes.size(); ++i)
    for (std::int32_t s = surface.around_begin[i]; s < surface.around_begin[i + 1]; ++s, ++listed)
      EXPECT_EQ(surface.facets[surface.around[s] / 4].corner[surface.around[s] % 4], static_cast<int>(i));
  EXPECT_EQ(listed, 4 * surface.facets.size());
  EXPECT_TRUE(std::is_sorted(surface.nodes.begin(), surface.nodes.end()));
}

double area_of(const Surface& surface) {
  double area = 0;
  for (const SurfaceFacet& facet : surface.facets) area += facet.area;
  return area;
}

TEST(Surface, OfABlockWithAHoleHasNoEnd) {
  Builder builder;
  builder.hexahedra({{0, 0, 0}, {3, 3, 1}}, {6, 6, 2}, {{{1, 1, -1}, {2, 2, 2}}});
  const Probed body(builder);
  EXPECT_EQ(expect_neighbours(body.surface), 0);
  expect_around(body.surface);
  EXPECT_NEAR(area_of(body.surface), 2 * 8 + 12 + 4, 1e-12);
  for (const SurfaceFacet& facet : body.surface.facets) EXPECT_NEAR(facet.depth, 0.25, 1e-14);
}

TEST(Surface, OfBlocksThatMeetInAnEdgeEndsThere) {
  Builder builder;
  builder.hexahedra({{0, 0, 0}, {2, 1, 2}}, {2, 1, 2}, {{{0, -1, 1}, {1, 2, 3}}, {{1, -1, -1}, {2, 2, 1}}});
  const Probed body(builder);
  EXPECT_EQ(expect_neighbours(body.surface), 4);
}

TEST(Surface, TellsBodiesApart) {
  Builder builder;
  builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {2, 2, 2})
      .hexahedra({{0, 0, 1}, {1, 1, 2}}, {2, 2, 2})       // shares nodes
      .hexahedra({{0, 0, 2.001}, {1, 1, 3}}, {2, 2, 2});  // does not
  const Probed body(builder);
  std::set<std::int32_t> bodies[3];
  for (const SurfaceFacet& facet : body.surface.facets) bodies[facet.region].insert(facet.body);
  for (const auto& each : bodies) EXPECT_EQ(each.size(), 1u);
  EXPECT_EQ(bodies[0], bodies[1]);
  EXPECT_NE(bodies[0], bodies[2]);
  EXPECT_NEAR(area_of(body.surface), 10 + 2 + 4 * 0.999, 1e-12);
}

TEST(Surface, LeavesOutWhatACoupledLatticeTouches) {
  Builder builder;
  builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {4, 4, 4}).particles({{0, 0, 1}, {0.5, 1, 2}}, 0.125);
  const Probed apart(builder);
  EXPECT_EQ(apart.surface.facets.size(), 96u);  // not coupled: all may be touched
  builder.coupled();
  const Probed body(builder);
  EXPECT_EQ(body.surface.facets.size(), 96u - 8);
  for (const SurfaceFacet& facet : body.surface.facets) {
    const FacetPoints at = points_of(facet, body.x);
    EXPECT_FALSE(at.centre.z > 0.99 && at.centre.x < 0.5);
  }
  EXPECT_EQ(expect_neighbours(body.surface), 2 + 2 + 4 + 4);
}

TEST(Surface, FacesOutward) {
  Builder builder;
  builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {2, 3, 2}, {{{0, 0.3333333333, 0.5}, {0.5, 0.66666666667, 1}}});
  const Probed body(builder);
  double volume = 0;  // divergence theorem
  for (const SurfaceFacet& facet : body.surface.facets) {
    const FacetPoints at = points_of(facet, body.x);
    for (int k = 0; k < 4; ++k) volume += dot(at.centre, triangle_normal(at, k)) / 6;
  }
  EXPECT_NEAR(volume, 11.0 / 12, 1e-9);
  const Vec3 n = node_normal(body.surface, body.x, 0);
  EXPECT_NEAR(n.x, n.z, 1e-14);
  EXPECT_NEAR(n.y, n.z, 1e-14);
  EXPECT_LT(n.z, 0);
}

}  // namespace
}  // namespace geist::contact
