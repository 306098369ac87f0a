// Flush cubic packing: how many particles, and exactly where.
#include "geometry/packing.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace geist {
namespace {

Lattice packed(const std::vector<Box>& boxes, double radius, const std::vector<Shape>& minus = {}) {
  Lattice lattice;
  pack(lattice, boxes, minus, radius);
  return lattice;
}

/// Centres of all sites with the flag, in units of a hundredth of the radius.
std::set<std::array<long, 3>> centres(const Lattice& lattice, std::uint32_t flag) {
  std::set<std::array<long, 3>> found;
  for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
    if (!lattice.is(s, flag)) continue;
    const Vec3 p = (100 / lattice.radius()) * lattice.grid.centre(s);
    found.insert({std::lround(p.x), std::lround(p.y), std::lround(p.z)});
  }
  return found;
}

/// Centres of the cubes of edge 2r on the grid through `corner` that satisfy `inside`, found by trying a
/// large region.
template <class F>
std::set<std::array<long, 3>> expected_centres(Vec3 corner, double r, F inside) {
  std::set<std::array<long, 3>> found;
  for (int i = -40; i < 40; ++i)
    for (int j = -40; j < 40; ++j)
      for (int k = -40; k < 40; ++k) {
        const Vec3 p = corner + r * Vec3{2.0 * i + 1, 2.0 * j + 1, 2.0 * k + 1};
        if (inside(p))
          found.insert({std::lround(100 * p.x / r), std::lround(100 * p.y / r), std::lround(100 * p.z / r)});
      }
  return found;
}

bool in_box(Vec3 p, Vec3 a, Vec3 b) {
  return p.x > a.x && p.y > a.y && p.z > a.z && p.x < b.x && p.y < b.y && p.z < b.z;
}

TEST(Packing, FillsABoxFlush) {
  const Lattice lattice = packed({{{7, 0, 0}, {13, 2, 2}}}, 0.1);
  EXPECT_EQ(lattice.count(site::particle), 30u * 10 * 10);
  EXPECT_DOUBLE_EQ(lattice.grid.pitch, 0.2);
  EXPECT_EQ(centres(lattice, site::particle), expected_centres({7, 0, 0}, 0.1, [](Vec3 p) {
              return in_box(p, {7, 0, 0}, {13, 2, 2});
            }));
  for (std::size_t s = 0; s < lattice.grid.size(); ++s)
    EXPECT_TRUE(lattice.word[s] == 0 || lattice.word[s] == (site::particle | site::free));
}

TEST(Packing, FitsRadiiThatAreNoBinaryFractions) {
  for (const int n : {1, 3, 7, 11, 30}) {
    const Lattice lattice = packed({{{0, 0, 0}, {1, 2, 1}}}, 0.5 / n);
    EXPECT_EQ(lattice.count(site::particle), static_cast<std::size_t>(2 * n * n * n));
  }
}

TEST(Packing, LeavesALayerOfEmptySitesAround) {
  const Lattice lattice = packed({{{0, 0, 0}, {1, 2, 3}}}, 0.5);
  const Grid& grid = lattice.grid;
  EXPECT_EQ(grid.nx, 3);
  EXPECT_EQ(grid.ny, 4);
  EXPECT_EQ(grid.nz, 5);
  for (std::size_t s = 0; s < grid.size(); ++s) {
    const auto [i, j, k] = grid.ijk(s);
    const bool within = i == 1 && j >= 1 && j <= 2 && k >= 1 && k <= 3;
    EXPECT_EQ(lattice.is(s, site::particle), within);
  }
}

TEST(Packing, FillsUnionsOnce) {
  const Box low{{0, 0, 0}, {2, 1, 1}}, over{{1, 0, 0}, {2, 3, 1}}, apart{{3, 0, -1}, {4, 1, 0}};
  const Lattice lattice = packed({low, over, apart}, 0.125);
  EXPECT_EQ(lattice.count(site::particle), (2u + 3 - 1 + 1) * 64);
  EXPECT_EQ(centres(lattice, site::particle), expected_centres({0, 0, 0}, 0.125, [](Vec3 p) {
              return in_box(p, {0, 0, 0}, {2, 1, 1}) || in_box(p, {1, 0, 0}, {2, 3, 1}) ||
                     in_box(p, {3, 0, -1}, {4, 1, 0});
            }));
}

