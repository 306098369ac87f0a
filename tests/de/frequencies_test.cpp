// The largest frequency of the endless lattice: a bound for every lattice cut from it, and not a loose one.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/parallel.hpp"
#include "de/assembly.hpp"
#include "de/bonds.hpp"
#include "de/elastic_bond.hpp"
#include "de/support.hpp"

namespace geist::de {
namespace {

using namespace testing;

enum class Inertia { sphere, cube };

void set_inertia(Lattice& lattice, Inertia kind) {
  const double r = lattice.radius();
  lattice.mass = lattice.material.density * std::pow(2 * r, 3);
  lattice.inertia = lattice.mass * (kind == Inertia::sphere ? 0.4 * r * r : 4 * r * r / 6);
}

/// Largest ω² of K φ = ω² M φ by power iteration with the kernel's forces, a lower bound of it at every step.
double power_iteration(Lattice& lattice, int steps) {
  set_threads(1);
  move_at_random(lattice, 99);
  const double share[2] = {std::sqrt(lattice.mass), std::sqrt(lattice.inertia)};
  double omega2 = 0;
  for (int step = 0; step < steps; ++step) {
    // q = M^{-1/2} y, y ← M^{-1/2} K q; the kernel's force is −K q.
    const Loads6 f = kernel_forces(lattice);
    double yy = 0, zz = 0;
    std::vector<std::array<double, 6>> z(lattice.grid.size());
    for (std::size_t s = 0; s < z.size(); ++s)
      for (int c = 0; c < 6 && lattice.word[s]; ++c) {
        const double y = lattice.motion[c][s] * share[c / 3];
        z[s][c] = -(c < 3 ? f.force[s][c] : f.moment[s][c - 3]) / share[c / 3];
        yy += y * y, zz += z[s][c] * z[s][c];
      }
    omega2 = std::sqrt(zz / yy);  // ≤ the largest eigenvalue, since K is symmetric
    for (std::size_t s = 0; s < z.size(); ++s)
      for (int c = 0; c < 6 && lattice.word[s]; ++c)
        lattice.motion[c][s] = z[s][c] / std::sqrt(zz) / share[c / 3];
  }
  return omega2;
}

TEST(LargestFrequency, IsNotExceededByLatticesOfAnySize) {
  for (const Inertia inertia : {Inertia::sphere, Inertia::cube})
    for (const double poisson : {-0.2, 0.0, 0.2, 0.25})
      for (const auto& n : {std::array{2, 1, 1}, std::array{2, 2, 2}, std::array{5, 4, 3},
                            std::array{40, 3, 3}, std::array{9, 9, 9}}) {
        Lattice lattice = full_lattice(n);
        lattice.material.poisson = poisson;
        set_inertia(lattice, inertia);
        EXPECT_LE(power_iteration(lattice, 60), largest_frequency_squared(lattice) * (1 + 1e-12));
      }
}

TEST(LargestFrequency, IsNotExceededWhereSitesAreMissingOrGhosts) {
  for (int seed = 0; seed < 5; ++seed) {
    Lattice lattice = random_lattice({10, 8, 8}, seed);
    set_inertia(lattice, Inertia::sphere);
    EXPECT_LE(power_iteration(lattice, 60), largest_frequency_squared(lattice));
  }
}

TEST(LargestFrequency, IsNotExceededByConsistentLattices) {
  for (const Inertia inertia : {Inertia::sphere, Inertia::cube})
    for (const double poisson : {0.0, 0.2, 0.25, 0.26, 0.3, 0.4, 0.45, 0.49})
      for (const auto& n : {std::array{9, 1, 1}, std::array{9, 9, 1}, std::array{2, 2, 2},
                            std::array{20, 3, 3}, std::array{9, 9, 9}}) {
        Lattice lattice = full_lattice(n);
        lattice.material.poisson = poisson;
        set_inertia(lattice, inertia);
        assemble(lattice);
        const double bound = largest_frequency_squared(lattice), reached = power_iteration(lattice, 100);
        EXPECT_LE(reached, bound * (1 + 1e-12));
        if (n[0] == 9 && n[1] == 9) {
          EXPECT_LE(bound, (n[2] == 9 ? 1.4 : 2.5) * reached);  // no looser than it is today
        }
      }
  for (int seed = 0; seed < 8; ++seed) {
    Lattice lattice = random_lattice({10, 8, 8}, seed);
    set_inertia(lattice, seed % 2 ? Inertia::sphere : Inertia::cube);
    assemble(lattice);
    EXPECT_LE(power_iteration(lattice, 60), largest_frequency_squared(lattice));
  }
}

TEST(LargestFrequency, IsReachedByLargeLattices) {
  // A mode of n³ free sites is that of the endless lattice but for the surface: 1 − O(1/n²), and power
  // iteration falls short of it a little more. Both together stay within a tenth.
  for (const Inertia inertia : {Inertia::sphere, Inertia::cube})
    for (const double poisson : {0.2, 0.25}) {
      Lattice lattice = full_lattice({12, 12, 12});
      lattice.material.poisson = poisson;
      set_inertia(lattice, inertia);
      const double found = largest_frequency_squared(lattice), reached = power_iteration(lattice, 120);
      EXPECT_LE(found, 1.1 * reached);
      EXPECT_LE(reached, found * (1 + 1e-12));
    }
}

TEST(LargestFrequency, IsAtLeastThatOfTheWavesThatCanBeWrittenDown) {
  Lattice lattice = full_lattice({1, 1, 1});
  for (const Inertia inertia : {Inertia::sphere, Inertia::cube})
    for (const double poisson : {-0.2, 0.0, 0.1, 0.2, 0.25}) {
      lattice.material.poisson = poisson;
      set_inertia(lattice, inertia);
      const ElasticBond law = ElasticBond::from(lattice.material, lattice.radius());
      // All particles turn alike: each bond is sheared by 2 r θ × e. Σ |θ × e|² over half the bonds is 10.
      const double turning = 4 * std::pow(lattice.radius(), 2) * law.k_s * 10 / lattice.inertia;
      // Signs alternate with i + j + k: group 1 is stretched by twice u.
      const double alternating = 4 * (law.k_n + 2 * law.k_s) / lattice.mass;
      // Layers alternate along x, moving along x: every bond with a component along x (1 + 4 of the half).
      const double layers = 4 * (law.k_n + 4 * (law.k_n + law.k_s) / 2) / lattice.mass;
      const double found = largest_frequency_squared(lattice);
      EXPECT_GE(found, std::max({turning, alternating, layers}) * (1 - 1e-12));
    }
}

TEST(LargestFrequency, ScalesWithStiffnessSizeAndDensity) {
  Lattice lattice = full_lattice({1, 1, 1});
  set_inertia(lattice, Inertia::sphere);
  const double once = largest_frequency_squared(lattice);
  lattice.material.young *= 9, lattice.material.density *= 4, lattice.grid.pitch *= 0.5;
  set_inertia(lattice, Inertia::sphere);
  EXPECT_NEAR(largest_frequency_squared(lattice), once * 9 / 4 / 0.25, 1e-10 * once);  // ω ~ √(E/ρ)/r
}

TEST(LargestFrequency, GivesThePublishedModelsTimeSteps) {
  // A small coupled beam at ν 0.2 was measured to have critical steps of 1.87 r/c with a sphere's rotary
  // inertia and 2.04 r/c with a cube's, c² = E/ρ. The endless lattice's may be no longer, and not much
  // shorter.
  Lattice lattice = full_lattice({1, 1, 1});
  for (const auto& [inertia, measured] : {std::pair{Inertia::sphere, 1.87}, std::pair{Inertia::cube, 2.04}}) {
    set_inertia(lattice, inertia);
    const double c = std::sqrt(lattice.material.young / lattice.material.density);
    const double step = 2 / std::sqrt(largest_frequency_squared(lattice)) / (lattice.radius() / c);
    EXPECT_LE(step, measured + 0.005);
    EXPECT_GE(step, 0.9 * measured);
  }
}

}  // namespace
}  // namespace geist::de
