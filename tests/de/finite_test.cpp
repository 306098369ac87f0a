// Finite rotations: bonds do not feel rigid motion of any size, follow from an energy, and are those of small
// rotations when rotations are small. docs/theory.md, "Finite rotations of the lattice".
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/parallel.hpp"
#include "de/finite_stencil.hpp"
#include "de/rotation.hpp"
#include "de/support.hpp"

namespace geist::de {
namespace {

using namespace testing;

const std::array<Vec3, 4> turns{
    {Vec3{1e-3, 2e-3, -1e-3}, Vec3{0.3, -0.2, 0.9}, Vec3{-2, 1, 1.5}, Vec3{0, 3.14, 0}}};

class FiniteBonds : public ::testing::TestWithParam<bool> {
 protected:
  Lattice random(const std::array<int, 3>& n, int seed) {
    return finite(random_lattice(n, seed), GetParam());
  }
  Lattice full(const std::array<int, 3>& n) { return finite(full_lattice(n), GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Method, FiniteBonds, ::testing::Values(false, true),
                         [](const auto& is) { return is.param ? "consistent" : "published"; });

double energy(const Lattice& lattice) {
  const BondEnergies e = energies(lattice);
  return e.bonds + e.coupling;
}

/// Move everything rigidly: x ← Q x + shift, R ← Q R.
void move_rigidly(Lattice& lattice, const Mat3& Q, Vec3 shift) {
  for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
    if (!lattice.word[s]) continue;
    const Vec3 X = lattice.grid.centre(s);
    lattice.motion.set(s, Q * (X + lattice.motion.vector(s)) + shift - X);
    set_rotation(lattice, s, Q * rotation_matrix(lattice, s));
  }
}

/// Forces are sums of stiffness · rounding of positions of order 10.
TEST_P(FiniteBonds, VanishInRigidMotion) {
  for (const auto& n : shapes)
    for (const Vec3 turn : turns) {
      Lattice lattice = random(n, 7);
      move_rigidly(lattice, rotation_by(turn), {0.3, -0.2, 0.5});
      EXPECT_LE(kernel_forces(lattice).largest(), 1e-14 * lattice.material.young);
      EXPECT_LE(energy(lattice), 1e-27 * lattice.material.young);
    }
}

TEST_P(FiniteBonds, TurnWithTheFrame) {
  for (const Vec3 turn : turns) {
    Lattice lattice = random({9, 4, 3}, 3);
    turn_at_random(lattice, 4, 0.5);
    const Loads6 before = kernel_forces(lattice);
    const double energy_before = energy(lattice);
    const Mat3 Q = rotation_by(turn);
    move_rigidly(lattice, Q, {1, 2, -1});
    const Loads6 after = kernel_forces(lattice);
    EXPECT_NEAR(energy(lattice), energy_before, 1e-13 * energy_before);
    for (std::size_t s = 0; s < before.force.size(); ++s) {
      EXPECT_LE(norm(after.force[s] - Q * before.force[s]), 1e-13 * before.largest());
      EXPECT_LE(norm(after.moment[s] - Q * before.moment[s]), 1e-13 * before.largest());
    }
  }
}

/// Differences of fourth order: (8 (E₁ − E₋₁) − (E₂ − E₋₂)) / 12h.
template <class Move>
double derivative(const Lattice& lattice, double h, Move move) {
  const auto at = [&](double x) {
    move(x);
    const double e = energy(lattice);
    move(0);
    return e;
  };
  return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
}

/// With respect to displacements and to rotations exp(δθ×) R of every site, all bonds of both groups.
TEST_P(FiniteBonds, AreMinusTheDerivativesOfTheEnergy) {
  for (const int seed : {1, 2}) {
    Lattice lattice = random({5, 4, 3}, seed);
    turn_at_random(lattice, seed, 0.7);
    const Loads6 on = kernel_forces(lattice);
    const double h = 1e-3, allowed = 1e-9 * on.largest();
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      for (int c = 0; lattice.word[s] && c < 3; ++c) {
        const Vec3 u = lattice.motion.vector(s);
        const Mat3 R = rotation_matrix(lattice, s);
        Vec3 unit;
        unit[c] = 1;
        const auto move = [&](double x) { lattice.motion.set(s, u + x * unit); };
        const auto turn = [&](double x) { set_rotation(lattice, s, rotation_by(x * unit) * R); };
        EXPECT_NEAR(on.force[s][c], -derivative(lattice, h, move), allowed);
        EXPECT_NEAR(on.moment[s][c], -derivative(lattice, h, turn), allowed);
      }
  }
}

/// One bond at a time, so that errors of directions that mirror each other cannot cancel.
TEST_P(FiniteBonds, AreRightInEveryDirection) {
  for (const auto& e : directions) {
    Lattice pair = finite(make_lattice({3, 3, 3},
                                       [&](int i, int j, int k) {
                                         const bool middle = i == 1 && j == 1 && k == 1;
                                         const bool other = i == 1 + e[0] && j == 1 + e[1] && k == 1 + e[2];
                                         return middle || other ? free_particle : 0;
                                       }),
                          GetParam());
    turn_at_random(pair, 5, 0.5);
    const Loads6 on = kernel_forces(pair);
    const std::size_t s = pair.grid.index(1, 1, 1);
    const Mat3 R = rotation_matrix(pair, s);
    const Vec3 u = pair.motion.vector(s);
    for (int c = 0; c < 3; ++c) {
      Vec3 unit;
      unit[c] = 1;
      const auto move = [&](double x) { pair.motion.set(s, u + x * unit); };
      const auto turn = [&](double x) { set_rotation(pair, s, rotation_by(x * unit) * R); };
      EXPECT_NEAR(on.force[s][c], -derivative(pair, 1e-3, move), 1e-9 * on.largest());
      EXPECT_NEAR(on.moment[s][c], -derivative(pair, 1e-3, turn), 1e-9 * on.largest());
    }
  }
}

TEST_P(FiniteBonds, KeepMomentumAndAngularMomentum) {
  Lattice lattice = random({26, 4, 4}, 11);
  turn_at_random(lattice, 12, 0.5);
  const Loads6 on = kernel_forces(lattice);
  Vec3 momentum, angular;
  for (std::size_t s = 0; s < on.force.size(); ++s) {
    momentum += on.force[s];
    angular += cross(lattice.grid.centre(s) + lattice.motion.vector(s), on.force[s]) + on.moment[s];
  }
  EXPECT_LE(norm(momentum), 1e-13 * on.largest());
  EXPECT_LE(norm(angular), 1e-12 * on.largest());  // arms are at most 13 long
}

/// Forces of displacements and rotations of size θ differ from those of small rotations by θ².
TEST_P(FiniteBonds, AreThoseOfSmallRotationsToFirstOrder) {
  double before = 0;
  for (const double size : {1e-2, 1e-3, 1e-4}) {
    Lattice lattice = random({9, 4, 3}, 21);
    lattice.kinematics = Kinematics::small;
    move_at_random(lattice, 22);
    for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
      for (int c = 0; c < 6; ++c) lattice.motion[c][s] *= size;
      set_rotation(lattice, s, rotation_by(lattice.motion.vector(s, 3)));
    }
    const Loads6 small = kernel_forces(lattice);
    lattice.kinematics = Kinematics::finite;
    const Loads6 found = kernel_forces(lattice);
    double difference = 0;
    for (std::size_t s = 0; s < small.force.size(); ++s)
      difference = std::max(
          {difference, norm(found.force[s] - small.force[s]), norm(found.moment[s] - small.moment[s])});
    difference /= small.largest();
    EXPECT_LT(difference, 5 * size);
    if (before > 0) {
      EXPECT_NEAR(before / difference, 10, 0.5);
    }
    before = difference;
  }
}

TEST_P(FiniteBonds, HaveEnergiesBySite) {
  Lattice lattice = random({9, 4, 3}, 31);
  turn_at_random(lattice, 32, 0.5);
  double sum = 0;
  for (const double e : site_energies(lattice)) sum += e;
  EXPECT_NEAR(sum, energy(lattice), 1e-13 * sum);
}

TEST_P(FiniteBonds, IgnoreWhateverIsAtEmptySites) {
  Lattice lattice = random({26, 4, 4}, 3);
  turn_at_random(lattice, 4, 0.5);
  const Loads6 before = kernel_forces(lattice);
  for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
    for (int c = 0; c < 3 && !lattice.word[s]; ++c) lattice.motion[c][s] = std::nan("");
    for (int c = 0; c < 9 && !lattice.word[s]; ++c) lattice.rotation[c][s] = std::nan("");
  }
  const Loads6 after = kernel_forces(lattice);
  EXPECT_EQ(before.force, after.force);
  EXPECT_EQ(before.moment, after.moment);
}

TEST(FiniteKernel, IsTheScalarFormulasToTheBit) {
  for (const auto& n : shapes) {
    Lattice lattice = finite(random_lattice(n, 12), false);
    turn_at_random(lattice, 13, 0.5);
    const Loads6 packed = kernel_forces(lattice);
    std::ptrdiff_t offset[18];
    for (int d = 0; d < 18; ++d) offset[d] = lattice.grid.offset(d);
    const ElasticBond law = ElasticBond::from(lattice.material, lattice.radius());
    for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
      if (!lattice.word[s]) continue;
      double f[6];
      site_force(finite_view(lattice), s, offset, law, lattice.radius(), SiteBonds{lattice.word[s]}, f);
      for (int c = 0; c < 6; ++c) EXPECT_EQ(c < 3 ? packed.force[s][c] : packed.moment[s][c - 3], f[c]);
    }
  }
}

TEST_P(FiniteBonds, HaveTheSameBitsForAnyNumberOfThreads) {
  std::vector<std::vector<std::uint64_t>> bits;
  for (int n_threads = 1; n_threads <= 4; ++n_threads) {
    set_threads(n_threads);
    Lattice lattice = random({19, 9, 11}, 21);
    turn_at_random(lattice, 22, 0.5), push_at_random(lattice, 23);
    auto& b = bits.emplace_back();
    const auto keep = [&b](double x) { b.push_back(std::bit_cast<std::uint64_t>(x)); };
    for (int step = 0; step < 3; ++step) {
      turn(lattice, 0.01);
      const KickSums sums = bond_forces_and_kick(lattice, Kick{0.99, 0.1, 0.7, {0.01, 0, -0.02}});
      for (const double x : {sums.across, sums.after, sums.spin_across, sums.spin_after}) keep(x);
    }
    for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
      for (int c = 0; c < 6; ++c) keep(lattice.velocity[c][s]);
      for (int c = 0; c < 9; ++c) keep(lattice.rotation[c][s]);
    }
    EXPECT_EQ(b, bits.front());
  }
}

}  // namespace
}  // namespace geist::de
