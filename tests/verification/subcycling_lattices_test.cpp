// Subcycling where the lattices are fine: bodies of coarse hexahedra around particles, which take short steps
// with the nodes that their ghosts ride on. What short steps make of the stiffness is found column by column
// from the program's own accelerations: it stays symmetric and stable.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <Eigen/Dense>
#include <cmath>

#include "core/parallel.hpp"
#include "model/hash.hpp"
#include "solver/fine_part.hpp"
#include "verification/bodies.hpp"
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

/// Let sim take steps of `factor` times what the lattices bear, if they can take short ones.
bool subcycle(Simulation& sim, double factor, double safety = 1) {
  const TimeStepLimits limits = time_step_limits(sim.model, sim.contacts);
  const double dt = factor * limits.bounds.back().bound;
  const FinePart fine = fine_part(sim.model, limits, dt, safety);
  if (fine.empty()) return false;
  EXPECT_TRUE(fine.lattices);
  sim.dt = dt, sim.subcycling = Subcycling(sim.model, fine);
  return true;
}

/// Where a number of the motion and its rate lie, and its mass or inertia.
struct Degree {
  double *u, *v;
  double mass;
};

/// Nodes, particles and ghosts that spin by themselves.
std::vector<Degree> degrees_of(Model& model) {
  std::vector<Degree> all;
  for (std::size_t i = 0; i < model.mesh.nodes(); ++i)
    for (int c = 0; c < 3; ++c) all.push_back({&model.mesh.u[c][i], &model.mesh.v[c][i], model.mesh.mass[i]});
  for (Lattice& lattice : model.lattices)
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      for (int c = 0; c < 6; ++c) {
        const bool spins = lattice.ghost_rotation == GhostRotation::own && c >= 3;
        if (lattice.is(s, site::particle) || (lattice.is(s, site::ghost) && spins))
          all.push_back(
              {&lattice.motion[c][s], &lattice.velocity[c][s], c < 3 ? lattice.mass : lattice.inertia});
      }
  return all;
}

/// M^{-1/2} K̃ M^{-1/2}: the first half kick makes ½ Δt ã of what is at rest.
Eigen::MatrixXd mean_stiffness(Simulation& sim) {
  const auto count = static_cast<Eigen::Index>(degrees_of(sim.model).size());
  Eigen::MatrixXd K(count, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    // arrays change places in short steps
    for (const Degree& degree : degrees_of(sim.model)) *degree.u = *degree.v = 0;
    *degrees_of(sim.model)[static_cast<std::size_t>(j)].u = 1;
    sim.start();
    const std::vector<Degree> degrees = degrees_of(sim.model);
    const Degree& moved = degrees[static_cast<std::size_t>(j)];
    EXPECT_EQ(*moved.u, 1);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Degree& degree = degrees[static_cast<std::size_t>(i)];
      K(i, j) = -2 / sim.dt * *degree.v * std::sqrt(degree.mass / moved.mass);
    }
  }
  return K;
}

struct Spectra {
  int found = 0;
  std::vector<int> by_substeps = std::vector<int>(9);
  double largest = 0;  ///< Δt² ω² / 4
};

void expect_symmetric_and_stable(const Case& input, const std::vector<double>& factors, Spectra& spectra) {
  set_threads(1);
  for (const double factor : factors) {
    Simulation sim = std::move(build(input).simulation);
    if (!subcycle(sim, factor)) continue;
    const Eigen::MatrixXd K = mean_stiffness(sim);
    const double limit = 4 / (sim.dt * sim.dt);
    EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-12 * K.cwiseAbs().maxCoeff()) << factor;
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>((K + K.transpose()) / 2, Eigen::EigenvaluesOnly)
            .eigenvalues();
    const double highest = values(values.size() - 1);
    EXPECT_GT(values(0), -1e-11 * limit);
    EXPECT_LT(values(5), 1e-11 * limit);  // rigid motions
    EXPECT_LT(highest, limit) << factor << ' ' << sim.subcycling.ratio();
    spectra.largest = std::max(spectra.largest, highest / limit);
    ++spectra.found, ++spectra.by_substeps[static_cast<std::size_t>(sim.subcycling.ratio())];
  }
}

