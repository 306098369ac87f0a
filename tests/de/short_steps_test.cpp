// A lattice's short steps: what its particles are moved by is the recurrence written out, what is handed over
// is the mean of the forces on the way, and the lattice comes back as it set out.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "de/short_steps.hpp"
#include "de/support.hpp"

namespace geist::de {
namespace {

using namespace testing;

/// Some of its listed sites held, and forces on them.
Lattice loaded(Method method) {
  Lattice lattice = moving(method, {17, 4, 5});
  for (std::size_t slot = 0; slot < lattice.listed.size(); ++slot) {
    const std::size_t s = lattice.listed[slot];
    lattice.listed_held[slot] = lattice.is(s, site::ghost) ? 0b111 : s % 2 == 0 ? 0b010010 : 0;
    for (int c = 0; c < 6; ++c) {
      if (lattice.listed_held[slot] >> c & 1) lattice.velocity[c][s] = 0;
      lattice.listed_force[c][slot] = lattice.is(s, site::ghost) ? 0 : 1e-3 * static_cast<double>(c + slot);
    }
  }
  return lattice;
}

using Values = std::array<std::vector<double>, 6>;  ///< by component and site, or listed site

struct Step {
  double keep, per_mass, per_inertia, share;
  Vec3 gravity;
};
constexpr std::array<Step, 3> three{Step{0.3, 0.011, 0.4, 0.2, {1e-4, 0, 2e-4}},
                                    {0.8, 0.013, 0.3, 0.5, {0, 1e-4, 0}},
                                    {0.7, 0.012, 0.5, 0.3, {}}};
Kick kick_of(const Step& step) { return {step.keep, step.per_mass, step.per_inertia, step.gravity}; }

/// The recurrence written out: Σ w, and what acts all along and the mean on listed sites.
struct WrittenOut {
  Values moved, force;
};

WrittenOut write_out(Lattice lattice) {
  const std::size_t sites = lattice.grid.size(), listed = lattice.listed.size();
  WrittenOut out;
  Values w, rest;
  for (int c = 0; c < 6; ++c) {
    w[c].assign(sites, 0), out.moved[c].assign(sites, 0);
    rest[c].assign(lattice.listed_force[c], lattice.listed_force[c] + listed), out.force[c] = rest[c];
  }
  for (std::size_t k = 0; k < three.size(); ++k) {
    const Step& step = three[k];
    bond_forces_and_kick(lattice, {0, 1, 1, {}});  // free particles' velocities are their forces
    for (int c = 0; c < 6; ++c) {
      const double gain = c < 3 ? step.per_mass : step.per_inertia, g = c < 3 ? step.gravity[c] : 0;
      const double keep = k == 0 ? 0 : step.keep;
      for (std::size_t s = 0; s < sites; ++s)
        if (lattice.is(s, site::free)) w[c][s] = keep * w[c][s] + gain * lattice.velocity[c][s] + g;
      for (std::size_t n = 0; n < listed; ++n) {
        const double f = lattice.listed_force[c][n];
        out.force[c][n] += step.share * f;
        double& increment = w[c][lattice.listed[n]];
        if (!(lattice.listed_held[n] >> c & 1)) increment = keep * increment + gain * (f + rest[c][n]) + g;
      }
      for (std::size_t s = 0; s < sites; ++s) out.moved[c][s] += w[c][s], lattice.velocity[c][s] = w[c][s];
    }
    drift(lattice, 1);
  }
  return out;
}

class ShortStepsOf : public ::testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Lattices, ShortStepsOf, all_methods, name_of);

void take(Lattice& lattice, ShortSteps& away) {
  away.begin(lattice);
  for (std::size_t k = 0; k < three.size(); ++k) {
    if (k > 0) away.drift(lattice);
    Kick kick = kick_of(three[k]);
    if (k == 0) kick.keep = 0;
    away.step(lattice, kick, three[k].share);
  }
  away.end(lattice);
}

TEST_P(ShortStepsOf, AreTheRecurrence) {
  const WrittenOut expected = write_out(loaded(GetParam()));
  const Lattice before = loaded(GetParam());
  Lattice lattice = loaded(GetParam());
  ShortSteps away(lattice);
  take(lattice, away);
  away.kick(lattice, {0.5, 3, 3, {}});
  for (int c = 0; c < 6; ++c) {
    for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
      const double v = before.velocity[c][s];
      if (lattice.is(s, site::free))
        EXPECT_NEAR(lattice.velocity[c][s], 0.5 * v + 3 * expected.moved[c][s], 1e-11) << c << ' ' << s;
      else
        EXPECT_EQ(lattice.velocity[c][s], v);
    }
    for (std::size_t n = 0; n < lattice.listed.size(); ++n)
      EXPECT_NEAR(lattice.listed_force[c][n], expected.force[c][n],
                  1e-12 * (1 + std::abs(expected.force[c][n])));
  }
}

TEST_P(ShortStepsOf, ComeBack) {
  const Lattice before = loaded(GetParam());
  Lattice lattice = loaded(GetParam());
  ShortSteps away(lattice);
  for (int twice = 0; twice < 2; ++twice) take(lattice, away);
  for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
    for (int c = 0; c < 6; ++c) {
      EXPECT_EQ(lattice.motion[c][s], before.motion[c][s]);
      EXPECT_EQ(lattice.velocity[c][s], before.velocity[c][s]);
    }
    for (int c = 0; GetParam().finite && c < 9; ++c) EXPECT_EQ(lattice.rotation[c][s], before.rotation[c][s]);
  }
}

/// Σ v⁻·v⁺ and Σ v⁺·v⁺ of free particles.
TEST_P(ShortStepsOf, AddUpWhatTheKickDoes) {
  const Lattice before = loaded(GetParam());
  Lattice lattice = loaded(GetParam());
  ShortSteps away(lattice);
  take(lattice, away);
  const KickSums sums = away.kick(lattice, {0.5, 3, 3, {}});
  const KickSums expected = sums_of_free(before, lattice);
  EXPECT_NEAR(sums.across, expected.across, 1e-12 * expected.after);
  EXPECT_NEAR(sums.after, expected.after, 1e-12 * expected.after);
  EXPECT_NEAR(sums.spin_across, expected.spin_across, 1e-12 * expected.spin_after);
  EXPECT_NEAR(sums.spin_after, expected.spin_after, 1e-12 * expected.spin_after);
  EXPECT_GT(expected.after, 1);
}

}  // namespace
}  // namespace geist::de
