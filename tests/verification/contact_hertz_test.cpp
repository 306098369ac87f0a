// Hertz' impact of elastic bodies of hexahedra: two equal steel balls, and a ball on a block. Quarters of
// them, supported on their planes of symmetry.
//
// The closed form is 0.5 m v² = 0.4 k δ^{5/2}, k = 4/3 E* √R*, with m the mass of the meshed balls, which are
// a little lighter than round ones. It takes the bodies for half-spaces at rest. What that leaves out here:
//
// * a/R = 0.04 (balls) and 0.05 (ball on the block): the back of a ball is not far away. It makes the contact
//   stiffer by a share of this order, and F by 2/5, T by 1/5 and δ by 2/5 of that: 1 %.
// * Waves. T c_L is 30 R or more, so the balls cross many times and come to rest; the block radiates 1.04
//   (v/c_0)^{3/5} of the energy (Hunter 1957), 0.6 % at v = 1 mm/ms; half of that by the peak. (At 10 mm/ms
//   it would be 2.5 %, and T c_L = 20 R.)
// * The block is 10 R deep and held below: stiffer by 0.88 a/h (Dimitriadis 2002), 0.4 %.
//
// The rest is the mesh: elements of a/4 at the pole on the finest, whose contact radius grows by whole
// elements. The balls are finest at both poles by the core's x and y and the shells' radius; a core graded
// along z, too, gave the same figures to 0.5 %.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "verification/contact_support.hpp"

namespace geist::verification {
namespace {

constexpr double radius = 10, density = 7.8e-3, young = 2e5, poisson = 0.3;
constexpr double gap = 1e-3;

/// How a ball is cut: `core`, `shells`, and the gradings.
struct Cut {
  int core, shells;
  double middle, high;
};

std::string ball(const std::string& name, double z, const Cut& cut) {
  return fmt::format(
      R"([regions.{0}]
type = "hexahedra"
material = "steel"
formulation = "one-point"
ball = {{ centre = [0, 0, {1}], radius = {2} }}
divisions = [{3}, {4}]
minus = [{{ box = [[-{2}, -{2}, {5}], [0, {2}, {6}]] }}, {{ box = [[-{2}, -{2}, {5}], [{2}, 0, {6}]] }}]
[regions.{0}.grading]
x = {{ towards = "middle", ratio = {7} }}
y = {{ towards = "middle", ratio = {7} }}
radius = {{ towards = "high", ratio = {8} }}
)",
      name, z, radius, cut.core, cut.shells, z - radius, z + radius, cut.middle, cut.high);
}

/// Reduced mass, radius and modulus, and the speed of approach.
struct Hertz {
  double mass, radius, modulus, speed;
  double stiffness() const { return 4.0 / 3 * modulus * std::sqrt(radius); }
  double indentation() const { return std::pow(1.25 * mass * speed * speed / stiffness(), 0.4); }
  double force() const { return stiffness() * std::pow(indentation(), 1.5); }
  double duration() const {
    return 2 * std::sqrt(std::numbers::pi) * std::tgamma(1.4) / std::tgamma(0.9) * indentation() / speed;
  }
};

std::string impact(const Hertz& hertz, const std::string& other) {
  return fmt::format(R"(units = {{ length = "mm", mass = "g", time = "ms" }}
[materials.steel]
density = {}
young = {}
poisson = {}
[[contact]]
between = ["ball", "other"]
[[supports]]
where = {{ x = 0 }}
fix = ["x"]
[[supports]]
where = {{ y = 0 }}
fix = ["y"]
[analysis]
type = "dynamic"
duration = {}
[probes.force]
where = {{ region = "ball" }}
quantity = "contact-force"
component = "z"
)",
                     density, young, poisson, 1.1 * hertz.duration() + gap / hertz.speed) +
         other;
}

/// How far the ball's centre of mass has moved down, less how far that of the other ball has moved (if
/// `both`).
double approach(const Simulation& sim, bool both) {
  const Mesh& mesh = sim.model.mesh;
  double moved[2] = {0, 0}, mass[2] = {0, 0};
  for (std::size_t i = 0; i < mesh.nodes(); ++i) {
    const bool low = mesh.points[i].z < gap / 4;
    moved[low] += mesh.mass[i] * mesh.u[2][i], mass[low] += mesh.mass[i];
  }
  return (both ? moved[1] / mass[1] : 0) - moved[0] / mass[0] - gap;
}

struct Errors {
  double force, duration, indentation, restitution;
  double worst() const { return std::max({std::abs(force), std::abs(duration), std::abs(indentation)}); }
};