TEST(SubcycledLattices, MeanStiffnessIsSymmetricAndStable) {
  Spectra spectra;
  for (const std::string method : {"published", "consistent"}) {
    expect_symmetric_and_stable(coupled_bar(method, 1), {1.2, 1.6, 1.95, 2.9, 3.8, 5}, spectra);
    expect_symmetric_and_stable(coupled_bar(method, 2), {1.3, 1.95, 2.4}, spectra);
  }
  EXPECT_GT(spectra.found, 10);
  for (int m = 2; m <= 4; ++m) EXPECT_GT(spectra.by_substeps[static_cast<std::size_t>(m)], 1) << m;
  RecordProperty("largest", fmt::format("{:.4f} of the limit, {} divisions", spectra.largest, spectra.found));
}

/// Only rounding may take momenta away.
TEST(SubcycledLattices, KeepMomenta) {
  for (const std::string method : {"published", "consistent"}) {
    constexpr long steps = 5000;
    Simulation sim = std::move(build(coupled_bar(method, 2)).simulation);
    ASSERT_TRUE(subcycle(sim, 1.8, 0.9));
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
double worst_balance(int n) {
  Simulation sim = std::move(
      build(coupled_bar("consistent", 2,
                        {"initial=[{velocity=[0,0,0]}]", "supports=[{where={x=0},fix=[\"x\",\"y\",\"z\"]}]",
                         "loads=[{where={x=7},total_force=[1,0,-1]},"
                         "{where={region=\"middle\"},total_force=[0,0.5,0.3]}]"}))
          .simulation);
  EXPECT_TRUE(subcycle(sim, 1.8, 0.9));
  sim.dt /= n;
  sim.start();
  double worst = 0;
  const auto steps = std::lround(0.1 / sim.dt);
  for (long i = 1; i <= steps; ++i) {
    sim.step(true);
    worst = std::max(worst, std::abs(sim.ledger().balance()));
  }
  return worst;
}

TEST(SubcycledLattices, BalanceFallsWithTheSquareOfTheTimeStep) {
  const double coarse = worst_balance(2), half = worst_balance(4), quarter = worst_balance(8);
  EXPECT_NEAR(coarse / half, 4, 0.6) << coarse;
  EXPECT_NEAR(half / quarter, 4, 0.3) << half;
  RecordProperty("ratios", fmt::format("{:.3f} {:.3f}", coarse / half, half / quarter));
}

/// Loads on particles, gravity, supports of nodes and particles: what is at rest stays there.
TEST(SubcycledLattices, KeepEquilibrium) {
  Built built = build(coupled_bar(
      "consistent", 2,
      {"initial=[]", "analysis.start=static",
       "supports=[{where={x=0},fix=[\"x\",\"y\",\"z\"]},{where={region=\"middle\",z=0},fix=[\"y\"]}]",
       "loads=[{where={region=\"middle\"},total_force=[0,0,-0.1]},{gravity=[0,3,-9]}]"}));
  ASSERT_TRUE(subcycle(built.simulation, 1.8, 0.9));
  RunPlan plan;
  plan.static_start = true, plan.end_time = 500 * built.simulation.dt;
  const Outcome outcome = run(built.simulation, plan, {});
  EXPECT_EQ(outcome.status, Status::completed) << outcome.message;
  EXPECT_GT(outcome.last.ledger.initial, 1e-6);
  EXPECT_LT(outcome.last.ledger.kinetic(), 1e-14 * outcome.last.ledger.initial);
}

/// Finite rotations: a turn of the free bar. The mean force acts at u^n, not where its parts do: angular
/// momentum wavers by 10⁻¹⁰ at these strains, with their square.
TEST(SubcycledLattices, Turn) {
  Simulation sim = std::move(
      build(coupled_bar("consistent", 1,
                        {"analysis.kinematics=finite", "initial=[{velocity=[1,-2,3],spin=[3,6,-6]}]"}))
          .simulation);
  ASSERT_TRUE(subcycle(sim, 1.7, 0.9));
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
