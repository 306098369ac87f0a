// Sliding, sticking and rolling down an incline: gravity is tilted, the ground is level. It grows within half
// a millisecond, many periods of the contact's own vibration, so that nothing bounces; from then on a body
// has been accelerated for as long as the integral of that curve, 0.25 ms less than the time.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "verification/contact_support.hpp"

namespace geist::verification {
namespace {

constexpr double g = 10, ramp = 0.5, duration = 2.5, young = 1000, poisson = 0.2;

/// Modulus of a layer that cannot widen, λ + 2μ, of the only material; Mindlin's k_t/k_n for two of it.
constexpr double layer = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
constexpr double kappa = 2 * (1 - poisson) / (2 - poisson);

const std::string ground = R"(units = { length = "mm", mass = "g", time = "ms" }
[materials.m]
density = 0.001
young = 1000
poisson = 0.2
[regions.ground]
type = "hexahedra"
material = "m"
box = [[0, 0, -1], [24, 4, 0]]
divisions = [24, 4, 1]
[[supports]]
where = { region = "ground" }
fix = ["x", "y", "z"]
[coupling]
type = "none"
[curves.grow]
points = [[0, 0], [0.5, 1]]
[probes.way]
where = { region = "body" }
quantity = "displacement"
component = "x"
)";

/// The ground at an angle, and how the body rests on it. tan: of the angle.
std::string incline(double tan, double friction, const std::string& law) {
  const double cos = 1 / std::sqrt(1 + tan * tan);
  return ground + fmt::format(
                      "[[loads]]\ngravity = [{}, 0, {}]\ncurve = \"grow\"\n[[contact]]\nbetween = [\"body\", "
                      "\"ground\"]\nfriction = {}\nrestitution = 0.3\nlaw = \"{}\"\n[analysis]\ntype = "
                      "\"dynamic\"\nduration = {}\n",
                      g * tan * cos, -g * cos, friction, law, duration);
}

const std::string ball = R"([regions.body]
type = "lattice"
material = "m"
box = [[1, 1, 0], [3, 3, 2]]
radius = 1
)";
const std::string no_rotation = R"([[supports]]
where = { region = "body" }
fix = ["rx", "ry", "rz"]
)";

/// Stiffness of the ball on the ground by either law, k δ or k δ^{3/2}.
constexpr double mass = 0.008, k_penalty = 2 * 1 * layer,
                 k_hertz = 4.0 / 3 * young / (2 * (1 - poisson * poisson));
double depth(bool hertz, double weight) {
  return hertz ? std::pow(weight / k_hertz, 2.0 / 3) : weight / k_penalty;
}

class BallOnIncline : public ::testing::TestWithParam<const char*> {
 protected:
  static bool by_hertz() { return GetParam() == std::string("hertz"); }
};
INSTANTIATE_TEST_SUITE_P(Laws, BallOnIncline, ::testing::Values("penalty", "hertz"),
                         [](const auto& law) { return std::string(law.param); });

/// It moves as far as the tangential spring gives: f/k_t, or, by Hertz' law, whose stiffness has grown with
/// the force, half as much again: s = ∫ df/k_t with k_t ∝ f^{1/3}.
TEST_P(BallOnIncline, SticksIfItCannotRoll) {
  const bool hertz = by_hertz();
  const double tan = 0.3, cos = 1 / std::sqrt(1 + tan * tan), weight = mass * g * cos;
  const Recording r = run_text(incline(tan, 0.5, GetParam()) + ball + no_rotation);
  const double k_t = kappa * (hertz ? 1.5 * k_hertz * std::sqrt(depth(hertz, weight)) : k_penalty);
  const double expected = (hertz ? 1.5 : 1) * tan * weight / k_t;
  // What is left of vibration: half of it is that of the force while gravity grows, at most.
  EXPECT_NEAR(r.of("way").back() / expected, 1, 0.05);
  EXPECT_LT(peak(r.of("way")), 1.1 * expected);
  EXPECT_LT(r.ledger.back().friction, 0.1 * tan * weight * expected);  // of the springs; it never slid
  RecordProperty("way", fmt::format("{:.5g} of {:.5g} mm", r.of("way").back(), expected));
}

