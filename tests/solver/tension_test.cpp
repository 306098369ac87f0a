// The bar that every run pulls.
#include "solver/tension.hpp"

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "de/assembly.hpp"

namespace geist {
namespace {

Lattice like(double poisson, bool consistent) {
  Lattice lattice;
  lattice.material = {"m", 0.001, 1000, poisson};
  lattice.grid.pitch = 0.2;
  lattice.mass = 8e-6, lattice.inertia = 5.3e-8;
  if (consistent) lattice.classes.resize(1);
  return lattice;
}

/// Uniaxial stress is exact; the ends, where forces are spread over centres, have faded away a width further
/// on.
TEST(TensionTest, OfAConsistentLatticeFindsItsMaterial) {
  set_threads(1);
  for (const double poisson : {0.05, 0.15, 0.2, 0.25}) {
    const auto found = tension_test(like(poisson, true));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->young, 1000, 2);
    EXPECT_NEAR(found->poisson, poisson, 1e-3);
  }
}

/// The published lattice lacks bonds at its faces: four layers have 0.7 of E.
TEST(TensionTest, OfAPublishedLatticeIsSoft) {
  const auto found = tension_test(like(0.2, false));
  ASSERT_TRUE(found);
  EXPECT_LT(found->young, 900);
  EXPECT_GT(found->young, 600);
}

}  // namespace
}  // namespace geist
