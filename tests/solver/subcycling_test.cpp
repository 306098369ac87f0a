// The short steps' coefficients, and what is chosen to take them.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/fine_part.hpp"
#include "solver/subcycling.hpp"
#include "support.hpp"

namespace geist {
namespace {

using namespace testing;

/// Displacement after m steps of a mass on a spring ω² = 1 that starts from 1 at rest.
double after_short_steps(int m, double dt) {
  double z = 1, increment = 0;
  for (const Substep& step : substeps(m)) {
    increment = step.keep * increment - step.gain * dt * dt * z;
    z += increment;
  }
  return z;
}

/// z_m − z_0 = ½ Δt² × the mean acceleration.
TEST(Substeps, MeanForceIsTheirDisplacement) {
  constexpr double dt = 0.7;
  for (int m = 1; m <= 8; ++m) {
    double z = 1, increment = 0, mean = 0, shares = 0;
    for (const Substep& step : substeps(m)) {
      mean -= step.share * z, shares += step.share;
      increment = step.keep * increment - step.gain * dt * dt * z;
      z += increment;
    }
    EXPECT_NEAR(shares, 1, 1e-14) << m;
    EXPECT_NEAR(z - 1, dt * dt / 2 * mean, 1e-14) << m;
  }
}

/// cos Δt to the second order; damping ν = 1/10 changes what follows.
TEST(Substeps, FollowTheMotion) {
  for (int m = 2; m <= 8; ++m)
    for (const double dt : {0.1, 0.2})
      EXPECT_NEAR(after_short_steps(m, dt), std::cos(dt), 0.03 * std::pow(dt, 4)) << m;
}

/// Up to stable_phase and no further they stay within ±1, and resonances within what stable_remainder leaves.
TEST(Substeps, StayWithinTheirLimits) {
  for (int m = 2; m <= 8; ++m) {
    const double end = stable_phase(m), least = -1 + stable_remainder(m) / 2;
    EXPECT_GT(end, 0.965 * 2 * m);
    EXPECT_GT(stable_remainder(m), 0.15);
    for (double phase = 0.05; phase < 1; phase += 0.001) {
      const double z = after_short_steps(m, phase * end);
      EXPECT_LT(z, 1) << m << ' ' << phase;
      if (phase < 0.9) {
        EXPECT_GT(z, least - 1e-12) << m << ' ' << phase;
      }
    }
    EXPECT_NEAR(std::abs(after_short_steps(m, end)), 1, 1e-12);
    EXPECT_GT(std::abs(after_short_steps(m, 1.01 * end)), 1);
  }
}

/// The column with elements that grow upwards, by how much.
Built graded(double ratio, const std::string& more = "") {
  set_threads(1);
  return build(
      read_case_text(column(dynamic(1) + "subcycling = true\n"), "case.toml",
                     {fmt::format("regions.column.grading={{z={{towards=\"low\",ratio={}}}}}", ratio),
                      "regions.column.divisions=[1,1,40]", more.empty() ? "analysis.safety=0.9" : more}));
}

TEST(FinePart, SmallElementsTakeShortSteps) {
  const Built built = graded(8);
  const Simulation& sim = built.simulation;
  ASSERT_FALSE(sim.subcycling.empty());
  const double one = 0.9 * critical(built.bounds).bound;
  EXPECT_GT(sim.dt, 1.5 * one);
  EXPECT_LE(sim.dt / one, sim.subcycling.ratio());
  EXPECT_GE(built.expected_gain, 1.05);
}

TEST(FinePart, NothingWhereNothingIsGained) {
  EXPECT_TRUE(graded(1).simulation.subcycling.empty());
  EXPECT_TRUE(graded(8, "analysis.subcycling=false").simulation.subcycling.empty());
  EXPECT_EQ(graded(1).simulation.dt, graded(1, "analysis.subcycling=false").simulation.dt);
}

/// Every node outside bears the long step, every neighbour of one that does not is fine.
TEST(FinePart, IsWhatIsFastAndOneLayerMore) {
  const Built built = graded(8);
  const Simulation& sim = built.simulation;
  const TimeStepLimits limits = time_step_limits(sim.model, sim.contacts);
  const FinePart fine = fine_part(sim.model, limits, sim.dt, 0.9);
  ASSERT_FALSE(fine.empty());
  EXPECT_EQ(fine.m, sim.subcycling.ratio());
  const auto fast = [&](std::int32_t i) {
    return std::sqrt(limits.nodes.frequency_squared[i]) * sim.dt > 1.8;
  };
  for (const auto& element : sim.model.mesh.elements)
    for (const std::int32_t i : element)
      for (const std::int32_t j : element) EXPECT_TRUE(fine.is_fine[j] || !fast(i));
  EXPECT_TRUE(fine_part(sim.model, limits, 100 * sim.dt, 0.9).empty());
}

}  // namespace
}  // namespace geist
