// Selections and shares on a block of hexahedra beside a lattice.
#include "case/select.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "small_case.hpp"

namespace geist {
namespace {

using namespace testing;

using Interval = Where::Interval;

class Selecting : public ::testing::Test {
 protected:
  Vec3 place(const ParticleId& p) const { return model_.lattices[p.lattice].grid.centre(p.site); }
  Vec3 place(std::int32_t node) const { return model_.mesh.points[node]; }

  Built built_ = build(small_case());
  const Model& model_ = built_.simulation.model;
  const Selector selector_{model_};
};

Where at(std::optional<Interval> x, std::optional<Interval> y = {}, std::optional<Interval> z = {}) {
  Where where;
  where.axis = {x, y, z};
  return where;
}

Interval plane(double a) { return {a, a}; }

double total(const std::vector<double>& shares) {
  double sum = 0;
  for (const double s : shares) sum += s;
  return sum;
}

TEST_F(Selecting, PlanesHoldNodesOnThemAndParticlesWhoseCellTouches) {
  const struct {
    Where where;
    std::size_t nodes, particles;
  } cases[] = {{at(plane(0)), 9, 0},
               {at(plane(0.5)), 9, 0},
               {at(plane(0.3)), 0, 0},
               {at(plane(2)), 0, 16},
               {at(plane(1)), 9, 16},
               {at(plane(1.25)), 0, 32},  // between two layers: both touch
               {at(plane(1.3)), 0, 16},
               {at({}, plane(0)), 9, 16},
               {at(plane(2), plane(0)), 0, 4},
               {at(plane(0), plane(0), plane(0)), 1, 0},
               {at(plane(2), plane(1), plane(1)), 0, 1}};
  for (const auto& c : cases) {
    const Selection found = selector_.select(c.where);
    EXPECT_EQ(found.nodes.size(), c.nodes);
    EXPECT_EQ(found.particles.size(), c.particles);
    EXPECT_EQ(found.empty(), c.nodes + c.particles == 0);
  }
}

TEST_F(Selecting, IntervalsHoldNodesAndCentres) {
  EXPECT_EQ(selector_.select(at(Interval{1, 2})).nodes.size(), 9u);
  EXPECT_EQ(selector_.select(at(Interval{1, 2})).particles.size(), 64u);
  EXPECT_EQ(selector_.select(at(Interval{1.2, 1.4})).particles.size(), 16u);  // centres at 1.375
  EXPECT_EQ(selector_.select(at(Interval{1.375, 1.375 + 1e-3})).particles.size(), 16u);
  EXPECT_TRUE(selector_.select(at(Interval{1.15, 1.35})).empty());  // cells, but no centre
  EXPECT_EQ(selector_.select(at(Interval{-10, 10})).nodes.size(), 27u);
}

TEST_F(Selecting, RegionsHoldTheirOwn) {
  Where where = at({}, plane(0));
  where.region = "left";
  EXPECT_EQ(selector_.select(where).nodes.size(), 9u);
  EXPECT_TRUE(selector_.select(where).particles.empty());
  where.region = "right";
  EXPECT_TRUE(selector_.select(where).nodes.empty());
  EXPECT_EQ(selector_.select(where).particles.size(), 16u);
  where.axis = {};
  EXPECT_EQ(selector_.select(where).particles.size(), 64u);
}

TEST_F(Selecting, AgreesWithPositionsTriedOneByOne) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-0.2, 2.2);
  std::uniform_int_distribution<int> kind(0, 2);
  for (int repeat = 0; repeat < 300; ++repeat) {
    Where where;
    for (auto& axis : where.axis) {
      const double a = number(random), b = number(random);
      const int k = kind(random);
      if (k > 0) axis = k == 1 ? Interval{std::min(a, b), std::max(a, b)} : plane(std::round(4 * a) / 4);
    }
    const auto holds = [&](Vec3 p, double reach) {
      for (int c = 0; c < 3; ++c) {
        const double wide = where.axis[c] && where.axis[c]->plane() ? reach + 1e-6 : 1e-9;
        if (where.axis[c] && (p[c] < where.axis[c]->low - wide || p[c] > where.axis[c]->high + wide))
          return false;
      }
      return true;
    };
    std::size_t nodes = 0, particles = 0;
    for (const Vec3 p : model_.mesh.points) nodes += holds(p, 0);
    for (int n = 0; n < 64; ++n)
      particles +=
          holds({1.125 + 0.25 * (n % 4), 0.125 + 0.25 * (n / 4 % 4), 0.125 + 0.25 * (n / 16)}, 0.125);
    const Selection found = selector_.select(where);
    EXPECT_EQ(found.nodes.size(), nodes);
    EXPECT_EQ(found.particles.size(), particles);
  }
}

