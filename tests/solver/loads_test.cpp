#include "solver/loads.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/support.hpp"

namespace geist::testing {
namespace {

/// A model of one node to push.
Model one_node() {
  Model model;
  model.mesh.points = {{0, 0, 0}};
  finish(model.mesh);
  model.mesh.mass = {3};
  return model;
}

TEST(Loads, AddUpByTheirCurves) {
  Model model = one_node();
  Load steady, ramp;
  steady.nodes = {{0, {1, 2, 3}}};
  ramp.nodes = {{0, {10, 0, 0}}}, ramp.curve.points = {{0, 0}, {1, 1}};
  add_loads({steady, ramp}, model, 0.25);
  EXPECT_EQ(model.mesh.f.vector(0), (Vec3{3.5, 2, 3}));
}

TEST(Loads, GravityIsAnAccelerationAndCountsInTheNorm) {
  Model model = one_node();
  Load g;
  g.is_gravity = true, g.gravity = {0, 0, -10}, g.curve.points = {{0, 0}, {1, 1}};
  EXPECT_EQ(gravity({g}, 0.5), (Vec3{0, 0, -5}));
  EXPECT_DOUBLE_EQ(norm({g}, model, 0.5), 15);
  add_loads({g}, model, 0.5);
  EXPECT_EQ(model.mesh.f.vector(0), Vec3{});
}

/// W = Σ ½ (c + c') F·(u' − u), written out.
TEST(Loads, WorkIsByTheTrapezoidalRule) {
  Model model = one_node();
  Load load;
  load.nodes = {{0, {2, 0, 0}}}, load.curve.points = {{0, 0}, {2, 1}};
  std::vector<Load> loads{load};
  for (const auto& [t, x] : {std::pair{0.5, 0.1}, {1.0, 0.3}, {2.0, 0.2}}) {
    model.time = t, model.mesh.u.set(0, {x, 5, 5});
    settle(loads, model, t);
  }
  const double expected = 2 * (0.5 * 0.25 * 0.1 + 0.5 * 0.75 * 0.2 + 0.5 * 1.5 * -0.1);
  EXPECT_NEAR(loads[0].work, expected, 1e-16);
}

TEST(Loads, SettlingWaitsOnlyWhereTheCurveIsConstant) {
  Model model = one_node();
  Load load;
  load.nodes = {{0, {2, 0, 0}}}, load.curve.points = {{1, 1}, {2, 3}};
  std::vector<Load> loads{load};
  model.time = 0.5, model.mesh.u.set(0, {1, 0, 0});
  settle(loads, model, 0.9);
  EXPECT_EQ(loads[0].work, 0) << "may wait";
  settle(loads, model, 1.1);
  EXPECT_EQ(loads[0].work, 2) << "may not: the curve changes before 1.1";
}

/// Particles and nodes, gravity; constant, ramped and constant again. Sums in another order: rounding only.
constexpr const char* pushed = R"(
[curves.push]
points = [[0.1, 0.3], [0.2, 1], [0.3, 1], [0.35, 0.3], [0.6, 0.3]]
[[loads]]
where = { z = 4 }
total_force = [1, 0, -2]
curve = "push"
[[loads]]
where = { x = 1 }
traction = [0.1, 0.2, 0.3]
[[loads]]
gravity = [0, 0.1, -1]
curve = "push"
)";

TEST(Loads, DeferredWorkEqualsWorkSettledAtEveryStep) {
  const std::string text = coupled_column(standing + std::string(pushed) + dynamic(0.5));
  Simulation often = std::move(build_text(text).simulation), once = std::move(build_text(text).simulation);
  often.start(), once.start();
  const long steps = std::lround(0.5 / often.dt);
  double largest = 0;
  for (long n = 1; n <= steps; ++n) {
    often.step(true), once.step(n == steps);
    largest = std::max(largest, std::abs(often.ledger().external));
  }
  EXPECT_GT(largest, 1e-4);
  EXPECT_NEAR(often.ledger().external, once.ledger().external, 1e-12 * largest);
  EXPECT_LT(std::abs(once.ledger().balance()), 2e-2 * largest);
}

/// A body that starts displaced: work counts from where it starts.
TEST(Loads, WorkCountsFromTheStart) {
  Simulation sim = std::move(build_text(column(standing + std::string(pushed) + dynamic(1))).simulation);
  for (std::size_t i = 0; i < sim.model.mesh.nodes(); ++i) sim.model.mesh.u.set(i, {0.1, 0.1, 0.1});
  sim.start();
  EXPECT_EQ(sim.ledger().external, 0);
  EXPECT_EQ(sim.ledger().balance(), 0);
}

}  // namespace
}  // namespace geist::testing
