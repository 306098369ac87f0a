// Free bodies collide: two lattices, and a ball of hexahedra with a lattice. Momenta and energy are kept, no
// pair of particles is missed, and any number of threads gives the same bits.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "model/hash.hpp"
#include "verification/contact_support.hpp"

namespace geist::verification {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon() / 2;

const std::string head = R"(units = { length = "mm", mass = "g", time = "ms" }
[materials.m]
density = 0.001
young = 1000
poisson = 0.2
[coupling]
type = "none"
)";

/// Two lattices of 4 × 4 × 4. The right one is shifted to the side, so that a particle meets up to four.
const std::string lattices = head + R"([regions.left]
type = "lattice"
material = "m"
box = [[0, 0, 0], [1, 1, 1]]
radius = 0.125
[regions.right]
type = "lattice"
material = "m"
box = [[1.01, 0.07, 0.05], [2.01, 1.07, 1.05]]
radius = 0.125
[[contact]]
between = "all"
[[initial]]
where = { region = "left" }
velocity = [4, 0, 0]
[[initial]]
where = { region = "right" }
velocity = [-4, 0, 0]
[analysis]
type = "dynamic"
duration = 0.02
time_step = 4e-6
)";

/// Σ ½ k δ² over all pairs of particles of the two lattices, less what the ledger has, relative to the peak
/// of what is asked for: if a pair were missed, or counted twice, it would show.
double missed(const Simulation& sim) {
  const Lattice &a = sim.model.lattices[0], &b = sim.model.lattices[1];
  const double r = a.radius(), k = 2 * r * 1000 * 0.8 / (1.2 * 0.6);
  double energy = 0;
  for (std::size_t i = 0; i < a.grid.size(); ++i)
    for (std::size_t j = 0; j < b.grid.size() && a.is(i, site::particle); ++j) {
      if (!b.is(j, site::particle)) continue;
      const double overlap =
          2 * r - norm(a.grid.centre(i) + a.motion.vector(i) - b.grid.centre(j) - b.motion.vector(j));
      if (overlap > 0) energy += 0.5 * k * overlap * overlap;
    }
  return energy - sim.contacts.energies().stored;
}

/// Forces are added up in one order for one side and in another for the other: rounding, n^{1/2} ε of Σ m |v|
/// after n steps, as without contact (motion_test.cpp); ten times that.
double rounding(const Recording& r) { return 10 * std::sqrt(double(r.model().step)) * epsilon; }

TEST(Collision, OfTwoLattices) {
  const Recording r = run_text(lattices, 0, missed);
  const double mass = 0.001, speed = 4;
  EXPECT_LT(r.worst_momentum(), rounding(r) * 2 * mass * speed);
  const Ledger &first = r.ledger.front(), &last = r.ledger.back();
  double stored = 0;
  for (const Ledger& l : r.ledger) stored = std::max(stored, l.contact);
  EXPECT_GT(stored, 0.02 * first.kinetic());
  EXPECT_EQ(last.contact, 0);
  for (const double difference : r.watched) ASSERT_LT(std::abs(difference), 1e-12 * stored);
  // Contacts begin and end within steps of a 40th of their period: (ω Δt)²/8 of what they hold.
  EXPECT_LT(r.worst_balance(), 1e-3);
  EXPECT_EQ(last.dissipated(), 0);
  double left = 0, right = 0;
  for (const auto& [l, v] : {std::pair{0, &left}, std::pair{1, &right}}) {
    const Lattice& lattice = r.model().lattices[l];
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      if (lattice.is(s, site::particle)) *v += lattice.velocity[0][s] / 64;
  }
  EXPECT_LT(left, -0.3 * speed);  // the rest is in vibrations
  EXPECT_GT(right, 0.3 * speed);
  RecordProperty("balance", fmt::format("{:.2g}", r.worst_balance()));
  RecordProperty("speeds", fmt::format("{:.4f} {:.4f}", left, right));
  RecordProperty("momentum", fmt::format("{:.2g}", r.worst_momentum() / (2 * mass * speed)));
}

