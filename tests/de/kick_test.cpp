// Kicks: what they make of velocities, whom they leave alone, and the sums that energies come from.
#include <gtest/gtest.h>

#include <cmath>

#include "de/bonds.hpp"
#include "de/support.hpp"

namespace geist::de {
namespace {

using namespace testing;

const Kick kick{0.97, 0.11, 1.7, {0.2, -0.3, 0.05}};

Lattice pushed_lattice(const std::array<int, 3>& n = {17, 4, 5}) {
  Lattice lattice = random_lattice(n, 41);
  move_at_random(lattice, 42), push_at_random(lattice, 43);
  return lattice;
}

/// v⁺ of component c from v⁻ and the force, as Kick's comment has it.
double kicked(int c, double before, double force) {
  return c < 3 ? kick.keep * before + kick.per_mass * force + kick.gravity[c]
               : kick.keep * before + kick.per_inertia * force;
}

double component(const Loads6& f, std::size_t s, int c) { return c < 3 ? f.force[s][c] : f.moment[s][c - 3]; }

TEST(Kick, AdvancesFreeParticlesWithDampingAndGravity) {
  Lattice lattice = pushed_lattice();
  const Lattice before = pushed_lattice();
  const Literal expected = literal(before);
  bond_forces_and_kick(lattice, kick);
  int moved = 0;
  for (std::size_t s = 0; s < lattice.grid.size(); ++s)
    for (int c = 0; c < 6; ++c) {
      const double v = before.velocity[c][s];
      if (!lattice.is(s, site::free)) {
        EXPECT_EQ(lattice.velocity[c][s], v);
        continue;
      }
      ++moved;
      EXPECT_NEAR(lattice.velocity[c][s], kicked(c, v, component(expected.on, s, c)),
                  1e-13 * kick.per_inertia * expected.on.largest());
    }
  EXPECT_GT(moved, 100);
}

TEST(Kick, HandsTheForceOnListedSitesOver) {
  Lattice lattice = pushed_lattice();
  const Literal expected = literal(lattice);
  bond_forces_and_kick(lattice, kick);
  EXPECT_GT(lattice.listed.size(), 50u);
  for (std::size_t slot = 0; slot < lattice.listed.size(); ++slot)
    for (int c = 0; c < 6; ++c)
      EXPECT_NEAR(lattice.listed_force[c][slot], component(expected.on, lattice.listed[slot], c),
                  1e-13 * expected.on.largest());
}

TEST(Kick, LeavesMotionAlone) {
  Lattice lattice = pushed_lattice();
  const Lattice before = pushed_lattice();
  bond_forces_and_kick(lattice, kick);
  kick_listed(lattice, kick);
  for (int c = 0; c < 6; ++c)
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      EXPECT_EQ(lattice.motion[c][s], before.motion[c][s]);
}

TEST(Kick, SumsAreThoseOfTheFreeParticles) {
  for (const auto& n : shapes) {
    Lattice lattice = pushed_lattice(n);
    const Lattice before = pushed_lattice(n);
    const KickSums found = bond_forces_and_kick(lattice, kick);
    const KickSums expected = sums_of_free(before, lattice);
    // Σ v⁻v⁺ has terms of both signs; their sizes add up to less than √(Σ v⁻² Σ v⁺²) ≤ Σ v⁺² here.
    EXPECT_NEAR(found.after, expected.after, 1e-13 * expected.after);
    EXPECT_NEAR(found.across, expected.across, 1e-13 * expected.after);
    EXPECT_NEAR(found.spin_after, expected.spin_after, 1e-13 * expected.spin_after);
    EXPECT_NEAR(found.spin_across, expected.spin_across, 1e-13 * expected.spin_after);
  }
}

TEST(Kick, OfListedSitesSparesTheComponentsThatAreHeld) {
  Lattice lattice = pushed_lattice();
  for (std::size_t slot = 0; slot < lattice.listed.size(); ++slot)
    if (!lattice.is(lattice.listed[slot], site::ghost)) lattice.listed_held[slot] = slot % 64;
  bond_forces_and_kick(lattice, kick);
  const Lattice before = pushed_lattice();  // listed sites have not been advanced yet
  const KickSums found = kick_listed(lattice, kick);
  KickSums expected;
  for (std::size_t slot = 0; slot < lattice.listed.size(); ++slot) {
    const std::size_t s = lattice.listed[slot];
    for (int c = 0; c < 6; ++c) {
      const double v = before.velocity[c][s], w = lattice.velocity[c][s];
      if (lattice.listed_held[slot] >> c & 1) {
        EXPECT_EQ(w, v);
        continue;
      }
      EXPECT_NEAR(w, kicked(c, v, lattice.listed_force[c][slot]), 1e-13 * (1 + std::abs(w)));
      (c < 3 ? expected.across : expected.spin_across) += v * w;
      (c < 3 ? expected.after : expected.spin_after) += w * w;
    }
  }
  EXPECT_NEAR(found.after, expected.after, 1e-13 * expected.after);
  EXPECT_NEAR(found.across, expected.across, 1e-13 * expected.after);
  EXPECT_NEAR(found.spin_after, expected.spin_after, 1e-13 * expected.spin_after);
  EXPECT_NEAR(found.spin_across, expected.spin_across, 1e-13 * expected.spin_after);
}

TEST(Kick, IsTheSameForListedAndForFreeParticles) {
  // A particle moves alike whether the lattice kernel advances it or hands its force over. To the bit.
  Lattice all_free = full_lattice({9, 3, 3});
  Lattice some_listed = make_lattice(
      {9, 3, 3}, [](int i, int j, int) { return (i + j) % 3 == 0 ? +site::particle : free_particle; });
  for (Lattice* lattice : {&all_free, &some_listed}) {
    move_at_random(*lattice, 1), push_at_random(*lattice, 2);
    bond_forces_and_kick(*lattice, kick);
    kick_listed(*lattice, kick);
  }
  for (int c = 0; c < 6; ++c)
    for (std::size_t s = 0; s < all_free.grid.size(); ++s)
      EXPECT_EQ(all_free.velocity[c][s], some_listed.velocity[c][s]);
}

TEST(Kick, OfGhostsSpinsThemOnly) {
  Lattice lattice = pushed_lattice();
  bond_forces_and_kick(lattice, kick);
  const Lattice before = pushed_lattice();
  kick_listed(lattice, kick);
  EXPECT_GT(lattice.ghosts.size(), 10u);
  for (const Ghost& ghost : lattice.ghosts) {
    EXPECT_EQ(lattice.velocity.vector(ghost.site), before.velocity.vector(ghost.site));
    EXPECT_NE(lattice.velocity.vector(ghost.site, 3), before.velocity.vector(ghost.site, 3));
  }
}

}  // namespace
}  // namespace geist::de
