// Gravity, damping and hourglass control in whole simulations.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/support.hpp"

namespace geist::testing {
namespace {

constexpr double g = 0.3, weight = density * g * area * length;

constexpr const char* heavy = R"(
[[loads]]
gravity = [0, 0, -0.3]
)";
constexpr const char* foot_probe =
    "[probes.foot]\nwhere = { z = 0 }\nquantity = \"reaction\"\ncomponent = \"z\"\n";

/// u(L) = −ρ g L²/2E: lumped linear elements are exact at their nodes. The support bears the whole weight,
/// that of its own nodes too; half of the work of gravity is strain, half was damped.
TEST(Gravity, ColumnUnderItsOwnWeight) {
  Built built = build_text(column(std::string(tip_probe) + foot_probe + standing + heavy + quasi_static()));
  const Outcome outcome = run(built.simulation, quasi_static_plan(), {});
  ASSERT_EQ(outcome.status, Status::completed);
  const double deflection = density * g * length * length / (2 * young);
  EXPECT_NEAR(built.probes[0].value(built.simulation), -deflection, 1e-6 * deflection);
  EXPECT_NEAR(built.probes[1].value(built.simulation), weight, 1e-6 * weight);
  const Ledger& l = outcome.last.ledger;
  EXPECT_NEAR(l.internal() / l.external, 0.5, 1e-6);
  EXPECT_NEAR(l.damping / l.external, 0.5, 1e-2);
}

TEST(Gravity, CoupledColumnIsBorneWhole) {
  Built built =
      build_text(coupled_column(std::string(tip_probe) + foot_probe + standing + heavy + quasi_static()));
  ASSERT_EQ(run(built.simulation, quasi_static_plan(), {}).status, Status::completed);
  EXPECT_NEAR(built.probes[1].value(built.simulation), weight, 1e-6 * weight);
}

/// A lift that moves everything at once under gravity: the support gives ½ m v² and raises the weight, and
/// gravity takes the latter.
TEST(Gravity, SupportThatLiftsDoesTheWork) {
  const std::string lift = "[[supports]]\nwhere = { z = [0, 4] }\nvelocity = { x = 0, y = 0, z = 2 }\n";
  Built built = build_text(column(lift + heavy + dynamic(0.5) + "time_step = 0.01\n"));
  const Outcome outcome = run(built.simulation, dynamic_plan(0.5), {});
  const double way = 2 * built.simulation.model.time, kinetic = 0.5 * weight / g * 4;
  EXPECT_NEAR(built.simulation.supports.work, kinetic + weight * way, 1e-9 * kinetic);
  EXPECT_NEAR(outcome.last.ledger.external, kinetic, 1e-9 * kinetic);
  EXPECT_NEAR(outcome.last.ledger.balance(), 0, 1e-9 * kinetic);
}

/// Free fall: v = g t to rounding, and v² is what gravity worked.
TEST(Gravity, FreeFall) {
  Built built = build_text(coupled_column(heavy + dynamic(1)));
  const Outcome outcome = run(built.simulation, dynamic_plan(1), {});
  const double t = built.simulation.model.time, mass = weight / g;
  EXPECT_NEAR(outcome.last.ledger.linear.z, -mass * g * t, 1e-10 * mass * g * t);
  EXPECT_NEAR(outcome.last.ledger.kinetic(), 0.5 * mass * g * g * t * t, 1e-10);
  EXPECT_NEAR(outcome.last.ledger.balance(), 0, 1e-10);
}

/// v = v₀ e^{−α t}; the scheme's factor (1 − β)/(1 + β), β = α Δt/2, is e^{−2β} to β³·2/3 in each step.
TEST(Damping, FreeFlightDecaysExponentially) {
  const double alpha = 1.5, duration = 1;
  Built built = build_text(coupled_column("[[initial]]\nvelocity = [1, -2, 3]\nspin = [1, 0, 0]\n" +
                                          dynamic(duration) + fmt::format("damping = {}\n", alpha)));
  const Outcome outcome = run(built.simulation, dynamic_plan(duration), {});
  const Ledger& l = outcome.last.ledger;
  const double dt = built.simulation.dt, beta = alpha * dt / 2, t = built.simulation.model.time;
  EXPECT_NEAR(l.kinetic() / l.initial, std::exp(-2 * alpha * t), 5 * beta * beta);
  EXPECT_GT(l.damping, 0.9 * l.initial);
  EXPECT_NEAR(l.balance() / l.initial, 0, 5 * beta * beta);
}

/// A vibrating column: all energy goes into damping, and the books close.
TEST(Damping, VibrationEndsInTheDampingsAccount) {
  Built built = build_text(
      column(standing + std::string("[[initial]]\nvelocity = [0.1, 0, 1]\n") + dynamic(8) + "damping = 2\n"));
  const Outcome outcome = run(built.simulation, dynamic_plan(8), {});
  const Ledger& l = outcome.last.ledger;
  EXPECT_LT(l.kinetic() + l.internal(), 1e-3 * l.initial);
  EXPECT_NEAR(l.damping / l.initial, 1, 1e-2);
}

/// Energy balance of a column that vibrates along its axis and in hourglass modes, relative to its initial
/// energy.
double hourglass_balance(double shorter) {
  Built built = build_text(
      column("hourglass = \"viscous\"\n[[initial]]\nvelocity = [0, 0, 1]\n" + dynamic(2), "one-point"));
  built.simulation.dt /= shorter;
  Mesh& mesh = built.simulation.model.mesh;
  for (std::size_t i = 0; i < mesh.nodes(); ++i) {
    const Vec3 X = mesh.points[i];
    const double hourglass = (X.x - 0.5) * (X.y - 0.5) > 0 ? 1.0 : -1.0;  // displacement ξη along ζ
    mesh.v.set(i, {0, 0, hourglass + X.z / length});
  }
  RunPlan plan = dynamic_plan(2);
  plan.balance_tolerance = 10;
  const Ledger l = run(built.simulation, plan, {}).last.ledger;
  EXPECT_GT(l.damping, 0.3 * l.initial);
  return l.balance() / l.initial;
}

/// Viscous hourglass control takes energy out of hourglass modes, and books it to the second order of the
/// step.
TEST(Damping, ViscousHourglassControlIsBooked) {
  const double coarse = hourglass_balance(2), fine = hourglass_balance(4);
  EXPECT_LT(std::abs(coarse), 1e-2);
  EXPECT_LT(std::abs(fine), 0.35 * std::abs(coarse));
  RecordProperty("balances", fmt::format("{:.4g} {:.4g}", coarse, fine));
}

}  // namespace
}  // namespace geist::testing