TEST_F(Selecting, SharesOfAFaceOfNodesAreTributaryAreas) {
  const Where where = at(plane(0));
  const Selection face = selector_.select(where);
  const auto shares = selector_.shares(where, face);
  EXPECT_TRUE(shares.by_area);
  EXPECT_NEAR(shares.total, 1, 1e-14);
  EXPECT_NEAR(total(shares.nodes), 1, 1e-14);
  for (std::size_t i = 0; i < face.nodes.size(); ++i) {
    const Vec3 p = place(face.nodes[i]);
    const double expected = (p.y == 0.5 ? 0.5 : 0.25) * (p.z == 0.5 ? 0.5 : 0.25);
    EXPECT_NEAR(shares.nodes[i], expected, 1e-14);
  }
}

TEST_F(Selecting, SharesOfAFaceOfParticlesAreEqual) {
  const Where where = at(plane(2));
  const auto shares = selector_.shares(where, selector_.select(where));
  EXPECT_TRUE(shares.by_area);
  EXPECT_NEAR(shares.total, 1, 1e-14);
  for (const double s : shares.particles) EXPECT_NEAR(s, 1 / 16.0, 1e-15);
}

TEST_F(Selecting, SharesOfAMixedFaceGiveEitherPartItsArea) {
  const Where where = at({}, plane(0));
  const auto shares = selector_.shares(where, selector_.select(where));
  EXPECT_TRUE(shares.by_area);
  EXPECT_NEAR(shares.total, 2, 1e-14);
  EXPECT_NEAR(total(shares.nodes), 0.5, 1e-14);
  EXPECT_NEAR(total(shares.particles), 0.5, 1e-14);
}

TEST_F(Selecting, SharesOfPartOfAFace) {
  const Where where = at(plane(2), Interval{0, 0.5});
  const auto shares = selector_.shares(where, selector_.select(where));
  EXPECT_NEAR(shares.total, 0.5, 1e-14);
  const Where half = at(plane(0), Interval{0, 0.5});
  const Selection nodes = selector_.select(half);
  EXPECT_EQ(nodes.nodes.size(), 6u);
  EXPECT_NEAR(selector_.shares(half, nodes).total, 0.5, 1e-14);
}

TEST_F(Selecting, ParticlesBesideThePlaneWithoutAFaceOnItHaveNoShare) {
  // 1.75 lies between the third and fourth layers; no face of either is exposed there: by mass, equally.
  const Where inside = at(plane(1.75));
  const auto shares = selector_.shares(inside, selector_.select(inside));
  EXPECT_FALSE(shares.by_area);
  for (const double s : shares.particles) EXPECT_NEAR(s, 1 / 32.0, 1e-15);
}

TEST_F(Selecting, SharesOfEdgesAreByMass) {
  const Where edge = at(plane(0), plane(0));
  const Selection found = selector_.select(edge);
  const auto shares = selector_.shares(edge, found);
  EXPECT_FALSE(shares.by_area);
  for (std::size_t i = 0; i < found.nodes.size(); ++i)
    EXPECT_NEAR(shares.nodes[i], place(found.nodes[i]).z == 0.5 ? 0.5 : 0.25, 1e-14);
}

TEST_F(Selecting, SharesOfAMixedEdgeReachNodesAndParticles) {
  // Along y = z = 0: three nodes of masses m, 2m, m with m = 0.001/64, four particles of mass 0.001/64 each.
  const Where edge = at({}, plane(0), plane(0));
  const Selection found = selector_.select(edge);
  ASSERT_EQ(found.nodes.size(), 3u);
  ASSERT_EQ(found.particles.size(), 4u);
  const auto shares = selector_.shares(edge, found);
  EXPECT_FALSE(shares.by_area);
  EXPECT_NEAR(shares.total, 8 * 0.001 / 64, 1e-17);
  EXPECT_NEAR(total(shares.nodes), 0.5, 1e-14);
  for (const double s : shares.particles) EXPECT_NEAR(s, 1 / 8.0, 1e-14);
}

TEST_F(Selecting, SharesOfAVolumeAreByMass) {
  const Where all = at(Interval{-1, 3});
  const auto shares = selector_.shares(all, selector_.select(all));
  EXPECT_FALSE(shares.by_area);
  EXPECT_NEAR(shares.total, 0.002, 1e-16);
  EXPECT_NEAR(total(shares.nodes), 0.5, 1e-13);
  EXPECT_NEAR(total(shares.particles), 0.5, 1e-13);
}

}  // namespace
}  // namespace geist
