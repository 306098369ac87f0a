#include "solver/supports.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/support.hpp"

namespace geist::testing {
namespace {

TEST(Motion, VelocityOverAStep) {
  const Curve ramp{{{0, 0}, {1, 1}, {2, 1}}};
  EXPECT_EQ((Motion{}.velocity(0.3, 0.1)), 0);
  const Motion displacement{Motion::Kind::displacement, 4, ramp}, velocity{Motion::Kind::velocity, 4, ramp};
  EXPECT_NEAR(displacement.velocity(0.3, 0.1), 4, 1e-12);
  EXPECT_NEAR(displacement.velocity(0.95, 0.1), 2, 1e-12) << "half of the step lies beyond the ramp";
  EXPECT_EQ(displacement.velocity(1.5, 0.1), 0);
  EXPECT_NEAR(velocity.velocity(0.3, 0.1), 4 * 0.35, 1e-12);
}

/// z = 4 is moved by 0.04 along a curve; z = 0 holds.
std::string pulled(const std::string& curve, const std::string& kind = "displacement") {
  return standing + fmt::format(R"(
[curves.pull]
points = {}
[[supports]]
where = {{ z = 4 }}
{} = {{ z = 0.04 }}
curve = "pull"
[probes.foot]
where = {{ z = 0 }}
quantity = "reaction"
component = "z"
[probes.head]
where = {{ z = 4 }}
quantity = "reaction"
component = "z"
)",
                                curve, kind);
}

constexpr double strain = 0.01, force = young * area * strain;

/// R = E A ε at both ends to what the residual of 1e-8 allows; the work of the ramp ends as strain and in
/// damping.
TEST(Supports, PulledBarReactsByHookesLaw) {
  Built built = build_text(column(pulled("[[0, 0], [1, 1]]") + quasi_static()));
  const Outcome outcome = run(built.simulation, quasi_static_plan(), {});
  ASSERT_EQ(outcome.status, Status::completed);
  EXPECT_GT(built.simulation.model.time, 1);
  EXPECT_NEAR(built.probes[0].value(built.simulation), -force, 1e-6 * force);
  EXPECT_NEAR(built.probes[1].value(built.simulation), force, 1e-6 * force);
  const Ledger& l = outcome.last.ledger;
  const double energy = 0.5 * force * strain * length;
  EXPECT_NEAR(l.internal(), energy, 1e-6 * energy);
  EXPECT_NEAR(l.external - l.damping, energy, 1e-3 * energy);  // the step's error, Δt²
}

/// Smoothly (½ − ½ cos) over some 40 periods of the bar: the work is ½ E A ε² L, what is left in vibration is
/// of the order of the polygon's kinks.
TEST(Supports, WorkOfASlowPullIsTheStrainEnergy) {
  const double duration = 40;
  std::string points = "[";
  for (int i = 0; i <= 200; ++i)
    points +=
        fmt::format("{}[{}, {}]", i ? ", " : "", duration * i / 200, 0.5 - 0.5 * std::cos(M_PI * i / 200));
  Built built = build_text(column(pulled(points + "]") + dynamic(duration)));
  const Outcome outcome = run(built.simulation, dynamic_plan(duration), {});
  ASSERT_EQ(outcome.status, Status::completed);
  const double energy = 0.5 * force * strain * length;
  EXPECT_NEAR(outcome.last.ledger.external, energy, 1e-3 * energy);
  EXPECT_LT(std::abs(outcome.last.ledger.balance()), 1e-5 * energy);
}

/// A support that moves at once gives its own nodes their velocity; the balance must know. What is left is
/// the step's error.
TEST(Supports, BalanceClosesWhenASupportStartsSuddenly) {
  for (const std::string kind : {"displacement", "velocity"}) {
    Built built = build_text(
        column(pulled(kind == "velocity" ? "[[0, 1], [1, 1]]" : "[[0, 0], [1, 1]]", kind) + dynamic(0.5)));
    const Outcome outcome = run(built.simulation, dynamic_plan(0.5), {});
    const Ledger& l = outcome.last.ledger;
    EXPECT_LT(std::abs(l.balance()), 1e-2 * (l.kinetic() + l.internal())) << kind;
  }
}

/// A held node that is given an initial velocity loses it at once, and no energy with it.
TEST(Supports, InitialVelocityOfHeldNodesDoesNotCount) {
  Built built =
      build_text(column(standing + std::string("[[initial]]\nvelocity = [0, 0, 1]\n") + dynamic(0.5)));
  built.simulation.dt /= 20;  // the velocity's jump is hard on the balance
  const Outcome outcome = run(built.simulation, dynamic_plan(0.5), {});
  const Ledger& l = outcome.last.ledger;
  EXPECT_NEAR(l.initial, 0.5 * density * area * (length - 0.25), 1e-12);
  EXPECT_LT(std::abs(l.balance()), 1e-3 * (l.kinetic() + l.internal()));
}

/// Particles are held and moved like nodes, rotations too: the reactions of both ends balance.
TEST(Supports, HoldParticles) {
  Built built = build_text(coupled_column(
      pulled("[[0, 0], [1, 1]]") +
      "[[supports]]\nwhere = { z = 4 }\nfix = [\"x\", \"y\", \"rx\", \"ry\", \"rz\"]\n" + quasi_static()));
  ASSERT_EQ(run(built.simulation, quasi_static_plan(), {}).status, Status::completed);
  const double foot = built.probes[0].value(built.simulation), head = built.probes[1].value(built.simulation);
  EXPECT_NEAR(foot / head, -1, 1e-6);
  EXPECT_NEAR(head / force, 0.9, 0.25);  // soft surfaces: somewhat below E A ε
  const Lattice& lattice = built.simulation.model.lattices[0];
  for (const HeldComponent& h : built.simulation.supports.held) {
    if (h.lattice != 0) continue;
    EXPECT_NEAR(lattice.motion[h.component][h.place], h.component == 2 ? 0.04 : 0, 1e-14);
  }
}

}  // namespace
}  // namespace geist::testing
