// Blocks of hexahedra: counts, places, shared nodes, holes, surfaces.
#include "geometry/block.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <stdexcept>

#include "geometry/hex8.hpp"

namespace geist {
namespace {

const Box unit{{0, 0, 0}, {1, 1, 1}};

/// A block none of whose faces is flat.
std::array<Vec3, 8> crooked(Vec3 offset = {}) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> shift(-0.15, 0.15);
  std::array<Vec3, 8> corners = corners_of({{0, 0, 0}, {2, 1.5, 1}});
  for (Vec3& p : corners) p += offset + Vec3{shift(random), shift(random), shift(random)};
  return corners;
}

/// Σ area vectors, Σ areas and, by the divergence theorem, the volume within the exterior facets.
struct Surface {
  Vec3 vector;
  double area = 0, volume = 0;
  std::size_t facets = 0;
};

Surface surface_of(const Mesh& mesh) {
  Surface s;
  for (const Facet& facet : exterior_facets(mesh)) {
    const auto p = [&](int a) { return mesh.points[facet.node[a]]; };
    const double g = 1 / std::sqrt(3.0);
    for (const double a : {(1 - g) / 2, (1 + g) / 2})  // Gauss on [0, 1]², exact for bilinear facets
      for (const double b : {(1 - g) / 2, (1 + g) / 2}) {
        const Vec3 x = (1 - a) * ((1 - b) * p(0) + b * p(3)) + a * ((1 - b) * p(1) + b * p(2));
        const Vec3 along = (1 - b) * (p(1) - p(0)) + b * (p(2) - p(3));
        const Vec3 up = (1 - a) * (p(3) - p(0)) + a * (p(2) - p(1));
        const Vec3 normal = 0.25 * cross(along, up);
        s.vector += normal, s.area += norm(normal), s.volume += dot(x, normal) / 3;
      }
    ++s.facets;
  }
  return s;
}

double volume_of(const Mesh& mesh) {
  double v = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) v += hex8::volume(hex8::corners(mesh, e));
  return v;
}