TEST(Packing, LeavesOutSitesWhoseCentreIsCutOut) {
  const double r = 0.05;
  const std::vector<Shape> minus{Cylinder{{0.5, 0.5, -1}, {0.5, 0.5, 0.501}, 0.302}, Ball{{1, 1, 1}, 0.407},
                                 Box{{-1, -1, 0.86}, {0.33, 2, 2}}};
  const auto expected = expected_centres({0, 0, 0}, r, [](Vec3 p) {
    const bool cylinder = std::hypot(p.x - 0.5, p.y - 0.5) < 0.302 && p.z < 0.501;
    const bool ball = std::hypot(p.x - 1, p.y - 1, p.z - 1) < 0.407;
    return in_box(p, {0, 0, 0}, {1, 1, 1}) && !cylinder && !ball && !(p.x < 0.33 && p.z > 0.86);
  });
  EXPECT_EQ(centres(packed({{{0, 0, 0}, {1, 1, 1}}}, r, minus), site::particle), expected);
  EXPECT_LT(expected.size(), 900u);
}

TEST(Packing, RefusesBoxesThatAreOffTheGrid) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_THROW(packed({box}, 0.15), std::invalid_argument);
  EXPECT_THROW(packed({{{0, 0, 0}, {1, 1, 1.05}}}, 0.1), std::invalid_argument);
  EXPECT_THROW(packed({box, {{1.1, 0, 0}, {2.1, 1, 1}}}, 0.1), std::invalid_argument);
  EXPECT_THROW(packed({{{0, 0, 0}, {1, 1, 0}}}, 0.1), std::invalid_argument);
  EXPECT_NO_THROW(packed({box, {{1.2, 0, 0}, {2.2, 1, 1}}}, 0.1));
  EXPECT_NO_THROW(packed({{{0, 0, 0}, {1 + 1e-10, 1, 1}}}, 0.1));
}

TEST(Trim, KeepsSitesAndGhostsWhereTheyAre) {
  Lattice lattice = packed({{{0, 0, 0}, {3, 2, 1}}, {{4, 3, 2}, {5, 4, 3}}}, 0.25);
  const std::size_t ghost_site = lattice.grid.index(0, 2, 1);
  lattice.word[ghost_site] = site::ghost;
  lattice.ghosts.push_back({ghost_site, 3, {}, {}});
  const Vec3 ghost_at = lattice.grid.centre(ghost_site);
  const auto particles = centres(lattice, site::particle);
  trim(lattice);
  EXPECT_EQ(lattice.grid.nx, 11);  // ten particles' cells and the ghost's
  EXPECT_EQ(lattice.grid.ny, 8);
  EXPECT_EQ(lattice.grid.nz, 6);
  EXPECT_EQ(lattice.word.size(), lattice.grid.size());
  EXPECT_EQ(centres(lattice, site::particle), particles);
  EXPECT_EQ(lattice.count(site::ghost), 1u);
  EXPECT_TRUE(lattice.is(lattice.ghosts[0].site, site::ghost));
  EXPECT_LT(norm(lattice.grid.centre(lattice.ghosts[0].site) - ghost_at), 1e-15);
}

TEST(Trim, TakesAwayAllMarginsOfALonelyBox) {
  Lattice lattice = packed({{{0, 0, 0}, {1, 1, 1}}}, 0.5, {});
  trim(lattice);
  EXPECT_EQ(lattice.grid.nx * lattice.grid.ny * lattice.grid.nz, 1);
  EXPECT_EQ(lattice.grid.centre(0), (Vec3{0.5, 0.5, 0.5}));
}

}  // namespace
}  // namespace geist
