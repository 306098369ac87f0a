// The whole step of a lattice in one pass, and its drift: to the bit what the two passes give.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "core/parallel.hpp"
#include "de/bonds.hpp"
#include "de/rotation.hpp"
#include "de/support.hpp"

namespace geist::de {
namespace {

using namespace testing;

constexpr double dt = 0.01;
const Kick kick{0.99, 0.1, 0.7, {0.01, 0, -0.02}};

class Advance : public ::testing::TestWithParam<Method> {
 protected:
  /// Of a grid with more planes, or longer ones, than there are threads.
  Lattice moving(const std::array<int, 3>& n) { return testing::moving(GetParam(), n); }
};
INSTANTIATE_TEST_SUITE_P(Lattices, Advance, all_methods, name_of);

/// Everything that a step changes.
std::vector<std::uint64_t> bits_of(const Lattice& lattice, const KickSums& sums) {
  std::vector<std::uint64_t> bits;
  const auto keep = [&bits](const double* x, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) bits.push_back(std::bit_cast<std::uint64_t>(x[i]));
  };
  for (int c = 0; c < 6; ++c) {
    keep(lattice.motion[c], lattice.grid.size()), keep(lattice.velocity[c], lattice.grid.size());
    keep(lattice.listed_force[c], lattice.listed.size());
  }
  for (int c = 0; c < 9 && lattice.kinematics == Kinematics::finite; ++c)
    keep(lattice.rotation[c], lattice.grid.size());
  for (const double x : {sums.across, sums.after, sums.spin_across, sums.spin_after}) keep(&x, 1);
  return bits;
}

TEST_P(Advance, IsDriftThenForcesAndKickToTheBit) {
  std::vector<std::array<int, 3>> grids(shapes.begin(), shapes.end());
  grids.insert(grids.end(), {{19, 9, 11}, {9, 2, 30}, {3, 30, 2}, {10, 1, 40}, {2, 40, 1}});
  for (const auto& n : grids)
    for (const int n_threads : {1, 2, 3, 4, 7}) {
      set_threads(n_threads);
      Lattice at_once = moving(n), in_turn = moving(n);
      for (int step = 0; step < 3; ++step) {
        const KickSums sums = advance(at_once, kick, dt);
        drift(in_turn, dt);
        const KickSums expected = bond_forces_and_kick(in_turn, kick);
        EXPECT_EQ(bits_of(at_once, sums), bits_of(in_turn, expected))
            << n[0] << " × " << n[1] << " × " << n[2] << ", " << n_threads << " threads";
      }
    }
}

TEST(Advance, FindsPressuresBetweenDriftAndForces) {
  Lattice at_once = dilating({12, 5, 4}), in_turn = dilating({12, 5, 4});
  ASSERT_TRUE(at_once.dilates());
  for (Lattice* lattice : {&at_once, &in_turn}) move_at_random(*lattice, 1), push_at_random(*lattice, 2);
  const KickSums sums = advance(at_once, kick, dt);
  drift(in_turn, dt);
  const KickSums expected = bond_forces_and_kick(in_turn, kick);
  EXPECT_EQ(bits_of(at_once, sums), bits_of(in_turn, expected));
}

TEST(Drift, AddsVelocities) {
  Lattice lattice = random_lattice({17, 4, 5}, 41), before = random_lattice({17, 4, 5}, 41);
  for (Lattice* l : {&lattice, &before}) move_at_random(*l, 42), push_at_random(*l, 43);
  drift(lattice, dt);
  for (int c = 0; c < 6; ++c)
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      EXPECT_EQ(lattice.motion[c][s], fma(dt, before.velocity[c][s], before.motion[c][s]));
}

/// Ghosts have been put where they belong before the step: without velocity they stay there to the bit,
/// though a rotation that has been rounded is not quite orthonormal.
TEST(Drift, LeavesGhostsThatFollowWhereTheyAre) {
  Lattice lattice = finite(random_lattice({17, 4, 5}, 41), true);
  lattice.ghost_rotation = GhostRotation::continuum;
  turn_at_random(lattice, 42, 0.5), push_at_random(lattice, 43);
  ASSERT_GT(lattice.ghosts.size(), 10u);
  std::vector<double> before, after;
  const auto keep = [&lattice](std::size_t s, std::vector<double>& into) {
    for (int c = 0; c < 3; ++c) into.push_back(lattice.motion[c][s]);
    for (int c = 0; c < 9; ++c) into.push_back(lattice.rotation[c][s]);
  };
  for (const Ghost& ghost : lattice.ghosts) {
    lattice.velocity.set(ghost.site, {}), lattice.velocity.set(ghost.site, {}, 3);
    lattice.rotation[4][ghost.site] += 1e-9;
    keep(ghost.site, before);
  }
  drift(lattice, dt);
  for (const Ghost& ghost : lattice.ghosts) keep(ghost.site, after);
  EXPECT_EQ(before, after);
}

TEST(Drift, TurnsGhostsThatSpinByThemselves) {
  Lattice lattice = finite(random_lattice({17, 4, 5}, 41), false);
  ASSERT_EQ(lattice.ghost_rotation, GhostRotation::own);
  const std::size_t s = lattice.ghosts.front().site;
  lattice.velocity.set(s, {0, 0, 1}, 3);
  drift(lattice, dt);
  EXPECT_NEAR(rotation_vector(lattice, s).z, dt, 1e-15);
}

}  // namespace
}  // namespace geist::de
