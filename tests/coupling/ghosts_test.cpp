// Ghosts: where they are on interfaces of every kind.
#include "coupling/ghosts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "coupling/support.hpp"
#include "geometry/hex8.hpp"

namespace geist::coupling {
namespace {

using namespace testing;

/// Every empty cell of the grid through `corner` within a bond's reach of a particle, as `particle(p)` and
/// `hexahedra(p)` say of centres, found by trying a large region.
template <class P, class H>
std::vector<Vec3> expected_ghosts(Vec3 corner, double r, P particle, H hexahedra) {
  std::vector<Vec3> found;
  constexpr int reach = 30;
  for (int i = -reach; i < reach; ++i)
    for (int j = -reach; j < reach; ++j)
      for (int k = -reach; k < reach; ++k) {
        const Vec3 p = corner + r * Vec3{2.0 * i + 1, 2.0 * j + 1, 2.0 * k + 1};
        if (particle(p) || !hexahedra(p)) continue;
        bool near = false;
        for (int n = 0; n < 27 && !near; ++n) {
          const Vec3 step{n % 3 - 1.0, n / 3 % 3 - 1.0, n / 9 - 1.0};
          near = dot(step, step) < 2.5 && particle(p + 2 * r * step);
        }
        if (near) found.push_back(p);
      }
  return found;
}

bool in(Vec3 p, const Box& b) { return contains(b, p); }

void expect_ghosts_follow_their_hexahedra(const Model& model) {
  for (const Lattice& lattice : model.lattices)
    for (const Ghost& ghost : lattice.ghosts) {
      EXPECT_EQ(lattice.word[ghost.site] & ~site::bonds, +site::ghost);
      const auto x = hex8::corners(model.mesh, ghost.element);
      Vec3 by_shape;
      double sum = 0;
      for (int a = 0; a < 8; ++a) by_shape += ghost.nodes[a].N * x[a], sum += ghost.nodes[a].N;
      EXPECT_LT(norm(by_shape - lattice.grid.centre(ghost.site)), 1e-12);
      EXPECT_NEAR(sum, 1, 1e-14);
      for (const GhostNode& I : ghost.nodes) EXPECT_GE(I.N, -1e-7);
    }
}

TEST(Ghosts, OfThePublishedBeamAreMirrorImagesOfItsBoundaryParticles) {
  const double r = 0.1;
  const Model model = Builder()
                          .hexahedra("left", {{5, 0, 0}, {7, 2, 2}}, {4, 4, 4})
                          .particles("middle", {{{7, 0, 0}, {13, 2, 2}}}, r)
                          .hexahedra("right", {{13, 0, 0}, {15, 2, 2}}, {4, 4, 4})
                          .couple();
  const Lattice& lattice = model.lattices[0];
  std::vector<Vec3> mirrored;  // x_g = x_d − 2 r n (6)
  for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
    const Vec3 x = lattice.grid.centre(s);
    if (!lattice.is(s, site::particle)) continue;
    if (x.x < 7.15) mirrored.push_back(x - Vec3{2 * r, 0, 0});
    if (x.x > 12.85) mirrored.push_back(x + Vec3{2 * r, 0, 0});
  }
  EXPECT_EQ(lattice.ghosts.size(), 200u);
  EXPECT_EQ(ghost_places(lattice), places(mirrored, r));
  EXPECT_EQ(lattice.grid.nx, 32);
  EXPECT_EQ(lattice.grid.ny, 10);
  EXPECT_EQ(lattice.count(site::particle), 3000u);
  expect_ghosts_follow_their_hexahedra(model);
}

TEST(Ghosts, OfAFlatInterfaceMeetUpToNineParticlesEach) {
  const Model model = Builder()
                          .hexahedra("a", {{-1, 0, 0}, {0, 2, 2}}, {1, 2, 2})
                          .particles("b", {{{0, 0, 0}, {1, 2, 2}}}, 0.25)
                          .couple();
  const Lattice& lattice = model.lattices[0];
  ASSERT_EQ(lattice.ghosts.size(), 16u);
  int most = 0;
  for (const Ghost& ghost : lattice.ghosts) {
    const auto bonds = lattice.word[ghost.site] & site::bonds;
    most = std::max(most, __builtin_popcount(bonds));
    for (int d = 0; d < 18; ++d) EXPECT_EQ(directions[d][0] == 1 || !(bonds >> d & 1), true);
  }
  EXPECT_EQ(most,
            5);  // one straight ahead and four beside it; a boundary particle's corner eights are group 3
}

TEST(Ghosts, ReachBeyondTheLatticeWhereTheContinuumIsWider) {
  const Box lattice_box{{0, 0, 0}, {1, 1, 1}}, wide{{-1, -1, -1}, {0, 2, 2}};
  const Model model =
      Builder().hexahedra("wide", wide, {2, 6, 6}).particles("b", {lattice_box}, 0.125).couple();
  const auto expected = expected_ghosts(
      {0, 0, 0}, 0.125, [&](Vec3 p) { return in(p, lattice_box); }, [&](Vec3 p) { return in(p, wide); });
  EXPECT_EQ(expected.size(), 16u + 16);  // 4 × 4, and one more row along each edge
  EXPECT_EQ(ghost_places(model.lattices[0]), places(expected, 0.125));
  expect_ghosts_follow_their_hexahedra(model);
}

TEST(Ghosts, OfAnLAreAlsoInItsCorner) {
  const double r = 0.125;
  const Box lattice_box{{0, 0, 0}, {1, 1, 1}}, behind{{-1, -1, 0}, {0, 1, 1}}, below{{0, -1, 0}, {1, 0, 1}};
  const Model model = Builder()
                          .hexahedra("behind", behind, {3, 6, 3})
                          .particles("b", {lattice_box}, r)
                          .hexahedra("below", below, {3, 3, 3})
                          .couple();
  const auto expected = expected_ghosts(
      {0, 0, 0}, r, [&](Vec3 p) { return in(p, lattice_box); },
      [&](Vec3 p) { return in(p, behind) || in(p, below); });
  EXPECT_EQ(expected.size(), 2u * 16 + 4);  // two faces, and the four sites along the corner
  EXPECT_EQ(ghost_places(model.lattices[0]), places(expected, r));
  expect_ghosts_follow_their_hexahedra(model);
}

TEST(Ghosts, OfAFilledHoleAreOnAllSidesAndEdgesButNotAtCorners) {
  const double r = 0.25;
  const Box hole{{1, 1, 1}, {3, 3, 3}};
  const Model model = Builder()
                          .hexahedra("shell", {{0, 0, 0}, {4, 4, 4}}, {4, 4, 4}, {hole})
                          .particles("core", {hole}, r)
                          .couple();
  const auto expected = expected_ghosts(
      {1, 1, 1}, r, [&](Vec3 p) { return in(p, hole); },
      [&](Vec3 p) {
        return in(p, {{0, 0, 0}, {4, 4, 4}}) && !in(p, hole);
      });
  EXPECT_EQ(expected.size(), 6u * 16 + 12 * 4);  // corner sites are group 3, out of reach
  EXPECT_EQ(ghost_places(model.lattices[0]), places(expected, r));
  expect_ghosts_follow_their_hexahedra(model);
  for (const std::uint32_t w : model.lattices[0].word)  // so every particle has all its bonds
    EXPECT_TRUE(!(w & site::particle) || (w & site::bonds) == site::bonds);
}

TEST(Ghosts, OfAFourSidedFrame) {
  const double r = 0.125;
  const Box hole{{1, 1, 0}, {2, 2, 1}}, all{{0, 0, 0}, {3, 3, 1}};
  const Model model =
      Builder().hexahedra("frame", all, {6, 6, 2}, {hole}).particles("core", {hole}, r).couple();
  const auto expected = expected_ghosts(
      {1, 1, 0}, r, [&](Vec3 p) { return in(p, hole); }, [&](Vec3 p) { return in(p, all) && !in(p, hole); });
  EXPECT_EQ(expected.size(), 4u * 16 + 4 * 4);
  EXPECT_EQ(ghost_places(model.lattices[0]), places(expected, r));
}

TEST(Ghosts, OfSeveralLatticesBelongToEach) {
  const Model model = Builder()
                          .particles("left", {{{0, 0, 0}, {1, 1, 1}}}, 0.125)
                          .hexahedra("between", {{1, 0, 0}, {2, 1, 1}}, {2, 2, 2})
                          .particles("right", {{{2, 0, 0}, {3, 1, 1}}}, 0.25)
                          .couple();
  EXPECT_EQ(model.lattices[0].ghosts.size(), 16u);
  EXPECT_EQ(model.lattices[1].ghosts.size(), 4u);
  expect_ghosts_follow_their_hexahedra(model);
}

TEST(Ghosts, AreNoneWithoutHexahedra) {
  const Model model = Builder().particles("alone", {{{0, 0, 0}, {1, 1, 1}}}, 0.25).couple();
  EXPECT_TRUE(model.lattices[0].ghosts.empty());
  EXPECT_EQ(model.lattices[0].grid.nx, 2);
}

TEST(Ghosts, ListsAndSitesAgree) {
  const Model model = Builder()
                          .hexahedra("a", {{-1, 0, 0}, {0, 2, 2}}, {1, 2, 2})
                          .particles("b", {{{0, 0, 0}, {1, 2, 2}}}, 0.25)
                          .couple();
  const Lattice& lattice = model.lattices[0];
  EXPECT_EQ(lattice.count(site::ghost), lattice.ghosts.size());
  for (std::size_t g = 1; g < lattice.ghosts.size(); ++g)
    EXPECT_LT(lattice.ghosts[g - 1].site, lattice.ghosts[g].site);  // in order of sites
}

}  // namespace
}  // namespace geist::coupling
