// Forces of the row kernel: against the literal law, the energies, and what mechanics demands of any law.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/parallel.hpp"
#include "de/bonds.hpp"
#include "de/stencil.hpp"
#include "de/support.hpp"

namespace geist::de {
namespace {

using namespace testing;

template <class F>
void for_random_lattices(F visit) {
  int seed = 0;
  for (const auto& n : shapes)
    for (const double poisson : {-0.3, 0.0, 0.2, 0.25}) {
      Lattice lattice = random_lattice(n, ++seed);
      lattice.material.poisson = poisson;
      move_at_random(lattice, ++seed);
      visit(lattice);
    }
}

/// Each force adds up to 18 bonds of a few rounded operations each: some 30 roundings of 1e-16 of the
/// largest.
constexpr double rounding = 1e-13;

void expect_same(const Loads6& found, const Loads6& expected, double tolerance) {
  ASSERT_EQ(found.force.size(), expected.force.size());
  for (std::size_t s = 0; s < found.force.size(); ++s) {
    EXPECT_LE(norm(found.force[s] - expected.force[s]), tolerance) << s;
    EXPECT_LE(norm(found.moment[s] - expected.moment[s]), tolerance) << s;
  }
}

TEST(BondForces, AreTheLiteralLaws) {
  for_random_lattices([](Lattice& lattice) {
    const Loads6 expected = literal(lattice).on;
    expect_same(kernel_forces(lattice), expected, rounding * expected.largest());
  });
}

TEST(BondForces, AreTheLiteralLawsInAFullLattice) {
  for (const auto& n : shapes) {
    Lattice lattice = full_lattice(n);  // rows of inner particles, the kernel's short cut
    move_at_random(lattice, 77);
    const Loads6 expected = literal(lattice).on;
    expect_same(kernel_forces(lattice), expected, rounding * expected.largest());
  }
  EXPECT_EQ(full_lattice({26, 4, 4}).count(site::bonds), 26u * 16);
}

TEST(BondForces, GrowWithWhatPublishedStiffnessesGive) {
  // E 1000, ν 0.2, r 0.1: k_n = 200/3, k_s = 200/18 by (5). One particle pulled from its fixed neighbour.
  Lattice lattice = full_lattice({2, 1, 1});
  lattice.material = {"polymer", 0.001, 1000, 0.2};
  lattice.grid.pitch = 0.2;
  lattice.motion[0][1] = 1e-3;
  lattice.motion[1][1] = 1e-3;
  const Loads6 f = kernel_forces(lattice);
  EXPECT_NEAR(f.force[0].x, 200.0 / 3 * 1e-3, 1e-15);
  EXPECT_NEAR(f.force[0].y, 200.0 / 18 * 1e-3, 1e-15);
  EXPECT_NEAR(f.moment[0].z, 0.1 * 200.0 / 18 * 1e-3, 1e-15);
  EXPECT_NEAR(f.moment[1].z, 0.1 * 200.0 / 18 * 1e-3, 1e-15);  // both moments have the same sign
}

TEST(BondForces, KeepMomentumAndAngularMomentum) {
  for_random_lattices([](Lattice& lattice) {
    const Loads6 f = kernel_forces(lattice);
    Vec3 momentum, angular;
    for (std::size_t s = 0; s < f.force.size(); ++s) {
      momentum += f.force[s];
      angular += cross(lattice.grid.centre(s), f.force[s]) + f.moment[s];
    }
    const auto sites = static_cast<double>(f.force.size());  // arms are at most 13 long
    EXPECT_LE(norm(momentum), rounding * sites * f.largest());
    EXPECT_LE(norm(angular), 13 * rounding * sites * f.largest());
  });
}

TEST(BondForces, AreMinusTheDerivativesOfTheEnergy) {
  for (const auto& n : {std::array{9, 1, 3}, std::array{5, 4, 3}})
    expect_forces_of_the_energy(random_lattice(n, 31));
}

TEST(BondForces, VanishInRigidMotion) {
  const Vec3 shift{0.3, -0.2, 0.5}, turn{0.01, -0.03, 0.02}, about{1, 2, 3};
  for_random_lattices([&](Lattice& lattice) {
    for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
      if (!lattice.word[s]) continue;
      lattice.motion.set(s, shift + cross(turn, lattice.grid.centre(s) - about));
      lattice.motion.set(s, turn, 3);
    }
    const double stiffness = lattice.material.young;  // bonds have at most ⅔ E r at these ν
    EXPECT_LE(kernel_forces(lattice).largest(), 1e-14 * stiffness);
    const BondEnergies e = energies(lattice);
    EXPECT_LE(e.bonds + e.coupling, 1e-26 * stiffness);
  });
}

TEST(BondForces, IgnoreWhateverIsAtEmptySites) {
  Lattice lattice = random_lattice({26, 4, 4}, 3);
  move_at_random(lattice, 4);
  const Loads6 before = kernel_forces(lattice);
  for (std::size_t s = 0; s < lattice.grid.size(); ++s)
    for (int c = 0; c < 6 && !lattice.word[s]; ++c) lattice.motion[c][s] = std::nan("");
  expect_same(kernel_forces(lattice), before, 0);
}

TEST(BondForces, AreTheScalarFormulasToTheBit) {
  for (const auto& n : shapes) {
    Lattice lattice = random_lattice(n, 12);
    move_at_random(lattice, 13);
    const Loads6 packed = kernel_forces(lattice);
    std::ptrdiff_t offset[18];
    for (int d = 0; d < 18; ++d) offset[d] = lattice.grid.offset(d);
    const ElasticBond law = ElasticBond::from(lattice.material, lattice.radius());
    for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
      if (!lattice.word[s]) continue;
      double f[6];
      site_force(view(lattice.motion), s, offset, law, lattice.radius(), SiteBonds{lattice.word[s]}, f);
      for (int c = 0; c < 6; ++c) EXPECT_EQ(c < 3 ? packed.force[s][c] : packed.moment[s][c - 3], f[c]);
    }
  }
}

