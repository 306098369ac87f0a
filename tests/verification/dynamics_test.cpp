// The undamped beam under a suddenly applied load: energy, its order in the time step, and the period.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "verification/support.hpp"

namespace geist::verification {
namespace {

/// Ten periods of the beam's first vibration, 1.238 ms by theory: (2π/1.8751²) √(ρA L⁴/EI).
constexpr double ten_periods = 12.4;

std::vector<std::string> dynamic(double duration, std::vector<std::string> more = {}) {
  more.push_back(fmt::format("analysis={{type=\"dynamic\",duration={}}}", duration));
  return more;
}

/// Follows the ledger and the tip.
class Watch : public Observer {
 public:
  explicit Watch(const Probe& tip) : tip_(tip) {}
  void progress(const Simulation& sim, const Observation& now) override {
    worst_balance = std::max(worst_balance, std::abs(now.ledger.balance()));
    peak_strain = std::max(peak_strain, now.ledger.internal());
    ++ledgers;
    times.push_back(sim.model.time), deflections.push_back(-tip_.value(sim));
  }
  double worst_balance = 0, peak_strain = 0;
  int ledgers = 0;
  std::vector<double> times, deflections;

 private:
  const Probe& tip_;
};

TEST(DynamicBeam, BalanceOverTenPeriods) {
  const Case input = published("beam", dynamic(ten_periods));
  Built built = build(input);
  Watch watch(built.probes[0]);
  ASSERT_EQ(run_to_end(input, built, {&watch}).status, Status::completed);
  EXPECT_GT(watch.ledgers, 500);  // every hundredth of some 80,000 steps
  // Twice the static deflection, and twice the work of the load at rest: ½ F · 2 u · 2.
  EXPECT_NEAR(watch.peak_strain / (2 * 2.048), 1, 0.1);
  EXPECT_LT(watch.worst_balance, 1e-3 * watch.peak_strain);
  RecordProperty("balance", fmt::format("{:.3g}", watch.worst_balance / watch.peak_strain));
  RecordProperty("steps", fmt::format("{}", built.simulation.model.step));
}

/// Largest error of the balance until t = 0.2 ms, sampled at the same 200 instants, for a time step.
double worst_balance(double dt) {
  const Case input = published("beam", dynamic(0.2, {}));
  Built built = build(input);
  built.simulation.dt = dt;
  Watch watch(built.probes[0]);
  RunPlan plan = plan_of(input);
  plan.check_every = std::lround(0.001 / dt);
  run(built.simulation, plan, {&watch});
  return watch.worst_balance;
}

/// Central differences keep ½ v^{n−½}·M v^{n+½} + ½ u·K u exactly; the ledger's ½ v^n·M v^n differs from that
/// by ⅛ Δt² a·M a, a being the acceleration. So the error falls with Δt², to a quarter for half the step, as
/// long as a·M a does not depend on Δt: it does only where fast vibrations are computed too fast, by (ω
/// Δt)²/24, which is 9 % for the fastest of all at the coarsest step (three quarters of the limit) and a
/// quarter of that at half of it. The bands of 15 % and 7.5 % leave as much again for instants that miss the
/// peaks.
TEST(DynamicBeam, BalanceFallsWithTheSquareOfTheTimeStep) {
  const double coarse = worst_balance(0.001 / 8), half = worst_balance(0.001 / 16),
               quarter = worst_balance(0.001 / 32);
  EXPECT_NEAR(coarse / half, 4, 0.6) << coarse;
  EXPECT_NEAR(half / quarter, 4, 0.3) << half;
  RecordProperty("ratios", fmt::format("{:.3f} {:.3f}", coarse / half, half / quarter));
}

/// The first period: the tip swings between nothing and twice its static deflection. It passes the middle of
/// its swing downwards, upwards and downwards again; from the first to the third is one period.
double first_period(const Case& input) {
  Built built = build(input);
  Watch watch(built.probes[0]);
  RunPlan plan = plan_of(input);
  plan.check_every = 20;
  run(built.simulation, plan, {&watch});
  const double middle = *std::max_element(watch.deflections.begin(), watch.deflections.end()) / 2;
  std::vector<double> down;
  for (std::size_t i = 1; i < watch.times.size(); ++i) {
    const double a = watch.deflections[i - 1] - middle, b = watch.deflections[i] - middle;
    const bool again = !down.empty() && watch.times[i] < down.back() + 0.5;  // a ripple on the same pass
    if (a < 0 && b >= 0 && !again)
      down.push_back(watch.times[i - 1] + (watch.times[i] - watch.times[i - 1]) * a / (a - b));
  }
  return down.at(1) - down.at(0);
}

const std::vector<std::string> all_hexahedra{hexahedra("middle", 7, 13, "[12,4,4]")};

TEST(DynamicBeam, FirstPeriodOfCoupledAndAllHexahedra) {
  const double coupled = first_period(published("beam", dynamic(1.9))),
               continuum = first_period(published("beam", dynamic(1.9, all_hexahedra)));
  EXPECT_NEAR(coupled / continuum, 1, 0.03);
  // Euler's beam, to what shear and rotary inertia (+1 %) and the mesh (−1 %) do.
  EXPECT_NEAR(continuum / 1.2381, 1, 0.03);
  RecordProperty("periods", fmt::format("{:.5f} {:.5f}", coupled, continuum));
}

/// The default method, with finite displacements; a swing of a fifth of the length makes it no slower.
TEST(DynamicBeam, FirstPeriodAsShipped) {
  const double coupled = first_period(example("beam", dynamic(1.9))),
               continuum = first_period(example("beam", dynamic(1.9, all_hexahedra)));
  EXPECT_NEAR(coupled / continuum, 1, 0.003);
  EXPECT_NEAR(continuum / 1.2381, 1, 0.03);
  RecordProperty("periods", fmt::format("{:.5f} {:.5f}", coupled, continuum));
}

/// A support that begins to move on a step that is checked: half of the work of its jump comes a step late.
TEST(EnergyBalance, SurvivesAJumpOfVelocity) {
  const Case input = read_case_text(R"(
method = "published"
units = { length = "mm", mass = "g", time = "ms" }
[materials.m]
density = 0.001
young = 1
poisson = 0.2
[regions.bar]
type = "hexahedra"
material = "m"
box = [[0, 0, 0], [8, 1, 1]]
divisions = [8, 1, 1]
[curves.late]
points = [[0, 0], [5, 0], [6, 1]]
[[supports]]
where = { x = 0 }
displacement = { x = 0.01 }
curve = "late"
[analysis]
type = "dynamic"
time_step = 0.005
duration = 5.5
)",
                                    "jump.toml");
  Built built = build(input);
  RunPlan plan = plan_of(input);
  plan.check_every = 100;  // t = 5 is step 1000
  const Outcome outcome = run(built.simulation, plan, {});
  EXPECT_EQ(outcome.status, Status::completed) << outcome.message;
}

}  // namespace
}  // namespace geist::verification
