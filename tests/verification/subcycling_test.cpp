// Subcycling: small elements take short steps, and nothing else changes. What the short steps make of the
// stiffness is found column by column from the program's own forces: it stays symmetric (or like a symmetric
// one, where contacts act on a fine body), so that energy is kept, and central differences with the step of
// the rest are stable with it.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>

#include "core/parallel.hpp"
#include "model/hash.hpp"
#include "verification/subcycling.hpp"
#include "verification/support.hpp"

namespace geist::verification {
namespace {

/// A bar whose elements grow along x, free.
Case graded_bar(double ratio, const std::string& formulation, const std::vector<std::string>& set = {}) {
  return read_case_text(fmt::format(R"(
units = {{ length = "mm", mass = "g", time = "ms" }}
[materials.m]
density = 0.001
young = 1000
poisson = 0.3
[regions.bar]
type = "hexahedra"
material = "m"
box = [[0, 0, 0], [8, 1, 1]]
divisions = [40, 2, 1]
grading = {{ x = {{ towards = "low", ratio = {} }} }}
formulation = "{}"
[[initial]]
velocity = [1, -2, 3]
spin = [3, -2, 5]
[[initial]]
where = {{ x = [6, 8] }}
velocity = [4, 30, -20]
[analysis]
type = "dynamic"
kinematics = "small"
subcycling = true
duration = 1
)",
                                    ratio, formulation),
                        "bar.toml", set);
}

/// From the bound of all to as far as eight short ones go.
void expect_symmetric_and_stable(const Case& input, Spectra& spectra) {
  std::vector<double> steps;
  for (double factor = 1.15; factor < 8; factor *= 1.17)
    steps.push_back(factor * critical(build(input).bounds).bound);
  expect_symmetric_and_stable(input, steps, spectra);
}

TEST(Subcycling, MeanStiffnessIsSymmetricAndStable) {
  Spectra spectra;
  for (const double ratio : {3.0, 8.0, 20.0})
    for (const std::string formulation : {"assumed-strain", "full"})
      expect_symmetric_and_stable(graded_bar(ratio, formulation, {"regions.bar.divisions=[14,2,1]"}),
                                  spectra);
  EXPECT_GT(spectra.found, 40);
  for (int m = 2; m <= 5; ++m) EXPECT_GT(spectra.by_substeps[m], 2) << m;
  RecordProperty("largest", spectra.words());
}

/// Elements of all shapes, the smallest at the core or under the surface.
TEST(Subcycling, MeanStiffnessOfABall) {
  Spectra spectra;
  for (const std::string towards : {"low", "high"})
    for (const std::string formulation : {"assumed-strain", "selective-reduced", "one-point"})
      expect_symmetric_and_stable(
          graded_bar(
              1, formulation,
              {"initial=[]",
               fmt::format(
                   "regions={{ball={{type=\"hexahedra\",material=\"m\",ball={{centre=[0,0,0],radius=3}},"
                   "divisions=[2,4],grading={{radius={{towards=\"{}\",ratio=6}}}},formulation=\"{}\"}}}}",
                   towards, formulation)}),
          spectra);
  EXPECT_GT(spectra.found, 20);
  RecordProperty("largest", spectra.words());
}

/// As fast as they may be, twice the bound of one step for all; only rounding may take momenta away.
TEST(Subcycling, KeepsMomenta) {
  constexpr long steps = 5000;
  Simulation sim = std::move(build(graded_bar(8, "selective-reduced")).simulation);
  ASSERT_FALSE(sim.subcycling.empty());
  EXPECT_GE(sim.subcycling.ratio(), 2);
  sim.start();
  const Ledger before = sim.ledger();
  for (long n = 1; n <= steps; ++n) sim.step(n == steps);
  const Ledger after = sim.ledger();
  const double allowed = 10 * 1.1e-16 * std::sqrt(double(steps));
  EXPECT_LT(norm(after.linear - before.linear), allowed * 0.008 * 30);
  EXPECT_LT(norm(after.angular - before.angular), allowed * 0.008 * 30 * 8);
  EXPECT_GT(after.internal(), 0.02 * after.kinetic());
  EXPECT_LT(std::abs(after.balance()), 2e-2 * after.kinetic());  // v jumps at x = 6
}

/// Largest error of the balance until 0.1 ms, of steps of dt / n with the fine part of dt.
double worst_balance_by(int n) {
  Built built =
      build(graded_bar(20, "assumed-strain",
                       {"initial=[{velocity=[0,0,0]}]", "supports=[{where={x=0},fix=[\"x\",\"y\",\"z\"]}]",
                        "loads=[{where={x=8},total_force=[1,0,-1]}]"}));
  Simulation& sim = built.simulation;
  EXPECT_FALSE(sim.subcycling.empty());
  sim.dt /= n;
  return worst_balance(sim, 0.1);
}

TEST(Subcycling, BalanceFallsWithTheSquareOfTheTimeStep) {
  const double coarse = worst_balance_by(2), half = worst_balance_by(4), quarter = worst_balance_by(8);
  EXPECT_NEAR(coarse / half, 4, 0.6) << coarse;
  EXPECT_NEAR(half / quarter, 4, 0.3) << half;
  RecordProperty("ratios", fmt::format("{:.3f} {:.3f}", coarse / half, half / quarter));
}

/// Loads, gravity and supports in the fine part: what is at rest stays there, as force means do not change
/// what is zero all along.
TEST(Subcycling, KeepsEquilibrium) {
  Built built = build(
      graded_bar(20, "assumed-strain",
                 {"initial=[]", "analysis.start=static", "supports=[{where={x=0},fix=[\"x\",\"y\",\"z\"]}]",
                  "loads=[{where={z=1},traction=[0,0,-0.1]},{gravity=[0,3,-9]}]"}));
  ASSERT_FALSE(built.simulation.subcycling.empty());
  RunPlan plan;
  plan.static_start = true, plan.end_time = 500 * built.simulation.dt;
  const Outcome outcome = run(built.simulation, plan, {});
  EXPECT_EQ(outcome.status, Status::completed) << outcome.message;
  EXPECT_GT(outcome.last.ledger.initial, 1e-6);
  EXPECT_LT(outcome.last.ledger.kinetic(), 1e-14 * outcome.last.ledger.initial);
}

/// Finite rotations: ten turns of the free bar. Means of forces at other places than u^n are not exactly
/// those of one energy, nor is their moment about u^n exactly zero.
TEST(Subcycling, TurnsTenTimes) {
  Simulation sim = std::move(
      build(graded_bar(8, "assumed-strain",
                       {"analysis.kinematics=finite", "initial=[{velocity=[1,-2,3],spin=[1,2,-2]}]"}))
          .simulation);
  ASSERT_FALSE(sim.subcycling.empty());
  sim.start();
  const Ledger before = sim.ledger();
  const auto turns = static_cast<long>(20 * M_PI / 3 / sim.dt);
  double worst = 0;
  for (long n = 1; n <= turns; ++n) {
    sim.step(n % 1000 == 0 || n == turns);
    if (n % 1000 == 0) worst = std::max(worst, std::abs(sim.ledger().balance()));
  }
  const Ledger after = sim.ledger();
  EXPECT_LT(norm(after.linear - before.linear), 1e-13 * norm(before.linear));
  EXPECT_LT(norm(after.angular - before.angular), 1e-9 * norm(before.angular));
  EXPECT_LT(worst, 1e-4 * before.kinetic());
  RecordProperty("turns", fmt::format("momenta {:.1e} {:.1e}, balance {:.1e}, {} steps",
                                      norm(after.linear - before.linear) / norm(before.linear),
                                      norm(after.angular - before.angular) / norm(before.angular),
                                      worst / before.kinetic(), turns));
}

/// A ball on the plate of the examples, all of it fine, with coarser meshes than there: contact acts on what
/// takes short steps, and the plate's steps are those that its particles allow.
struct Impact {
  double force, lowest,
      balance;  ///< largest force, the plate's middle, error of the balance by the energy put in
  double dt;
};

Impact impact(const std::string& subcycling) {
  const Case input = example("ball-on-plate", {"analysis.duration=1.2", "regions.rim.divisions=[40,40,2]",
                                               "regions.ball.divisions=[6,3]", "regions.middle.radius=0.2",
                                               "analysis.subcycling=" + subcycling});
  set_threads(1);
  Built built = build(input);
  Simulation& sim = built.simulation;
  EXPECT_EQ(sim.subcycling.empty(), subcycling == "false");
  Impact seen{0, 0, 0, sim.dt};
  sim.start();
  while (sim.model.time < input.analysis.duration) {
    const bool look = sim.model.step % 10 == 9;
    sim.step(look);
    if (!look) continue;
    seen.force = std::max(seen.force, built.probes[0].value(sim));
    seen.lowest = std::min(seen.lowest, built.probes[1].value(sim));
    const Ledger now = sim.ledger();
    seen.balance = std::max(seen.balance, std::abs(now.balance()) / now.initial);
  }
  return seen;
}

TEST(Subcycling, BallOnAPlate) {
  const Impact one = impact("false"), two = impact("true");
  EXPECT_GT(two.dt, 1.6 * one.dt);
  EXPECT_NEAR(two.force / one.force, 1, 3e-3);
  EXPECT_NEAR(two.lowest / one.lowest, 1, 1e-4);
  EXPECT_LT(two.balance, 1e-5);
  RecordProperty("apart",
                 fmt::format("force {:.1e}, lowest {:.1e}, balances {:.1e} {:.1e}", two.force / one.force - 1,
                             two.lowest / one.lowest - 1, one.balance, two.balance));
}

std::string hash_of(int threads) {
  set_threads(threads);
  Simulation sim =
      std::move(build(graded_bar(20, "one-point", {"regions.bar.divisions=[40,8,8]"})).simulation);
  EXPECT_FALSE(sim.subcycling.empty());
  sim.start();
  for (int n = 0; n < 200; ++n) sim.step(false);
  set_threads(1);
  return state_hash(sim.model);
}

TEST(Subcycling, SameBitsForAnyNumberOfThreads) {
  const std::string one = hash_of(1);
  EXPECT_EQ(hash_of(2), one);
  EXPECT_EQ(hash_of(4), one);
}

/// Where all elements are alike, or the lattice is what limits the step, there is nothing to gain; nothing
/// changes then.
TEST(Subcycling, OnlyWhereItGains) {
  EXPECT_TRUE(build(graded_bar(1, "assumed-strain")).simulation.subcycling.empty());
  EXPECT_TRUE(
      build(graded_bar(8, "assumed-strain", {"analysis.time_step=1e-5"})).simulation.subcycling.empty());
  EXPECT_TRUE(
      build(graded_bar(8, "one-point", {"regions.bar.hourglass=viscous"})).simulation.subcycling.empty());
  EXPECT_TRUE(build(example("beam", {"analysis={type=\"dynamic\",duration=1,subcycling=true}"}))
                  .simulation.subcycling.empty());
}

}  // namespace
}  // namespace geist::verification
