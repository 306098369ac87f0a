#include "solver/relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/support.hpp"

namespace geist::testing {
namespace {

constexpr const char* pull = "[[loads]]\nwhere = { z = 4 }\ntotal_force = [0, 0, 1]\n";

TEST(Relaxation, StopsAtTheTolerance) {
  double before = 1;
  for (const double tolerance : {1e-2, 1e-4, 1e-8}) {
    Built built = build_text(column(std::string(tip_probe) + standing + pull + quasi_static()));
    const Outcome outcome = run(built.simulation, quasi_static_plan(tolerance), {});
    EXPECT_EQ(outcome.status, Status::completed);
    EXPECT_TRUE(outcome.message.empty());
    EXPECT_LE(outcome.last.residual, tolerance);
    const double exact = length / (young * area);
    const double error = std::abs(built.probes[0].value(built.simulation) / exact - 1);
    EXPECT_LT(error, 20 * tolerance);  // a residual on eight layers of nodes
    EXPECT_LE(error, before);
    before = error;
  }
}

TEST(Relaxation, SaysSoIfItDoesNotGetThere) {
  Built built = build_text(column(standing + std::string(pull) + quasi_static()));
  RunPlan plan = quasi_static_plan();
  plan.max_steps = 50;
  const Outcome outcome = run(built.simulation, plan, {});
  EXPECT_EQ(outcome.status, Status::not_converged);
  EXPECT_EQ(built.simulation.model.step, 50);
  EXPECT_GT(outcome.last.residual, plan.tolerance);
  EXPECT_NE(outcome.message.find("no equilibrium after 50 steps"), std::string::npos) << outcome.message;
}

TEST(Relaxation, GivesUpAtTheEndTime) {
  Built built = build_text(column(standing + std::string(pull) + quasi_static()));
  RunPlan plan = quasi_static_plan();
  plan.end_time = 20.5 * built.simulation.dt;
  EXPECT_EQ(run(built.simulation, plan, {}).status, Status::not_converged);
  EXPECT_EQ(built.simulation.model.step, 21);
}

/// α = 2ω of the mode in motion: from its own vibration in the lowest mode a bar is damped critically. The
/// bar's lowest ω is (π/2L) √(E/ρ), that of eight lumped elements 0.2 % less.
TEST(Relaxation, DampsTheLowestModeCritically) {
  Built built = build_text(column(standing + dynamic(1)));
  Simulation& sim = built.simulation;
  for (std::size_t i = 0; i < sim.model.mesh.nodes(); ++i)
    sim.model.mesh.u.set(i, {0, 0, 1e-3 * std::sin(M_PI * sim.model.mesh.points[i].z / (2 * length))});
  Relaxation relaxation;
  sim.start();
  for (int n = 0; n < 200; ++n) sim.step(false), relaxation.update(sim);
  EXPECT_NEAR(sim.alpha, 2 * M_PI / (2 * length) * std::sqrt(young / density), 0.01 * sim.alpha);
}

/// Nothing happens at first; the load comes later. A state of rest before the curve's end is not the answer.
TEST(Relaxation, WaitsForItsCurves) {
  const std::string later = "[curves.later]\npoints = [[1, 0], [2, 1]]\n";
  Built built = build_text(
      column(std::string(tip_probe) + standing + later + pull + "curve = \"later\"\n" + quasi_static()));
  const Outcome outcome = run(built.simulation, quasi_static_plan(), {});
  EXPECT_EQ(outcome.status, Status::completed);
  EXPECT_GT(built.simulation.model.time, 2);
  EXPECT_NEAR(built.probes[0].value(built.simulation), length / (young * area), 1e-6);
}

}  // namespace
}  // namespace geist::testing