/// Packs of one class, of two and of many; those of inner particles have the endless lattice's bonds.
TEST(BondForces, OfConsistentLatticesAreTheScalarFormulasToTheBit) {
  for (const bool full : {true, false})
    for (const std::array<int, 3>& n : {std::array{17, 4, 5}, std::array{40, 3, 3}, std::array{5, 4, 3}}) {
      Lattice lattice = small(full ? full_lattice(n) : random_lattice(n, 12), true);
      move_at_random(lattice, 13);
      const Loads6 packed = kernel_forces(lattice);
      std::ptrdiff_t offset[18];
      for (int d = 0; d < 18; ++d) offset[d] = lattice.grid.offset(d);
      const Bending bending = Bending::from(lattice.material, lattice.radius());
      for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
        if (!lattice.word[s] || lattice.class_of[s] == 0) continue;
        const ClassBonds<double> law(bending, lattice.classes.data(), &lattice.class_of[s]);
        double f[6];
        site_force(view(lattice.motion), s, offset, law, lattice.radius(), SiteBonds{lattice.word[s]}, f);
        for (int c = 0; c < 6; ++c) EXPECT_EQ(c < 3 ? packed.force[s][c] : packed.moment[s][c - 3], f[c]);
      }
    }
}

TEST(BondForces, HaveTheSameBitsForAnyNumberOfThreads) {
  std::vector<std::vector<std::uint64_t>> bits;
  for (int n_threads = 1; n_threads <= 4; ++n_threads) {
    set_threads(n_threads);
    Lattice lattice = random_lattice({19, 9, 11}, 21);  // 99 rows
    move_at_random(lattice, 22), push_at_random(lattice, 23);
    const KickSums sums = bond_forces_and_kick(lattice, Kick{0.99, 0.1, 0.7, {0.01, 0, -0.02}});
    auto& b = bits.emplace_back();
    const auto keep = [&b](double x) { b.push_back(std::bit_cast<std::uint64_t>(x)); };
    for (int c = 0; c < 6; ++c) {
      for (std::size_t s = 0; s < lattice.grid.size(); ++s) keep(lattice.velocity[c][s]);
      for (std::size_t slot = 0; slot < lattice.listed.size(); ++slot) keep(lattice.listed_force[c][slot]);
    }
    for (const double x : {sums.across, sums.after, sums.spin_across, sums.spin_after}) keep(x);
    EXPECT_EQ(b, bits.front());
  }
}

}  // namespace
}  // namespace geist::de
