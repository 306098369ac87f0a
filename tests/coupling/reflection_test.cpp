// The reflection estimate against figures computed independently (a separate program, the same chains).
#include "coupling/reflection.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace geist::coupling {
namespace {

const Material material{"m", 0.001, 1000, 0.2};

void expect_reflection(double ratio, double waves, bool consistent, double per_cent) {
  const double h = 0.5;
  EXPECT_NEAR(100 * reflected({material, h}, {material, 2 * h / ratio}, waves * h, consistent), per_cent,
              0.006 * per_cent + 0.006)
      << ratio << " " << waves;
}

TEST(Reflection, OfThePublishedInterface) {
  expect_reflection(10, 10, false, 2.84);
  expect_reflection(5, 5, false, 9.06);
  expect_reflection(5, 10, false, 4.97);
  expect_reflection(5, 40, false, 1.26);
  expect_reflection(2, 10, false, 8.68);
}

TEST(Reflection, OfTheConsistentInterface) {
  expect_reflection(10, 10, true, 2.55);
  expect_reflection(5, 5, true, 14.39);
  expect_reflection(5, 10, true, 2.38);
  expect_reflection(5, 40, true, 0.13);
  expect_reflection(2, 10, true, 1.44);
}

/// Long waves see nothing but the materials: (Z_1 − Z_2)/(Z_1 + Z_2).
TEST(Reflection, OfOtherMaterials) {
  const Material other{"o", 0.002, 3000, 0.2};
  const double z = std::sqrt(0.002 * 3000 / (0.001 * 1000));
  EXPECT_NEAR(reflected({material, 0.5}, {other, 0.2}, 5000, true), (z - 1) / (z + 1), 1e-4);
}

TEST(FinestWavelength, IsSlowByOnePerCent) {
  const double h = 0.3, x = M_PI * h / finest_wavelength(h);  // ω = (2c/h) sin(πh/λ)
  EXPECT_NEAR(std::sin(x) / x, 0.99, 2e-4);
}

}  // namespace
}  // namespace geist::coupling