template <class F>
std::string error_of(F action) {
  try {
    action();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "no error";
}

TEST(Block, CornersOfABoxAreInVtksOrder) {
  const auto c = corners_of({{1, 2, 3}, {4, 6, 8}});
  const std::array<Vec3, 8> expected{
      {{1, 2, 3}, {4, 2, 3}, {4, 6, 3}, {1, 6, 3}, {1, 2, 8}, {4, 2, 8}, {4, 6, 8}, {1, 6, 8}}};
  EXPECT_EQ(c, expected);
}

TEST(Block, HasItsElementsAndNodesWhereTheTrilinearMapPutsThem) {
  const auto c = crooked();
  const std::array<int, 3> n{4, 3, 2};
  Mesh mesh;
  HexRegion region;
  region.name = "a";
  append_block(mesh, region, c, n);
  EXPECT_EQ(mesh.elements.size(), 24u);
  EXPECT_EQ(mesh.nodes(), 5u * 4 * 3);
  EXPECT_EQ(mesh.regions[0].name, "a");
  EXPECT_EQ(mesh.regions[0].first, 0u);
  EXPECT_EQ(mesh.regions[0].count, 24u);
  // Interpolate along x, then y, then z, in place of shape functions.
  const auto mix = [](Vec3 p, Vec3 q, double s) { return (1 - s) * p + s * q; };
  const auto at = [&](double x, double y, double z) {
    const Vec3 bottom = mix(mix(c[0], c[1], x), mix(c[3], c[2], x), y);
    return mix(bottom, mix(mix(c[4], c[5], x), mix(c[7], c[6], x), y), z);
  };
  const int step[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                          {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (int e = 0; e < 24; ++e) {
    const int i = e % 4, j = e / 4 % 3, k = e / 12;
    for (int a = 0; a < 8; ++a) {
      const Vec3 expected = at((i + step[a][0]) / 4.0, (j + step[a][1]) / 3.0, (k + step[a][2]) / 2.0);
      EXPECT_LT(norm(mesh.points[mesh.elements[e][a]] - expected), 1e-14);
    }
  }
}

TEST(Block, SharesNodesWithTheOneThatItTouches) {
  Mesh mesh;
  const Vec3 far{1000, -1000, 1000};  // where rounding of positions is larger
  append_block(mesh, {}, corners_of({far, far + Vec3{7, 2, 2}}), {14, 4, 4});
  append_block(mesh, {}, corners_of({far + Vec3{7, 0, 0}, far + Vec3{8, 2, 2}}), {3, 4, 4});
  append_block(mesh, {}, corners_of({far + Vec3{9, 0, 0}, far + Vec3{10, 2, 2}}), {3, 4, 4});
  EXPECT_EQ(mesh.nodes(), 15u * 25 + 3 * 25 + 4 * 25);
  EXPECT_EQ(mesh.regions[1].first, 14u * 16);
  std::size_t shared = 0;
  const auto& first = mesh.regions[0];
  std::set<std::int32_t> of_first;
  for (std::size_t e = 0; e < first.count; ++e)
    of_first.insert(mesh.elements[e].begin(), mesh.elements[e].end());
  for (std::int32_t n = 0; n < static_cast<std::int32_t>(mesh.nodes()); ++n) {
    bool in_second = false;
    for (std::size_t e = mesh.regions[1].first; e < mesh.regions[2].first; ++e)
      in_second = in_second || std::count(mesh.elements[e].begin(), mesh.elements[e].end(), n);
    shared += in_second && of_first.contains(n);
    if (in_second && of_first.contains(n)) {
      EXPECT_NEAR(mesh.points[n].x, 1007, 1e-9);
    }
  }
  EXPECT_EQ(shared, 25u);
}

TEST(Block, LeavesOutWhatIsCutOut) {
  Mesh mesh;
  append_block(mesh, {}, corners_of({{0, 0, 0}, {4, 4, 4}}), {4, 4, 4}, {{{1, 1, 1}, {3, 3, 3}}});
  EXPECT_EQ(mesh.elements.size(), 64u - 8);
  EXPECT_EQ(mesh.nodes(), 125u - 1);  // the node in the middle is gone
  EXPECT_NEAR(volume_of(mesh), 56, 1e-12);
  Mesh tunnel;
  append_block(tunnel, {}, corners_of({{0, 0, 0}, {4, 4, 4}}), {4, 4, 4},
               {{{-1, 1, 1}, {2, 3, 3}}, {{2, 1, 1}, {5, 3, 3}}});
  EXPECT_EQ(tunnel.elements.size(), 64u - 16);
}

TEST(Block, RefusesWhatCannotBe) {
  const auto append = [](std::array<Vec3, 8> corners, const std::vector<Box>& minus) {
    return error_of([&] {
      Mesh mesh;
      append_block(mesh, {}, corners, {2, 2, 2}, minus);
    });
  };
  auto inside_out = corners_of(unit);
  for (int a = 0; a < 4; ++a) std::swap(inside_out[a], inside_out[a + 4]);
  EXPECT_NE(append(inside_out, {}).find("turned inside out"), std::string::npos);
  EXPECT_NE(append(corners_of({{0, 0, 0}, {1, 1, 0}}), {}).find("flat"), std::string::npos);
  EXPECT_EQ(append(corners_of(unit), {unit}), "no element is left");
  const std::string cut = append(corners_of(unit), {{{0, 0, 0}, {0.6, 0.5, 0.5}}});
  EXPECT_NE(cut.find("cuts through"), std::string::npos);
  EXPECT_NE(cut.find("(0.75, 0.25, 0.25)"), std::string::npos) << cut;
  EXPECT_EQ(append(corners_of(unit), {{{0, 0, 0}, {0.5, 0.5, 0.5}}}), "no error");
}

TEST(Block, RefusesCutsThatMissEveryCornerAndCentre) {
  const std::vector<Box> cuts{{{0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}},    // within one element
                              {{0.1, -1, -1}, {0.2, 2, 2}},          // a slab between its corners
                              {{-1, 0.1, 0.1}, {2, 0.2, 0.2}},       // a bar through it
                              {{0.9, 0.1, 0.1}, {1.1, 0.15, 0.2}}};  // into it from outside
  for (const Box& cut : cuts) {
    Mesh mesh;
    EXPECT_THROW(append_block(mesh, {}, corners_of(unit), {2, 2, 2}, {cut}), std::invalid_argument);
  }
}

TEST(Block, CutsThatOnlyTouchOrAreElsewhereAreFine) {
  for (const Box& cut :
       {Box{{1, 0, 0}, {2, 1, 1}}, Box{{5, 5, 5}, {6, 6, 6}}, Box{{0, 0, 1}, {0.3, 0.3, 2}}}) {
    Mesh mesh;
    append_block(mesh, {}, corners_of(unit), {2, 2, 2}, {cut});
    EXPECT_EQ(mesh.elements.size(), 8u);
  }
}

TEST(Facets, OfABoxAreItsSurface) {
  Mesh mesh;
  append_block(mesh, {}, corners_of({{1, 1, 1}, {3, 4, 5}}), {2, 3, 4});
  const Surface s = surface_of(mesh);
  EXPECT_EQ(s.facets, 2u * (6 + 8 + 12));
  EXPECT_NEAR(s.area, 2 * (2 * 3 + 2 * 4 + 3 * 4), 1e-12);
  EXPECT_LT(norm(s.vector), 1e-12);
  EXPECT_NEAR(s.volume, 24, 1e-11);  // positive: seen from outside counter-clockwise
}

TEST(Facets, EncloseTheVolumeOfAnyMesh) {
  Mesh mesh;
  const Vec3 offset{5, 5, 5};
  append_block(mesh, {}, crooked(offset), {3, 4, 2});
  const Surface one = surface_of(mesh);
  EXPECT_LT(norm(one.vector), 1e-12);
  EXPECT_NEAR(one.volume, volume_of(mesh), 1e-11);
  append_block(mesh, {}, corners_of({{20, 0, 0}, {24, 4, 4}}), {4, 4, 4}, {{{21, 1, 1}, {23, 3, 3}}});
  const Surface both = surface_of(mesh);
  EXPECT_EQ(both.facets, one.facets + 6 * 16 + 6 * 4);
  EXPECT_LT(norm(both.vector), 1e-11);
  EXPECT_NEAR(both.volume, volume_of(mesh), 1e-10);
}

TEST(Facets, SharedByTwoRegionsAreInside) {
  Mesh mesh;
  append_block(mesh, {}, corners_of(unit), {2, 2, 2});
  append_block(mesh, {}, corners_of({{1, 0, 0}, {2, 1, 1}}), {2, 2, 2});
  EXPECT_EQ(exterior_facets(mesh).size(), 4u * 8 + 2 * 4);
  EXPECT_NEAR(surface_of(mesh).area, 10, 1e-13);
}

TEST(TributaryAreas, AddUpToTheAreaAndKeepItsCentroid) {
  // A plane quadrilateral, split into triangles for area and centroid.
  const std::array<Vec3, 4> p{{{0, 0, 0}, {3, 0, 0}, {2, 2, 0}, {0.5, 1.5, 0}}};
  Mesh mesh;
  for (const Vec3 q : p) mesh.points.push_back({q.x, 0.6 * q.y, 0.8 * q.y});  // turned about x
  const auto areas = tributary_areas(mesh, Facet{0, {0, 1, 2, 3}});
  const double t1 = (3 * 2 - 0) / 2.0, t2 = (2 * 1.5 - 0.5 * 2) / 2.0;
  const Vec3 moment = t1 * (p[0] + p[1] + p[2]) * (1 / 3.0) + t2 * (p[0] + p[2] + p[3]) * (1 / 3.0);
  double area = 0;
  Vec3 found;
  for (int a = 0; a < 4; ++a) area += areas[a], found += areas[a] * p[a];
  EXPECT_NEAR(area, t1 + t2, 1e-14);
  EXPECT_LT(norm(found - moment), 1e-14);  // ∫ x dA = Σ x_a ∫ N_a dA
}

TEST(TributaryAreas, OfARectangleAreQuarters) {
  Mesh mesh;
  mesh.points = {{0, 0, 1}, {0, 2, 1}, {0, 2, 4}, {0, 0, 4}};
  for (const double a : tributary_areas(mesh, Facet{0, {0, 1, 2, 3}})) EXPECT_NEAR(a, 1.5, 1e-15);
}

}  // namespace
}  // namespace geist
