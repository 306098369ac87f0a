// Static analysis and static start on columns whose solutions are known.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/support.hpp"

namespace geist::testing {
namespace {

RunPlan static_plan(double tolerance = 1e-10) {
  RunPlan plan;
  plan.is_static = true, plan.tolerance = tolerance;
  return plan;
}

constexpr const char* pull = "[[loads]]\nwhere = { z = 4 }\ntotal_force = [0, 0, 3]\n";
constexpr const char* statics = "[analysis]\ntype = \"static\"\n";
constexpr double stretch = 3 * length / (young * area);

Built column_with(const std::string& rest) { return build_text(column(standing + rest + tip_probe)); }
Built coupled_with(const std::string& rest) {
  return build_text(coupled_column(standing + rest + tip_probe));
}

double tip(const Built& built) { return built.probes[0].value(built.simulation); }

Vec3 reactions(const Simulation& sim) {
  Vec3 total;
  for (const HeldComponent& h : sim.supports.held)
    if (h.component < 3) total[h.component] += h.reaction;
  return total;
}

TEST(Equilibrium, OfAPulledColumn) {
  Built built = column_with(std::string(pull) + statics);
  const Outcome outcome = run(built.simulation, static_plan(), {});
  ASSERT_EQ(outcome.status, Status::completed) << outcome.message;
  EXPECT_NEAR(tip(built), stretch, 1e-8 * stretch);
  const Vec3 R = reactions(built.simulation);
  EXPECT_NEAR(R.x, 0, 1e-8);
  EXPECT_NEAR(R.y, 0, 1e-8);
  EXPECT_NEAR(R.z, -3, 1e-8);
  EXPECT_NEAR(outcome.last.ledger.external, 0.5 * 3 * stretch, 1e-8 * stretch);
  EXPECT_NEAR(outcome.last.ledger.balance(), 0, 1e-10);
  EXPECT_EQ(outcome.last.ledger.kinetic(), 0);
}

TEST(Equilibrium, UnderItsOwnWeightHasItsReactions) {
  Built built = coupled_with(std::string("[[loads]]\ngravity = [0, 0, -10]\n") + statics);
  const Outcome outcome = run(built.simulation, static_plan(), {});
  ASSERT_EQ(outcome.status, Status::completed) << outcome.message;
  EXPECT_NEAR(reactions(built.simulation).z, 10 * density * area * length, 1e-7);
  EXPECT_LE(outcome.last.residual, 1e-10);
}

constexpr const char* ramp = "[curves.ramp]\npoints = [[0, 0], [2, 1], [3, 0.5]]\n";

TEST(Equilibrium, FollowsAPrescribedDisplacementToTheEndOfItsCurve) {
  Built built = coupled_with(std::string("[[supports]]\nwhere = { z = 4 }\nfix = [\"x\", \"y\"]\n"
                                         "displacement = { z = 0.2 }\ncurve = \"ramp\"\n") +
                             ramp + statics);
  const Outcome outcome = run(built.simulation, static_plan(), {});
  ASSERT_EQ(outcome.status, Status::completed) << outcome.message;
  EXPECT_EQ(built.simulation.model.time, 3);
  EXPECT_DOUBLE_EQ(tip(built), 0.1);
  const Vec3 R = reactions(built.simulation);
  EXPECT_NEAR(R.x, 0, 1e-8);
  EXPECT_NEAR(R.y, 0, 1e-8);
  EXPECT_NEAR(R.z, 0, 1e-8);
  EXPECT_GT(outcome.last.ledger.external, 0);
  EXPECT_NEAR(outcome.last.ledger.balance(), 0, 1e-9 * outcome.last.ledger.external);
}

TEST(Equilibrium, TakesLoadsAtTheEndOfTheirCurves) {
  Built built = column_with("[[loads]]\nwhere = { z = 4 }\ntotal_force = [0, 0, 3]\ncurve = \"ramp\"\n" +
                            std::string(ramp) + statics);
  ASSERT_EQ(run(built.simulation, static_plan(), {}).status, Status::completed);
  EXPECT_NEAR(tip(built), 0.5 * stretch, 1e-8 * stretch);
}

TEST(Equilibrium, WithoutLoadNothingMoves) {
  Built built =
      coupled_with(std::string("[[loads]]\nwhere = { z = 4 }\ntotal_force = [0, 0, 0]\n") + statics);
  const Outcome outcome = run(built.simulation, static_plan(), {});
  EXPECT_EQ(outcome.status, Status::completed) << outcome.message;
  EXPECT_EQ(outcome.equilibrium->iterations, 0);
  EXPECT_EQ(tip(built), 0);
}

TEST(Equilibrium, NeedsEveryBodyHeld) {
  Built built = build_text(
      column(std::string("[[supports]]\nwhere = { z = 0 }\nfix = [\"x\", \"z\"]\n") + pull + statics));
  const Outcome outcome = run(built.simulation, static_plan(), {});
  EXPECT_EQ(outcome.status, Status::failed);
  EXPECT_NE(
      outcome.message.find("region 'column' is free to move: the supports hold 5 of the 6 rigid motions"),
      std::string::npos)
      << outcome.message;
}

TEST(Equilibrium, NamesTheLatticeThatNothingHolds) {
  Built built =
      build_text(coupled_column(std::string("[coupling]\ntype = \"none\"\n") + standing + pull + statics));
  const Outcome outcome = run(built.simulation, static_plan(), {});
  EXPECT_EQ(outcome.status, Status::failed);
  EXPECT_NE(outcome.message.find("region 'head' is free to move: the supports hold 0 of"), std::string::npos)
      << outcome.message;
}

/// Two cubes that share an edge: held as a whole, and yet one of them turns freely about it.
TEST(Equilibrium, SaysThatAHingeResistsNothing) {
  std::string text =
      column(standing + std::string("[[loads]]\nwhere = { z = 4 }\ntotal_force = [1, 0, 3]\n") + statics);
  const std::string box = "box = [[0, 0, 0], [1, 1, 4]]\ndivisions = [1, 1, 8]";
  text.replace(text.find(box), box.size(),
               "box = [[0, 0, 0], [2, 1, 4]]\ndivisions = [4, 2, 8]\n"
               "minus = [{ box = [[1, 0, 0], [2, 1, 2]] }, { box = [[0, 0, 2], [1, 1, 4]] }]");
  Built built = build_text(text);
  const Outcome outcome = run(built.simulation, static_plan(), {});
  EXPECT_NE(outcome.status, Status::completed);
  EXPECT_NE(outcome.message.find("no equilibrium"), std::string::npos) << outcome.message;
}

TEST(Equilibrium, GivesUpAfterItsIterations) {
  Built built = coupled_with(std::string(pull) + statics);
  RunPlan plan = static_plan();
  plan.max_iterations = 2;
  const Outcome outcome = run(built.simulation, plan, {});
  EXPECT_EQ(outcome.status, Status::not_converged);
  EXPECT_EQ(outcome.equilibrium->iterations, 2);
}

TEST(Equilibrium, StopsBySignal) {
  Built built = coupled_with(std::string(pull) + statics);
  RunPlan plan = static_plan();
  const volatile std::sig_atomic_t stop = 1;
  plan.stop = &stop;
  const Outcome outcome = run(built.simulation, plan, {});
  EXPECT_EQ(outcome.status, Status::interrupted);
  EXPECT_EQ(outcome.message, "stopped by a signal after 0 iterations");
}

/// Largest and smallest deflection of the tip.
struct Swing : Observer {
  const Probe* probe = nullptr;
  double low = 1e9, high = -1e9;
  void history(const Simulation& sim, const Observation&) override {
    low = std::min(low, probe->value(sim)), high = std::max(high, probe->value(sim));
  }
};

Swing swing_after_static_start(const std::string& curve, Outcome& outcome) {
  Built built = coupled_with(
      "[[loads]]\nwhere = { z = 4 }\ntotal_force = [0, 0, 3]\ncurve = \"c\"\n[curves.c]\npoints = " + curve +
      "\n[analysis]\ntype = \"dynamic\"\nduration = 8\nstart = \"static\"\n");
  RunPlan plan = dynamic_plan(8);
  plan.static_start = true, plan.history_every = 0.008;
  Swing swing;
  swing.probe = &built.probes[0];
  outcome = run(built.simulation, plan, {&swing});
  return swing;
}

TEST(StaticStart, StaysAtRestUnderTheSameLoad) {
  Outcome outcome;
  const Swing swing = swing_after_static_start("[[0, 1], [1, 1]]", outcome);
  ASSERT_EQ(outcome.status, Status::completed) << outcome.message;
  EXPECT_NEAR(swing.high, stretch, 0.11 * stretch);  // the particles' part is softer
  EXPECT_LT(swing.high - swing.low, 1e-7 * stretch);
  EXPECT_LT(outcome.last.ledger.kinetic(), 1e-14 * outcome.last.ledger.internal());
}

/// A bar that is let go swings between the stretch and its opposite: d'Alembert's waves keep their shape but
/// for dispersion.
TEST(StaticStart, SwingsByTheStaticDeflectionWhenTheLoadIsTakenAway) {
  Outcome outcome;
  const Swing swing = swing_after_static_start("[[0, 1], [1e-6, 0]]", outcome);
  ASSERT_EQ(outcome.status, Status::completed) << outcome.message;
  EXPECT_NEAR(swing.low, -swing.high, 0.06 * swing.high);
}

TEST(StaticStart, KeepsInitialVelocities) {
  const std::string rest = std::string(pull) +
                           "[[initial]]\nvelocity = [0, 0, 0.5]\n[analysis]\ntype = \"dynamic\"\n"
                           "duration = 1\nstart = \"static\"\n";
  Built built = coupled_with(rest);
  const double particle = built.simulation.model.lattices[0].count(site::particle);
  RunPlan plan = dynamic_plan(1e-9);
  plan.static_start = true, plan.max_steps = 1;
  struct First : Observer {
    double kinetic = -1;
    void history(const Simulation&, const Observation& now) override {
      if (kinetic < 0) kinetic = now.ledger.kinetic();
    }
  } first;
  run(built.simulation, plan, {&first});
  EXPECT_GT(particle, 0);
  EXPECT_NEAR(first.kinetic, 0.5 * density * area * length * 0.25,
              0.1 * density);  // less the held nodes' share
}

}  // namespace
}  // namespace geist::testing
