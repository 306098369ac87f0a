// The lattice as a continuum: (5) makes it exactly isotropic with the E and ν asked for.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "de/bonds.hpp"
#include "de/elastic_bond.hpp"
#include "de/support.hpp"

namespace geist::de {
namespace {

using namespace testing;

/// A symmetric strain with all six components.
Mat3 random_strain(int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  Mat3 e;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) e[i][j] = e[j][i] = number(random);
  return e;
}

/// Hooke's law from E and ν.
Mat3 hooke(const Mat3& strain, double E, double nu) {
  const double trace = strain[0][0] + strain[1][1] + strain[2][2];
  Mat3 stress;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      stress[i][j] = E / (1 + nu) * (strain[i][j] + (i == j ? nu / (1 - 2 * nu) * trace : 0));
  return stress;
}

void strain_by(Lattice& lattice, const Mat3& strain) {
  for (std::size_t s = 0; s < lattice.grid.size(); ++s)
    if (lattice.word[s]) lattice.motion.set(s, strain * lattice.grid.centre(s));
}

bool interior(const Lattice& lattice, std::size_t s) {
  return (lattice.word[s] & site::bonds) == site::bonds;
}

TEST(Elasticity, TheConstantsAskedForAreRecovered) {
  Lattice lattice = full_lattice({1, 1, 1});
  for (const double E : {1.0, 1000.0, 2.1e11})
    for (const double nu : {-0.9, -0.4, 0.0, 0.1, 0.2, 0.23, 0.25})
      for (const double pitch : {0.02, 0.5, 30.0}) {
        lattice.material.young = E, lattice.material.poisson = nu, lattice.grid.pitch = pitch;
        const Recovered found = recovered_constants(lattice);
        EXPECT_NEAR(found.young, E, 1e-12 * E);
        EXPECT_NEAR(found.poisson, nu, 1e-12);
      }
}

TEST(Elasticity, HomogeneousStrainLeavesTheInteriorInBalance) {
  Lattice lattice = full_lattice({11, 6, 5});
  strain_by(lattice, random_strain(1));
  const Loads6 f = kernel_forces(lattice);
  int interiors = 0;
  for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
    if (!interior(lattice, s)) continue;
    ++interiors;
    EXPECT_LT(norm(f.force[s]), 1e-13 * f.largest());
    EXPECT_LT(norm(f.moment[s]), 1e-13 * f.largest());
  }
  EXPECT_EQ(interiors, 9 * 4 * 3);
}

TEST(Elasticity, EnergyDensityIsThatOfHookesLaw) {
  for (int seed = 0; seed < 10; ++seed) {
    Lattice lattice = full_lattice({4, 4, 4});
    lattice.material.poisson = 0.25 - 0.07 * seed;
    const Mat3 strain = random_strain(seed);
    strain_by(lattice, strain);
    const Mat3 stress = hooke(strain, lattice.material.young, lattice.material.poisson);
    double density = 0;
    for (int i = 0; i < 3; ++i) density += 0.5 * dot(stress[i], strain[i]);
    const double found =
        site_energies(lattice)[lattice.grid.index(2, 1, 2)] / std::pow(lattice.grid.pitch, 3);
    EXPECT_NEAR(found, density, 1e-13 * density);
  }
}

TEST(Elasticity, ForcesAcrossASectionAreItsStress) {
  // The part x > a of the lattice is pulled by the part x < a with the stress times the area, as far as cells
  // in the middle of the section go. Hold the left half of a strained bar at its place on the grid as ghosts
  // that belong to no bond among themselves: the force on the cells of one side is what crosses the section.
  const Mat3 strain = random_strain(3);
  Lattice lattice =
      make_lattice({8, 7, 7}, [](int i, int, int) { return i < 4 ? +site::ghost : free_particle; });
  strain_by(lattice, strain);
  const Loads6 f = kernel_forces(lattice);
  const Mat3 stress = hooke(strain, lattice.material.young, lattice.material.poisson);
  const Vec3 traction{stress[0][0], stress[1][0], stress[2][0]};
  const double area = lattice.grid.pitch * lattice.grid.pitch;
  for (int j = 2; j < 5; ++j)
    for (int k = 2; k < 5; ++k) {
      const Vec3 found = f.force[lattice.grid.index(3, j, k)];  // on the last ghosts, from the right
      EXPECT_LT(norm(found - area * traction), 1e-13 * f.largest());
    }
}

TEST(Elasticity, StiffnessesAreThePapers) {
  const ElasticBond law = ElasticBond::from({"", 0, 1000, 0.2}, 0.1);
  EXPECT_NEAR(law.k_n, 200 / 3.0, 1e-13);  // 2·1000·0.1 / (5·0.6)
  EXPECT_NEAR(law.k_s, 100 / 9.0, 1e-13);  // 2·1000·0.1·0.2 / (5·0.6·1.2)
  EXPECT_NEAR(ElasticBond::from({"", 0, 1000, 0.25}, 0.1).k_s, 0, 1e-13);
}

}  // namespace
}  // namespace geist::de