/// Rigid particles keep their angular momentum about the origin, too, friction and all: two of them, beside
/// each other's centre line.
TEST(Collision, OfTwoParticlesKeepsAngularMomentum) {
  const Recording r = run_text(head + R"([regions.a]
type = "lattice"
material = "m"
box = [[0, 0, 0], [1, 1, 1]]
radius = 0.5
[regions.b]
type = "lattice"
material = "m"
box = [[1.001, 0.21, 0.1], [1.601, 0.81, 0.7]]
radius = 0.3
[[contact]]
between = ["a", "b"]
friction = 0.4
restitution = 0.8
law = "hertz"
[[initial]]
where = { region = "a" }
velocity = [5, 1, 0.3]
spin = [3, -2, 4]
about = [0.5, 0.5, 0.5]
[[initial]]
where = { region = "b" }
velocity = [-5, 0, 1]
[analysis]
type = "dynamic"
duration = 0.02
time_step = 1e-6
)");
  const Particle a = only_particle(r.model(), 0), b = only_particle(r.model(), 1);
  EXPECT_LT(a.v.x, 5);
  EXPECT_GT(norm(b.spin), 0.1);
  EXPECT_GT(r.ledger.back().friction, 0);
  const double scale = a.mass * 6 + b.mass * 6;
  EXPECT_LT(r.worst_momentum(), rounding(r) * scale);
  double worst = 0;
  for (const Ledger& l : r.ledger) worst = std::max(worst, norm(l.angular - r.ledger[0].angular));
  EXPECT_LT(worst, rounding(r) * scale * 2);  // 2 mm: the farthest from the origin
  EXPECT_LT(r.worst_balance(), 2e-3);
  RecordProperty("angular", fmt::format("{:.2g}", worst / scale));
  RecordProperty("balance", fmt::format("{:.2g}", r.worst_balance()));
}

/// A ball of hexahedra falls on a lattice of 8 × 8 × 4; both are free.
const std::string ball_on_lattice = head + R"([regions.ball]
type = "hexahedra"
material = "m"
ball = { centre = [0.1, 0.05, 1.005], radius = 1 }
divisions = [4, 2]
[regions.ground]
type = "lattice"
material = "m"
box = [[-1, -1, -1], [1, 1, 0]]
radius = 0.125
[[contact]]
between = ["ball", "ground"]
friction = 0.3
[[initial]]
where = { region = "ball" }
velocity = [1, 0, -4]
[analysis]
type = "dynamic"
duration = 0.02
)";

/// Of the only mesh, along z.
double ball_speed(const Simulation& sim) {
  const Mesh& mesh = sim.model.mesh;
  double momentum = 0, mass = 0;
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    momentum += mesh.mass[i] * mesh.v[2][i], mass += mesh.mass[i];
  return momentum / mass;
}

TEST(Collision, OfABallWithALattice) {
  const Recording r = run_text(ball_on_lattice, 0, ball_speed);
  EXPECT_LT(r.worst_momentum(), rounding(r) * 0.004 * 4.2);
  const Ledger &first = r.ledger.front(), &last = r.ledger.back();
  EXPECT_EQ(last.contact, 0);
  EXPECT_NEAR(r.watched.front(), -4, 1e-3);
  EXPECT_GT(r.watched.back(), -1.5);  // bodies of nearly the same weight: it gives most of its momentum away
  EXPECT_GT(last.friction, 1e-3 * first.kinetic());
  EXPECT_LT(r.worst_balance(), 2e-3);
  EXPECT_TRUE(r.warnings.empty());
  RecordProperty("balance", fmt::format("{:.2g}", r.worst_balance()));
  for (const auto& [name, text] : {std::pair{"ball", &ball_on_lattice}, std::pair{"lattices", &lattices}}) {
    const std::string one = state_hash(run_text(*text).model());
    for (const int threads : {2, 3, 4})
      EXPECT_EQ(state_hash(run_text(*text, 0, {}, threads).model()), one) << name << " " << threads;
  }
}

}  // namespace
}  // namespace geist::verification
