// Energies and counts of bonds against the literal law.
#include <gtest/gtest.h>

#include <cmath>

#include "core/parallel.hpp"
#include "de/bonds.hpp"
#include "de/support.hpp"

namespace geist::de {
namespace {

using namespace testing;

TEST(BondEnergies, AreTheLiteralLaws) {
  int seed = 50;
  for (const auto& n : shapes) {
    Lattice lattice = random_lattice(n, ++seed);
    move_at_random(lattice, ++seed);
    const Literal expected = literal(lattice);
    const double tolerance = 1e-13 * (expected.bonds + expected.coupling);
    const BondEnergies found = energies(lattice);
    EXPECT_NEAR(found.bonds, expected.bonds, tolerance);
    EXPECT_NEAR(found.coupling, expected.coupling, tolerance);
    EXPECT_EQ(bond_count(lattice), expected.bond_count);
    const std::vector<double> by_site = site_energies(lattice);
    ASSERT_EQ(by_site.size(), lattice.grid.size());
    for (std::size_t s = 0; s < by_site.size(); ++s) EXPECT_NEAR(by_site[s], expected.energy[s], tolerance);
  }
}

TEST(BondEnergies, CountBondsOfABox) {
  // n³ sites: 3 n² (n − 1) of group 1 and 6 n (n − 1)² of group 2.
  for (const int n : {1, 2, 5, 9})
    EXPECT_EQ(bond_count(full_lattice({n, n, n})),
              static_cast<std::size_t>(3 * n * n * (n - 1) + 6 * n * (n - 1) * (n - 1)));
}

TEST(BondEnergies, HaveTheSameBitsForAnyNumberOfThreads) {
  Lattice lattice = random_lattice({19, 9, 11}, 5);
  move_at_random(lattice, 6);
  set_threads(1);
  const BondEnergies once = energies(lattice);
  for (int n_threads = 2; n_threads <= 4; ++n_threads) {
    set_threads(n_threads);
    const BondEnergies again = energies(lattice);
    EXPECT_EQ(again.bonds, once.bonds);
    EXPECT_EQ(again.coupling, once.coupling);
  }
}

}  // namespace
}  // namespace geist::de