/// Relative differences to Hertz with the meshed mass: `round` is the closed form for round balls.
Errors errors(const std::string& text, Hertz round, bool both, const std::string& name) {
  const Recording r =
      run_text(text, round.duration() / 1000, [both](const Simulation& s) { return approach(s, both); });
  const Ledger &first = r.ledger.front(), &last = r.ledger.back();
  // Four quarters; of two balls the energy is that of the reduced mass at the full speed.
  Hertz hertz = round;
  hertz.mass = 4 * 2 * first.kinetic() / (round.speed * round.speed);
  EXPECT_NEAR(hertz.mass / round.mass, 1, 0.03);
  double begin = 0, end = 0, restored = 0;
  for (std::size_t i = 0; i < r.time.size(); ++i)
    if (r.probe[0][i] > 0) begin = begin > 0 ? begin : r.time[i], end = r.time[i];
  const std::size_t n = r.time.size() - 1;
  restored = -(r.watched[n] - r.watched[n - 10]) / (r.time[n] - r.time[n - 10]) / round.speed;
  const Errors e{4 * peak(r.probe[0]) / hertz.force() - 1, (end - begin) / hertz.duration() - 1,
                 peak(r.watched) / hertz.indentation() - 1, restored};
  // The ledger is off by (ω Δt)²/8 of what is in the fastest motion; 2e-5 on the coarsest mesh.
  EXPECT_LT(r.worst_balance(), 1e-4);
  if (both) {
    double momentum = 0;
    for (const Ledger& l : r.ledger) momentum = std::max(momentum, std::abs(l.linear.z - first.linear.z));
    EXPECT_LT(momentum, 1e-13 * hertz.mass * round.speed);
  }
  EXPECT_EQ(last.contact, 0);
  EXPECT_TRUE(r.warnings.empty());
  ::testing::Test::RecordProperty(
      name,
      fmt::format("F {:+.2f} %, T {:+.2f} %, indentation {:+.2f} %, restitution {:.4f}, balance {:.1g}",
                  100 * e.force, 100 * e.duration, 100 * e.indentation, e.restitution, r.worst_balance()));
  return e;
}

const double round_mass = 4.0 / 3 * std::numbers::pi * radius * radius * radius * density;
const double modulus = young / (2 * (1 - poisson * poisson));

TEST(Hertz, TwoBalls) {
  const Hertz hertz{round_mass / 2, radius / 2, modulus, 2};
  const auto run_with = [&hertz](const Cut& cut, const std::string& name) {
    const std::string moves = R"([[initial]]
where = { region = "ball" }
velocity = [0, 0, -1]
[[initial]]
where = { region = "other" }
velocity = [0, 0, 1]
)";
    const std::string balls = ball("ball", radius + gap / 2, cut) + ball("other", -radius - gap / 2, cut);
    return errors(impact(hertz, moves + balls), hertz, true, name);
  };
  const Errors coarse = run_with({12, 5, 16, 32}, "coarse"), medium = run_with({16, 6, 24, 32}, "medium"),
               fine = run_with({20, 6, 24, 32}, "fine");
  EXPECT_LT(coarse.worst(), 0.10);
  EXPECT_LT(medium.worst(), 0.04);
  EXPECT_LT(fine.worst(), 0.03);
  EXPECT_LT(medium.worst(), coarse.worst());
  EXPECT_LT(fine.worst(), medium.worst());
  for (const Errors& e : {coarse, medium, fine}) EXPECT_NEAR(e.restitution, 1, 0.002);
}

TEST(Hertz, BallOnABlock) {
  const Hertz hertz{round_mass, radius, modulus, 1};
  const std::string block = R"([regions.other]
type = "hexahedra"
material = "steel"
formulation = "one-point"
box = [[0, 0, -100], [100, 100, 0]]
divisions = [16, 16, 16]
[regions.other.grading]
x = { towards = "low", ratio = 300 }
y = { towards = "low", ratio = 300 }
z = { towards = "high", ratio = 300 }
[[supports]]
where = { z = -100 }
fix = ["x", "y", "z"]
[[initial]]
where = { region = "ball" }
velocity = [0, 0, -1]
)";
  const Errors e =
      errors(impact(hertz, block + ball("ball", radius + gap, {16, 6, 24, 32})), hertz, false, "block");
  EXPECT_LT(e.worst(), 0.03);
  EXPECT_GT(e.restitution, 0.99);
  EXPECT_LT(e.restitution, 1);
}

}  // namespace
}  // namespace geist::verification
