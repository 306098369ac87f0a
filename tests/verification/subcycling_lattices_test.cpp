// Subcycling where the lattices are fine: bodies of coarse hexahedra around particles, which take short steps
// with the nodes that their ghosts ride on. What short steps make of the stiffness is found column by column
// from the program's own accelerations: it stays symmetric and stable.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>

#include "core/parallel.hpp"
#include "model/hash.hpp"
#include "solver/fine_part.hpp"
#include "verification/subcycling.hpp"
#include "verification/support.hpp"

namespace geist::verification {
namespace {

/// A bar whose middle is made of particles, free and in motion; `across` elements of its section, 1 × 1.
Case coupled_bar(const std::string& method, int across, const std::vector<std::string>& set = {}) {
  return read_case_text(fmt::format(R"(
method = "{}"
units = {{ length = "mm", mass = "g", time = "ms" }}
[materials.m]
density = 0.001
young = 1000
poisson = 0.2
[regions.left]
type = "hexahedra"
material = "m"
box = [[0, 0, 0], [3, 1, 1]]
divisions = [{}, {}, {}]
[regions.middle]
type = "lattice"
material = "m"
box = [[3, 0, 0], [4, 1, 1]]
radius = 0.125
[regions.right]
type = "hexahedra"
material = "m"
box = [[4, 0, 0], [7, 1, 1]]
divisions = [{}, {}, {}]
[[initial]]
velocity = [1, -2, 3]
spin = [3, -2, 5]
[[initial]]
where = {{ x = [5, 7] }}
velocity = [4, 30, -20]
[analysis]
type = "dynamic"
kinematics = "small"
duration = 1
)",
                                    method, 3 * across, across, across, 3 * across, across, across),
                        "bar.toml", set);
}

/// What the lattice bears; its bound comes last.
double lattice_bound(const Built& built) { return built.bounds.back().bound; }

/// A bar that takes steps of `factor` times what the lattice bears.
Simulation subcycled(double factor, const Case& input) {
  Built built = build(input);
  EXPECT_TRUE(subcycle(built.simulation, factor * lattice_bound(built), 0.9));
  EXPECT_TRUE(built.simulation.subcycling.lattices());
  return std::move(built.simulation);
}

TEST(SubcycledLattices, MeanStiffnessIsSymmetricAndStable) {
  Spectra spectra;
  const auto check = [&spectra](const Case& input, std::vector<double> steps) {
    const double bound = lattice_bound(build(input));
    for (double& dt : steps) dt *= bound;
    expect_symmetric_and_stable(input, steps, spectra);
  };
  for (const std::string method : {"published", "consistent"}) {
    check(coupled_bar(method, 1), {1.2, 1.6, 1.95, 2.9, 3.8, 5});
    check(coupled_bar(method, 2), {1.3, 1.95, 2.4});
  }
  EXPECT_GT(spectra.found, 10);
  for (int m = 2; m <= 4; ++m) EXPECT_GT(spectra.by_substeps[static_cast<std::size_t>(m)], 1) << m;
  RecordProperty("largest", spectra.words());
}

/// Only rounding may take momenta away.
TEST(SubcycledLattices, KeepMomenta) {
  for (const std::string method : {"published", "consistent"}) {
    constexpr long steps = 5000;
    Simulation sim = subcycled(1.8, coupled_bar(method, 2));
    sim.start();
    const Ledger before = sim.ledger();
    for (long n = 1; n <= steps; ++n) sim.step(n == steps);
    const Ledger after = sim.ledger();
    const double allowed = 10 * 1.1e-16 * std::sqrt(double(steps));
    EXPECT_LT(norm(after.linear - before.linear), allowed * 0.007 * 30) << method;
    EXPECT_LT(norm(after.angular - before.angular), allowed * 0.007 * 30 * 7) << method;
    EXPECT_GT(after.internal(), 0.02 * after.kinetic());
    EXPECT_LT(std::abs(after.balance()), 2e-2 * after.kinetic());  // v jumps at x = 5
  }
}

/// Largest error of the balance until 0.1 ms, of steps of dt / n with short steps of what is fine at dt.
double worst_balance_by(int n) {
  Simulation sim = subcycled(
      1.8, coupled_bar("consistent", 2,
                       {"initial=[{velocity=[0,0,0]}]", "supports=[{where={x=0},fix=[\"x\",\"y\",\"z\"]}]",
                        "loads=[{where={x=7},total_force=[1,0,-1]},"
                        "{where={region=\"middle\"},total_force=[0,0.5,0.3]}]"}));
  sim.dt /= n;
  return worst_balance(sim, 0.1);
}

TEST(SubcycledLattices, BalanceFallsWithTheSquareOfTheTimeStep) {
  const double coarse = worst_balance_by(2), half = worst_balance_by(4), quarter = worst_balance_by(8);
  EXPECT_NEAR(coarse / half, 4, 0.6) << coarse;
  EXPECT_NEAR(half / quarter, 4, 0.3) << half;
  RecordProperty("ratios", fmt::format("{:.3f} {:.3f}", coarse / half, half / quarter));
}

/// Loads on particles, gravity, supports of nodes and particles: what is at rest stays there.
TEST(SubcycledLattices, KeepEquilibrium) {
  Simulation sim = subcycled(
      1.8, coupled_bar("consistent", 2,
                       {"initial=[]", "analysis.start=static",
                        "supports=[{where={x=0},fix=[\"x\",\"y\",\"z\"]},"
                        "{where={region=\"middle\",z=0},fix=[\"y\"]}]",
                        "loads=[{where={region=\"middle\"},total_force=[0,0,-0.1]},{gravity=[0,3,-9]}]"}));
  RunPlan plan;
  plan.static_start = true, plan.end_time = 500 * sim.dt;
  const Outcome outcome = run(sim, plan, {});
  EXPECT_EQ(outcome.status, Status::completed) << outcome.message;
  EXPECT_GT(outcome.last.ledger.initial, 1e-6);
  EXPECT_LT(outcome.last.ledger.kinetic(), 1e-14 * outcome.last.ledger.initial);
}

/// Finite rotations: a turn of the free bar. The mean force acts at u^n, not where its parts do: angular
/// momentum wavers by 10⁻¹⁰ at these strains, with their square.
TEST(SubcycledLattices, Turn) {
  Simulation sim = subcycled(
      1.7, coupled_bar("consistent", 1,
                       {"analysis.kinematics=finite", "initial=[{velocity=[1,-2,3],spin=[3,6,-6]}]"}));
  EXPECT_GE(sim.subcycling.ratio(), 2);
  sim.start();
  const Ledger before = sim.ledger();
  const auto turn = static_cast<long>(2 * M_PI / 9 / sim.dt);
  double worst = 0;
  for (long n = 1; n <= turn; ++n) {
    sim.step(n % 50 == 0 || n == turn);
    if (n % 50 == 0) worst = std::max(worst, std::abs(sim.ledger().balance()));
  }
  const Ledger after = sim.ledger();
  EXPECT_LT(norm(after.linear - before.linear), 1e-13 * norm(before.linear));
  EXPECT_LT(norm(after.angular - before.angular), 1e-9 * norm(before.angular));
  EXPECT_LT(worst, 1e-4 * before.kinetic());
  RecordProperty("turn", fmt::format("momenta {:.1e} {:.1e}, balance {:.1e}, {} steps",
                                     norm(after.linear - before.linear) / norm(before.linear),
                                     norm(after.angular - before.angular) / norm(before.angular),
                                     worst / before.kinetic(), turn));
}

/// The coupled beam of the examples with `middle` mm of particles between ends of 62 mm, pulled down.
Built long_beam(int middle, const std::string& subcycling, const std::string& kinematics) {
  const auto box = [](int from, int to) { return fmt::format("box=[[{},0,0],[{},2,2]]", from, to); };
  return build(example(
      "beam", {fmt::format("analysis={{type=\"dynamic\",duration=1,kinematics=\"{}\",subcycling={}}}",
                           kinematics, subcycling),
               "regions.left." + box(-62, 0), "regions.left.divisions=[124,4,4]",
               "regions.middle." + box(0, middle), "regions.right." + box(middle, middle + 62),
               "regions.right.divisions=[124,4,4]", "supports=[{where={x=-62},fix=[\"x\",\"y\",\"z\"]}]",
               fmt::format("loads=[{{where={{x={}}},total_force=[2,0,-1]}}]", middle + 62),
               fmt::format("probes={{tip={{where={{x={}}},quantity=\"displacement\",component=\"z\","
                           "reduce=\"mean\"}}}}",
                           middle + 62)}));
}

double tip_after(Built& built, double time) {
  Simulation& sim = built.simulation;
  sim.dt = time / std::ceil(time / sim.dt);
  sim.start();
  while (sim.model.time < 0.999999 * time) sim.step(sim.model.time + 1.000001 * sim.dt > time);
  return built.probes[0].value(sim);
}

/// Chosen where it gains, with the answer of one step for all.
TEST(SubcycledLattices, GiveTheSameAnswer) {
  set_threads(1);
  for (const std::string kinematics : {"small", "finite"}) {
    Built one = long_beam(2, "false", kinematics), two = long_beam(2, "true", kinematics);
    EXPECT_TRUE(two.simulation.subcycling.lattices());
    EXPECT_GE(two.expected_gain, 1.05);
    EXPECT_GT(two.simulation.dt, 1.8 * one.simulation.dt);
    EXPECT_LT(two.simulation.dt / one.simulation.dt, two.simulation.subcycling.ratio());
    const double expected = tip_after(one, 0.4), tip = tip_after(two, 0.4);
    EXPECT_LT(expected, -1);
    EXPECT_NEAR(tip / expected, 1, 2e-4) << kinematics;
  }
}

std::string hash_of(int threads, const std::string& kinematics) {
  set_threads(threads);
  Simulation sim = std::move(long_beam(4, "true", kinematics).simulation);
  EXPECT_TRUE(sim.subcycling.lattices());
  sim.start();
  for (int n = 0; n < 40; ++n) sim.step(false);
  set_threads(1);
  return state_hash(sim.model);
}

TEST(SubcycledLattices, SameBitsForAnyNumberOfThreads) {
  for (const std::string kinematics : {"small", "finite"}) {
    const std::string one = hash_of(1, kinematics);
    EXPECT_EQ(hash_of(2, kinematics), one);
    EXPECT_EQ(hash_of(4, kinematics), one);
  }
}

/// Particles that may touch take the model's step, whatever it costs.
TEST(SubcycledLattices, NotWhereParticlesMayTouch) {
  Simulation sim = std::move(build(coupled_bar("consistent", 1, {"contact=[{between=\"all\"}]"})).simulation);
  const TimeStepLimits limits = time_step_limits(sim.model, sim.contacts);
  EXPECT_TRUE(limits.particles_may_touch);
  EXPECT_TRUE(fine_part(sim.model, limits, 1.9 * limits.bounds.back().bound, 1).empty());
}

}  // namespace
}  // namespace geist::verification
