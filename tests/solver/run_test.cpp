#include "solver/run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "solver/support.hpp"
#include "solver/time_step.hpp"

namespace geist::testing {
namespace {

constexpr const char* moving = "[[initial]]\nvelocity = [0.1, 0, 1]\n";

/// Notes the steps at which it is called.
class Notes : public Observer {
 public:
  void history(const Simulation& sim, const Observation&) override { rows.push_back(sim.model.step); }
  void fields(const Simulation& sim, const Observation&) override { pictures.push_back(sim.model.step); }
  void progress(const Simulation& sim, const Observation&) override {
    ledgers.push_back(sim.model.step);
    if (on_progress) on_progress(sim.model.step);
  }
  std::vector<long> rows, pictures, ledgers;
  std::function<void(long)> on_progress;
};

/// Rows at the first step at or after each multiple; the end once, whether it is a multiple or not.
TEST(Run, RowsAreDueAtTheFirstStepAtOrAfterEachMultiple) {
  Built built = build_text(column(standing + std::string(moving) + dynamic(1)));
  const double dt = built.simulation.dt;
  RunPlan plan = dynamic_plan(10.5 * dt);
  plan.history_every = 2.5 * dt, plan.fields_every = 4 * dt, plan.check_every = 6;
  Notes notes;
  EXPECT_EQ(run(built.simulation, plan, {&notes}).status, Status::completed);
  EXPECT_EQ(notes.rows, (std::vector<long>{0, 3, 5, 8, 10, 11}));
  EXPECT_EQ(notes.pictures, (std::vector<long>{0, 4, 8, 11}));
  EXPECT_EQ(notes.ledgers, (std::vector<long>{0, 3, 4, 5, 6, 8, 10, 11}));
}

TEST(Run, RowsAreNotDueOftenerThanEvery20StepsUnlessAskedFor) {
  Built built = build_text(column(standing + std::string(moving) + dynamic(1)));
  RunPlan plan = dynamic_plan(50 * built.simulation.dt);
  Notes notes;
  run(built.simulation, plan, {&notes});
  EXPECT_EQ(notes.rows, (std::vector<long>{0, 20, 40, 50}));
}

TEST(Run, PicturesAreDueAtGivenInstantsToo) {
  Built built = build_text(column(standing + std::string(moving) + dynamic(1)));
  const double dt = built.simulation.dt;
  RunPlan plan = dynamic_plan(10 * dt);
  plan.fields_at = {6.5 * dt, 3 * dt, 100 * dt};
  Notes notes;
  run(built.simulation, plan, {&notes});
  EXPECT_EQ(notes.pictures, (std::vector<long>{0, 3, 7, 10}));
  plan.fields_every = 4 * dt;
  Built again = build_text(column(standing + std::string(moving) + dynamic(1)));
  Notes both;
  run(again.simulation, plan, {&both});
  EXPECT_EQ(both.pictures, (std::vector<long>{0, 3, 4, 7, 8, 10}));
}

TEST(Run, TheEndIsReportedOnce) {
  Built built = build_text(column(standing + std::string(moving) + dynamic(1)));
  RunPlan plan = dynamic_plan(10 * built.simulation.dt);
  plan.history_every = 5 * built.simulation.dt;
  Notes notes;
  run(built.simulation, plan, {&notes});
  EXPECT_EQ(notes.rows, (std::vector<long>{0, 5, 10}));
  EXPECT_EQ(notes.pictures, (std::vector<long>{0, 10}));
}

TEST(Run, AnIntervalBelowTheStepMeansEveryStep) {
  Built built = build_text(column(standing + std::string(moving) + dynamic(1)));
  RunPlan plan = dynamic_plan(4 * built.simulation.dt);
  plan.history_every = 0.3 * built.simulation.dt;
  Notes notes;
  run(built.simulation, plan, {&notes});
  EXPECT_EQ(notes.rows, (std::vector<long>{0, 1, 2, 3, 4}));
}

TEST(Run, StopsAtMaxSteps) {
  Built built = build_text(column(standing + std::string(moving) + dynamic(1)));
  RunPlan plan = dynamic_plan(10);
  plan.max_steps = 17;
  Notes notes;
  const Outcome outcome = run(built.simulation, plan, {&notes});
  EXPECT_EQ(outcome.status, Status::not_converged);
  EXPECT_NE(outcome.message.find("max_steps = 17"), std::string::npos) << outcome.message;
  EXPECT_EQ(notes.rows.back(), 17);
}

/// A flag that is set while the run is observed, or was before it began.
TEST(Run, StopFlagEndsTheRunWithEverythingObserved) {
  for (const long when : {0L, 200L}) {
    Built built = build_text(column(standing + std::string(moving) + dynamic(100)));
    volatile std::sig_atomic_t stop = 0;
    RunPlan plan = dynamic_plan(100);
    plan.stop = &stop;
    Notes notes;
    notes.on_progress = [&](long step) { stop = step >= when; };
    const Outcome outcome = run(built.simulation, plan, {&notes});
    EXPECT_EQ(outcome.status, Status::interrupted);
    EXPECT_EQ(built.simulation.model.step, when);
    EXPECT_EQ(notes.rows.back(), when);
    EXPECT_EQ(notes.pictures.back(), when);
    EXPECT_EQ(notes.ledgers.back(), when);
    EXPECT_NE(outcome.message.find(fmt::format("at step {}", when)), std::string::npos) << outcome.message;
  }
}

/// Beyond the limit the energy runs away; the first check sees it, and a second look stops the run.
TEST(Run, RunawayEnergyStopsTheRun) {
  Built built = build_text(coupled_column(standing + std::string(moving) + dynamic(1)));
  built.simulation.dt = 1.5 * critical(built.bounds).bound;
  Notes notes;
  const Outcome outcome = run(built.simulation, dynamic_plan(1000), {&notes});
  EXPECT_EQ(outcome.status, Status::failed);
  EXPECT_EQ(built.simulation.model.step, 101);
  EXPECT_NE(outcome.message.find("time step may be too long"), std::string::npos) << outcome.message;
  EXPECT_NE(outcome.message.find("moves fastest is region '"), std::string::npos) << outcome.message;
  EXPECT_EQ(notes.rows.back(), 101);
  EXPECT_EQ(notes.pictures.back(), 101);
}

TEST(Run, NaNIsFoundAtOnceAndNamed) {
  for (const bool particle : {false, true}) {
    Built built = build_text(coupled_column(standing + std::string(moving) + dynamic(1)));
    Model& model = built.simulation.model;
    Notes notes;
    notes.on_progress = [&](long step) {
      if (step != 100) return;
      const double nan = std::numeric_limits<double>::quiet_NaN();
      if (particle)
        model.lattices[0].motion[4][model.lattices[0].grid.index(1, 2, 5)] = nan;
      else
        model.mesh.u[1][7] = nan;
    };
    const Outcome outcome = run(built.simulation, dynamic_plan(10), {&notes});
    EXPECT_EQ(outcome.status, Status::failed);
    EXPECT_EQ(model.step, 101);
    EXPECT_NE(outcome.message.find("step 101"), std::string::npos) << outcome.message;
    EXPECT_NE(outcome.message.find("is not a number"), std::string::npos) << outcome.message;
    EXPECT_EQ(notes.rows.back(), 101);
  }
}

TEST(Run, FirstThatIsNotFiniteHasRegionAndPlace) {
  Built built = build_text(coupled_column(standing + std::string(moving) + dynamic(1)));
  Model& model = built.simulation.model;
  EXPECT_EQ(first_not_finite(model), "");
  Lattice& lattice = model.lattices[0];
  const std::size_t s = lattice.grid.index(1, 2, 5);
  lattice.velocity[5][s] = std::numeric_limits<double>::infinity();
  const Vec3 p = lattice.grid.centre(s);
  EXPECT_EQ(first_not_finite(model),
            fmt::format("region 'head', site (1, 2, 5) at ({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z));
  model.mesh.u[2][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(first_not_finite(model), "region 'foot', element 0, node 0 at (0, 0, 0)");
}

TEST(TimeStep, IsRoundedDownToFiveDigits) {
  EXPECT_DOUBLE_EQ(rounded_down(0.000152736), 0.00015273);
  EXPECT_DOUBLE_EQ(rounded_down(12345.99), 12345);
  EXPECT_DOUBLE_EQ(rounded_down(1.00009), 1.0);
  for (double x = 1e-9; x < 1e9; x *= 1.37) {
    EXPECT_LE(rounded_down(x), x);
    EXPECT_GT(rounded_down(x), x * (1 - 1.0001e-4));
  }
}

TEST(TimeStep, TheSmallestBoundDecides) {
  const std::vector<TimeStepBound> bounds{{"a", 3, ""}, {"b", 2, ""}, {"c", 5, ""}};
  EXPECT_EQ(critical(bounds).region, "b");
}

}  // namespace
}  // namespace geist::testing
