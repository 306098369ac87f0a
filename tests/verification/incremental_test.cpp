// The fast kernels against the published algorithm (15)–(27), taken literally (tests/reference): bodies whose
// interface is L-shaped, set in motion and loaded, over thousands of steps.
//
// Both compute the same numbers in another order and form, one d by increments of (22), the other in total.
// Each step rounds to about 1e-16 of the largest displacement; undamped vibrations keep such errors without
// growing, so that a random walk of 4000 steps through a few hundred bonds leaves about 1e-13, and 1e-10 is
// what is promised.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/parallel.hpp"
#include "verification/bodies.hpp"
#include "verification/support.hpp"

namespace geist::verification {
namespace {

constexpr double promised = 1e-10;
constexpr int steps = 4000;

/// Largest difference and largest value of one quantity.
struct Comparison {
  double difference = 0, value = 0;
  void add(Vec3 a, Vec3 b) {
    difference = std::max(difference, norm(a - b)), value = std::max(value, norm(b));
  }
  double relative() const { return difference / value; }
};

struct Comparisons {
  Comparison displacement, rotation, velocity, spin, ghost_displacement, ghost_rotation, ghost_spin;
};

Vec3 velocity_now(const Lattice& lattice, std::size_t s, int first) {
  return 0.5 * (lattice.velocity_before.vector(s, first) + lattice.velocity.vector(s, first));
}

Comparisons compare(const Model& model, const reference::Incremental& body) {
  Comparisons c;
  const Mesh& mesh = model.mesh;
  for (std::size_t i = 0; i < body.nodes.size(); ++i) {
    c.displacement.add(mesh.u.vector(i), body.nodes[i].u);
    c.velocity.add(0.5 * (mesh.v_before.vector(i) + mesh.v.vector(i)), body.nodes[i].v);
  }
  const Lattice& lattice = model.lattices[0];
  for (const reference::Point& p : body.particles) {
    const std::size_t s = site_at(lattice, p.X);
    c.displacement.add(lattice.motion.vector(s), p.u);
    c.rotation.add(lattice.motion.vector(s, 3), p.theta);
    c.velocity.add(velocity_now(lattice, s, 0), p.v);
    c.spin.add(velocity_now(lattice, s, 3), p.omega);
  }
  for (const reference::Point& g : body.ghosts) {
    const std::size_t s = site_at(lattice, g.X);
    c.ghost_displacement.add(lattice.motion.vector(s), g.u);
    c.ghost_rotation.add(lattice.motion.vector(s, 3), g.theta);
    c.ghost_spin.add(velocity_now(lattice, s, 3), g.omega);
  }
  return c;
}

/// Run both; what is found may not differ.
void expect_agreement(const std::string& text, bool spin) {
  const Case input =
      read_case_text(text, "L.toml", {spin ? "coupling.rotation=one-step-back" : "coupling.rotation=none"});
  Simulation sim = std::move(build(input).simulation);
  reference::Incremental body = reference_of(input, sim);
  ASSERT_EQ(body.particles.size(), sim.model.lattices[0].count(site::particle));
  ASSERT_EQ(body.ghosts.size(), sim.model.lattices[0].ghosts.size());
  ASSERT_EQ(body.bonds.size(), de::bond_count(sim.model.lattices[0]));
  set_threads(1);
  sim.start(), body.start();
  for (int n = 1; n <= steps; ++n) sim.step(n == steps), body.step(sim.dt);
  const Comparisons c = compare(sim.model, body);
  for (const auto& [name, comparison] : {std::pair{"displacement", c.displacement},
                                         {"rotation", c.rotation},
                                         {"velocity", c.velocity},
                                         {"spin", c.spin},
                                         {"ghosts' displacement", c.ghost_displacement}}) {
    EXPECT_GT(comparison.value, 0) << name;
    EXPECT_LT(comparison.relative(), promised) << name;
    ::testing::Test::RecordProperty(name, std::to_string(comparison.relative() * 1e15) + "e-15");
  }
  if (!spin) {
    EXPECT_EQ(c.ghost_spin.value + c.ghost_rotation.value, 0);
    return;
  }
  EXPECT_LT(c.ghost_rotation.relative(), promised);
  EXPECT_LT(c.ghost_spin.relative(), promised);
  ::testing::Test::RecordProperty("ghost spin", std::to_string(c.ghost_spin.relative() * 1e15) + "e-15");
}

TEST(Incremental, LatticeInTheCornerOfAnLOfHexahedra) { expect_agreement(box_in_an_L, true); }
TEST(Incremental, LatticeInTheCornerWithoutGhostSpin) { expect_agreement(box_in_an_L, false); }
TEST(Incremental, LOfParticlesAroundDistortedHexahedra) { expect_agreement(L_around_a_box, true); }
TEST(Incremental, LOfParticlesWithoutGhostSpin) { expect_agreement(L_around_a_box, false); }

/// The energies that the program reports are those of the literal bonds.
TEST(Incremental, BondEnergyIsThatOfTheAccumulatedDisplacements) {
  const Case input = read_case_text(box_in_an_L, "L.toml");
  Simulation sim = std::move(build(input).simulation);
  reference::Incremental body = reference_of(input, sim);
  sim.start(), body.start();
  for (int n = 1; n <= 500; ++n) sim.step(false), body.step(sim.dt);
  const de::BondEnergies e = de::energies(sim.model.lattices[0]);
  EXPECT_GT(e.coupling, 0);
  EXPECT_NEAR((e.bonds + e.coupling) / body.bond_energy(), 1, promised);
}

}  // namespace
}  // namespace geist::verification