/// Below tan θ = 7/2 μ. The ball sinks in by δ and rolls on R − δ. The spring takes up f/k_t, 10⁻⁵ mm of 8
/// mm, and the vibration that it makes.
TEST_P(BallOnIncline, RollsWithoutSlip) {
  const double tan = 0.6, cos = 1 / std::sqrt(1 + tan * tan);
  const Recording r = run_text(incline(tan, 0.25, GetParam()) + ball);
  const Particle p = only_particle(r.model());
  const double lever = 1 - depth(by_hertz(), mass * g * cos);
  const double expected = g * tan * cos / (1 + 0.4 / (lever * lever)) * (r.model().time - ramp / 2);
  EXPECT_NEAR(p.v.x / expected, 1, 1e-3);
  EXPECT_NEAR(p.spin.y * lever / p.v.x, 1, 1e-3);
  EXPECT_LT(std::abs(r.ledger.back().friction), 2e-3 * r.ledger.back().kinetic());
  EXPECT_LT(r.worst_balance(), 1e-4);
  RecordProperty("speed", fmt::format("{:.6g} of {:.6g} mm/ms", p.v.x, expected));
}

/// Above it: friction is μ N whatever the ball does.
TEST_P(BallOnIncline, SlidesAndTurns) {
  const double tan = 0.6, mu = 0.1, cos = 1 / std::sqrt(1 + tan * tan);
  const Recording r = run_text(incline(tan, mu, GetParam()) + ball);
  const Particle p = only_particle(r.model());
  const double time = r.model().time - ramp / 2, lever = 1 - depth(by_hertz(), mass * g * cos);
  EXPECT_NEAR(p.v.x / (g * cos * (tan - mu) * time), 1, 1e-3);
  EXPECT_NEAR(p.spin.y / (2.5 * mu * g * cos * time * lever), 1, 1e-3);
  // Friction's work: μ N times what the point of contact has slid, ½ (v − ω R) t and what it slid in the
  // ramp.
  EXPECT_NEAR(r.ledger.back().friction / (mu * mass * g * cos * (p.v.x - p.spin.y) * time / 2), 1, 5e-3);
  EXPECT_LT(r.worst_balance(), 1e-4);
  RecordProperty("speed", fmt::format("{:.6g} of {:.6g} mm/ms, spin {:.6g} of {:.6g} /ms", p.v.x,
                                      g * cos * (tan - mu) * time, p.spin.y, 2.5 * mu * g * cos * time));
}

const std::string block = R"([regions.body]
type = "hexahedra"
material = "m"
box = [[1.3, 1.2, 0], [3.3, 3.2, 2]]
divisions = [4, 4, 4]
)";

/// The block is 2 mm high; its nodes go over the ground's from facet to facet. Momentum along the incline is
/// what gravity and friction make of it.
TEST(BlockOnIncline, Slides) {
  const double tan = 0.6, mu = 0.3, cos = 1 / std::sqrt(1 + tan * tan);
  const Recording r = run_text(incline(tan, mu, "penalty") + block);
  const Ledger& last = r.ledger.back();
  const double expected = g * cos * (tan - mu) * (r.model().time - ramp / 2);
  EXPECT_NEAR(last.linear.x / mass / expected, 1, 0.01);
  EXPECT_LT(std::abs(last.linear.y), 1e-3 * last.linear.x);
  EXPECT_GT(r.of("way").back(), 4);
  EXPECT_NEAR(last.friction / (mu * mass * g * cos * r.of("way").back()), 1, 0.02);
  EXPECT_LT(r.worst_balance(), 1e-3);
  EXPECT_TRUE(r.warnings.empty());
  RecordProperty("speed", fmt::format("{:.6g} of {:.6g} mm/ms", last.linear.x / mass, expected));
  RecordProperty("balance", fmt::format("{:.2g}", r.worst_balance()));
}

/// The block leans on its springs and shears: f h/(2 G A) is 3e-5 mm in the mean, and the springs give as
/// much. It does not go on.
TEST(BlockOnIncline, Sticks) {
  const double tan = 0.2, cos = 1 / std::sqrt(1 + tan * tan), force = mass * g * tan * cos;
  const Recording r = run_text(incline(tan, 0.3, "penalty") + block);
  const double shear = force * 2 / (2 * (young / 2.4) * 4);
  const std::vector<double>& way = r.of("way");
  EXPECT_LT(way.back(), 5 * shear);
  EXPECT_LT(std::abs(way.back() - way[way.size() / 2]), shear);
  RecordProperty("way", fmt::format("{:.3g} mm, in the second half {:.3g} mm", way.back(),
                                    way.back() - way[way.size() / 2]));
}

}  // namespace
}  // namespace geist::verification
