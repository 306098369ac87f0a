// Lattice: directions, the grid's arithmetic, bonds against distances, lists of sites.
#include "model/lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace geist {
namespace {

constexpr std::array<std::array<int, 3>, 7> shapes{
    {{1, 1, 1}, {2, 1, 1}, {9, 1, 3}, {8, 2, 2}, {7, 5, 1}, {1, 4, 6}, {17, 3, 4}}};

Grid grid_of(const std::array<int, 3>& n) { return {n[0], n[1], n[2], {0.5, -1.5, 2.25}, 0.25}; }

/// Sites at random empty, particle or ghost, and some of the particles listed.
Lattice random_lattice(const std::array<int, 3>& n, int seed) {
  std::mt19937 random(seed);
  std::discrete_distribution<int> kind{2, 6, 2};
  const std::uint32_t words[] = {0, site::particle | site::free, site::ghost};
  Lattice lattice;
  lattice.grid = grid_of(n);
  lattice.word.assign(lattice.grid.size(), 0);
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        const std::size_t s = lattice.grid.index(i, j, k);
        lattice.word[s] = words[kind(random)];
        if (lattice.word[s] == site::ghost) lattice.ghosts.push_back({s, 0, {}, {}});
      }
  return lattice;
}

bool bonded(const Lattice& lattice, std::size_t a, std::size_t b) {
  const bool occupied = lattice.word[a] && lattice.word[b];
  const bool particle = lattice.is(a, site::particle) || lattice.is(b, site::particle);
  const double distance = norm(lattice.grid.centre(a) - lattice.grid.centre(b)) / lattice.grid.pitch;
  const bool near = std::abs(distance - 1) < 1e-9 || std::abs(distance - std::sqrt(2.0)) < 1e-9;
  return occupied && particle && near;
}

TEST(Directions, AreTheSixNearestAndTheTwelveNextEachOnce) {
  const std::set<std::array<int, 3>> different(directions.begin(), directions.end());
  EXPECT_EQ(different.size(), 18u);
  int group[4] = {};
  for (const auto& [a, b, c] : directions) ++group[a * a + b * b + c * c];
  EXPECT_EQ(group[1], 6);
  EXPECT_EQ(group[2], 12);
  for (int d = 0; d < 18; ++d)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(directions[opposite(d)][c], -directions[d][c]);
}

TEST(Grid, PlacesAndIndicesAreOneToOne) {
  for (const auto& n : shapes) {
    const Grid grid = grid_of(n);
    std::set<std::size_t> seen;
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i) {
          const std::size_t s = grid.index(i, j, k);
          EXPECT_LT(s, grid.size());
          EXPECT_TRUE(seen.insert(s).second);
          EXPECT_EQ(grid.ijk(s), (std::array<int, 3>{i, j, k}));
          EXPECT_EQ(grid.centre(s), (Vec3{0.5 + 0.25 * i, -1.5 + 0.25 * j, 2.25 + 0.25 * k}));
          EXPECT_TRUE(grid.contains(i, j, k));
        }
    EXPECT_EQ(grid.size() % lanes, 0u);
    EXPECT_FALSE(grid.contains(n[0], 0, 0));
    EXPECT_FALSE(grid.contains(0, n[1], 0));
    EXPECT_FALSE(grid.contains(0, 0, n[2]));
    EXPECT_FALSE(grid.contains(-1, 0, 0) || grid.contains(0, -1, 0) || grid.contains(0, 0, -1));
  }
}

TEST(Grid, OffsetsLeadToTheNeighbour) {
  for (const auto& n : shapes) {
    const Grid grid = grid_of(n);
    for (int d = 0; d < 18; ++d) {
      const auto [a, b, c] = directions[d];
      for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
          for (int i = 0; i < n[0]; ++i) {
            if (!grid.contains(i + a, j + b, k + c)) continue;
            EXPECT_EQ(grid.index(i, j, k) + grid.offset(d), grid.index(i + a, j + b, k + c));
          }
    }
  }
}

TEST(Grid, GuardCoversWhatAStencilOfPacksReads) {
  for (const auto& n : shapes) {
    const Grid grid = grid_of(n);
    const auto guard = static_cast<std::ptrdiff_t>(grid.guard()),
               size = static_cast<std::ptrdiff_t>(grid.size());
    for (int d = 0; d < 18; ++d) {
      EXPECT_GE(grid.offset(d), -guard);
      EXPECT_LE(size - lanes + grid.offset(d) + lanes, size + guard);
    }
  }
}

TEST(Lattice, BondsAreThePairsAtTheTwoDistancesWithAParticle) {
  for (std::size_t shape = 0; shape < shapes.size(); ++shape) {
    Lattice lattice = random_lattice(shapes[shape], static_cast<int>(shape));
    const Grid& grid = lattice.grid;
    const std::vector<std::uint32_t> before = lattice.word;
    connect(lattice);
    std::size_t bits = 0, pairs = 0;
    for (std::size_t s = 0; s < grid.size(); ++s) {
      EXPECT_EQ(lattice.word[s] & ~site::bonds, before[s]);
      for (int d = 0; d < 18; ++d) {
        if (!(lattice.word[s] >> d & 1)) continue;
        ++bits;
        const std::size_t t = s + grid.offset(d);
        EXPECT_TRUE(bonded(lattice, s, t));
        EXPECT_TRUE(lattice.word[t] >> opposite(d) & 1);
      }
      for (std::size_t t = 0; t < grid.size(); ++t) pairs += s != t && bonded(lattice, s, t);
    }
    EXPECT_EQ(bits, pairs);
  }
}

TEST(Lattice, ConnectForgetsEarlierBonds) {
  Lattice lattice = random_lattice({9, 3, 3}, 4);
  connect(lattice);
  const auto once = lattice.word;
  lattice.word[lattice.grid.index(4, 1, 1)] = 0;
  connect(lattice);
  EXPECT_NE(lattice.word, once);
  for (int d = 0; d < 18; ++d) {
    const auto neighbour = lattice.grid.index(4, 1, 1) + lattice.grid.offset(d);
    EXPECT_FALSE(lattice.word[neighbour] >> opposite(d) & 1);
  }
}

TEST(Lattice, CountsByFlag) {
  const Lattice lattice = random_lattice({17, 3, 4}, 9);
  std::size_t particles = 0;
  for (const std::uint32_t w : lattice.word) particles += (w & site::particle) != 0;
  EXPECT_EQ(lattice.count(site::particle), particles);
  EXPECT_EQ(lattice.count(site::ghost), lattice.ghosts.size());
  EXPECT_GT(lattice.ghosts.size(), 0u);
}

TEST(Lattice, ListsGhostsAndTheGivenParticlesRowByRow) {
  Lattice lattice = random_lattice({17, 3, 4}, 2);
  const std::size_t a = lattice.grid.index(16, 2, 3), b = lattice.grid.index(0, 0, 0),
                    c = lattice.grid.index(5, 1, 2);
  for (const std::size_t s : {a, b, c}) lattice.word[s] = site::particle | site::free;
  std::erase_if(lattice.ghosts, [&](const Ghost& g) { return g.site == a || g.site == b || g.site == c; });
  connect(lattice), finish(lattice);
  list_sites(lattice, {a, c, a, b});

  std::set<std::size_t> expected{a, b, c};
  for (const Ghost& g : lattice.ghosts) expected.insert(g.site);
  EXPECT_EQ(lattice.listed, std::vector<std::size_t>(expected.begin(), expected.end()));
  ASSERT_EQ(lattice.listed_begin.size(), lattice.grid.rows() + 1);
  for (std::size_t slot = 0; slot < lattice.listed.size(); ++slot) {
    const std::size_t s = lattice.listed[slot], row = s / lattice.grid.stride();
    EXPECT_GE(static_cast<std::int32_t>(slot), lattice.listed_begin[row]);
    EXPECT_LT(static_cast<std::int32_t>(slot), lattice.listed_begin[row + 1]);
    EXPECT_EQ(listed_slot(lattice, s), static_cast<std::int32_t>(slot));
    EXPECT_EQ(lattice.listed_held[slot], lattice.is(s, site::ghost) ? 0b000111 : 0);
  }
  for (std::size_t s = 0; s < lattice.grid.size(); ++s)
    EXPECT_EQ(lattice.is(s, site::free), lattice.is(s, site::particle) && !expected.contains(s));
  for (std::size_t g = 0; g < lattice.ghosts.size(); ++g)
    EXPECT_EQ(lattice.listed[lattice.ghost_slot[g]], lattice.ghosts[g].site);
  EXPECT_EQ(lattice.listed_force.size(), lattice.listed.size());
}

TEST(Lattice, FinishMakesZeroStateWithGuards) {
  Lattice lattice = random_lattice({9, 3, 3}, 1);
  finish(lattice);
  const auto guard = static_cast<std::ptrdiff_t>(lattice.grid.guard());
  for (const Field<6>* f : {&lattice.motion, &lattice.velocity, &lattice.velocity_before}) {
    ASSERT_EQ(f->size(), lattice.grid.size());
    for (int c = 0; c < 6; ++c)
      for (std::ptrdiff_t i = -guard; i < static_cast<std::ptrdiff_t>(f->size()) + guard; ++i)
        ASSERT_EQ((*f)[c][i], 0);
  }
}

}  // namespace
}  // namespace geist
