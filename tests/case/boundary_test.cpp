// Supports, loads, initial motion and probes as a case's model gets them.
#include "case/boundary.hpp"

#include <algorithm>
#include <cmath>

#include "small_case.hpp"

namespace geist {
namespace {

using namespace testing;

Simulation simulation(const std::string& more) { return build(small_case(more)).simulation; }

/// The whole text, so that errors can be looked up in it.
std::string text(const std::string& more) { return materials + two_regions + dynamic + more; }

Vec3 total_force(const Load& load) {
  Vec3 total;
  for (const NodeForce& f : load.nodes) total += f.force;
  for (const ParticleForce& f : load.particles) total += f.force;
  return total;
}

TEST(SupportsOfACase, HoldNodesAndParticles) {
  const Simulation sim = simulation("[[supports]]\nwhere = { y = 0 }\nfix = [\"x\", \"z\", \"rx\"]\n");
  EXPECT_EQ(sim.supports.held.size(), 9u * 2 + 16 * 3);  // nodes have no rotation
  std::size_t nodes = 0;
  for (const HeldComponent& h : sim.supports.held) {
    if (h.lattice < 0) {
      ++nodes;
      EXPECT_EQ(sim.model.mesh.points[h.place].y, 0);
      EXPECT_EQ(sim.model.mesh.held[h.place], 0b101);
      continue;
    }
    const Lattice& lattice = sim.model.lattices[h.lattice];
    EXPECT_NEAR(lattice.grid.centre(h.place).y, 0.125, 1e-12);
    EXPECT_EQ(lattice.listed[h.slot], h.place);
    EXPECT_EQ(lattice.listed_held[h.slot], 0b001101);
    EXPECT_FALSE(lattice.is(h.place, site::free));
  }
  EXPECT_EQ(nodes, 18u);
  EXPECT_EQ(std::count(sim.model.mesh.held.begin(), sim.model.mesh.held.end(), 0b101), 9);
}

TEST(SupportsOfACase, MayFixTheSameComponentTwice) {
  const Simulation sim = simulation(
      "[[supports]]\nwhere = { x = 0 }\nfix = [\"x\", \"y\"]\n[[supports]]\nwhere = { y = 0 }\nfix = "
      "[\"y\"]\n");
  // x of 9 nodes; y of 9 + 9 nodes less the 3 on the edge, and of 16 particles; each once
  EXPECT_EQ(sim.supports.held.size(), 9u + 15 + 16);
}

TEST(SupportsOfACase, MoveAsTheyAreTold) {
  const Simulation sim = simulation(
      "[curves.ramp]\npoints = [[0, 0], [2, 1]]\n[[supports]]\nwhere = { x = 2 }\ndisplacement = { z = 3 }\n"
      "velocity = { y = -4 }\ncurve = \"ramp\"\n");
  ASSERT_EQ(sim.supports.held.size(), 32u);
  for (const HeldComponent& h : sim.supports.held) {
    const Motion& motion = sim.supports.motions[h.motion];
    if (h.component == 2) {
      EXPECT_NEAR(motion.velocity(0.5, 0.25), 1.5, 1e-14);  // displacement 3 t/2
    } else {
      EXPECT_EQ(h.component, 1);
      EXPECT_NEAR(motion.velocity(0.5, 0.25), -4 * 0.625 / 2, 1e-14);  // at the middle of the step
    }
  }
}

TEST(SupportsOfACase, RefuseTwoMotionsOfOneComponent) {
  const std::string fixed = "[[supports]]\nwhere = { x = 0 }\nfix = [\"y\"]\n";
  const std::string moved = "[[supports]]\nwhere = { y = 0, x = [0, 0.5] }\nvelocity = { y = 1 }\n";
  expect_build_error(text(fixed + moved), moved, {"'y'", "moved by another support"});
}

TEST(SupportsOfACase, RefuseRotationsOfNodes) {
  expect_build_error(text("[[supports]]\nwhere = { x = 0 }\nfix = [\"x\", \"ry\"]\n"), "[[supports]]",
                     {"'ry'", "no particle"});
}

TEST(LoadsOfACase, AddUpToTheTotalForce) {
  for (const std::string where : {"{ x = 0 }", "{ x = 2 }", "{ y = 0 }", "{ y = 0, z = 0 }", "{ x = [0, 2] }",
                                  "{ x = 0, y = 0, z = 0 }", "{ region = \"right\" }"}) {
    const Simulation sim = simulation("[[loads]]\nwhere = " + where + "\ntotal_force = [3, -4, 5]\n");
    ASSERT_EQ(sim.loads.size(), 1u);
    EXPECT_LT(norm(total_force(sim.loads[0]) - Vec3{3, -4, 5}), 1e-13) << where;
    EXPECT_EQ(sim.loads[0].curve.at(7), 1);
  }
}

TEST(LoadsOfACase, ActOnNodesAndParticlesOfAMixedEdge) {
  const Simulation sim = simulation("[[loads]]\nwhere = { y = 0, z = 0 }\ntotal_force = [0, 0, 8]\n");
  EXPECT_EQ(sim.loads[0].nodes.size(), 3u);
  EXPECT_EQ(sim.loads[0].particles.size(), 4u);
}

TEST(LoadsOfACase, TractionsAddUpToTheArea) {
  const Simulation sim = simulation(
      "[[loads]]\nwhere = { y = 1 }\ntraction = [1, 2, 3]\n[[loads]]\nwhere = { x = 2, z = [0, 0.5] }\n"
      "traction = [10, 0, 0]\n");
  EXPECT_LT(norm(total_force(sim.loads[0]) - Vec3{2, 4, 6}), 1e-13);  // 1 × 2
  EXPECT_LT(norm(total_force(sim.loads[1]) - Vec3{5, 0, 0}), 1e-13);
}

TEST(LoadsOfACase, HandTheForceOnLoadedParticlesOver) {
  const Simulation sim = simulation("[[loads]]\nwhere = { x = 2 }\ntotal_force = [1, 0, 0]\n");
  const Lattice& lattice = sim.model.lattices[0];
  EXPECT_EQ(sim.loads[0].particles.size(), 16u);
  for (const ParticleForce& p : sim.loads[0].particles) {
    EXPECT_FALSE(lattice.is(p.site, site::free));
    EXPECT_EQ(lattice.listed[p.slot], p.site);
    EXPECT_EQ(lattice.listed_held[p.slot], 0);
  }
  EXPECT_EQ(lattice.count(site::free), 48u);
}

TEST(LoadsOfACase, GravityAndCurves) {
  const Simulation sim = simulation(
      "[curves.ramp]\npoints = [[0, 0], [2, 1]]\n[[loads]]\ngravity = [0, 0, -9.81]\ncurve = \"ramp\"\n");
  ASSERT_EQ(sim.loads.size(), 1u);
  EXPECT_TRUE(sim.loads[0].is_gravity);
  EXPECT_TRUE(sim.loads[0].nodes.empty() && sim.loads[0].particles.empty());
  EXPECT_NEAR(gravity(sim.loads, 1).z, -9.81 / 2, 1e-14);
}

TEST(LoadsOfACase, RefuseTractionsWithoutFaces) {
  for (const std::string where :
       {"{ x = 0, y = 0 }", "{ x = 2, y = 0 }", "{ x = 0.5 }", "{ x = 1.75 }", "{ x = [0, 2] }"})
    expect_build_error(text("[[loads]]\nwhere = " + where + "\ntraction = [1, 2, 3]\n"), "[[loads]]",
                       {"traction", "exterior faces"});
}

TEST(InitialMotion, IsThatOfARigidBody) {
  const Simulation sim = simulation(
      "[[initial]]\nwhere = { region = \"right\" }\nvelocity = [1, 2, 3]\nspin = [4, 5, 6]\nabout = [7, 8, "
      "9]\n");
  const Lattice& lattice = sim.model.lattices[0];
  for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
    if (!lattice.is(s, site::particle)) continue;
    const Vec3 a = lattice.grid.centre(s) - Vec3{7, 8, 9};
    const Vec3 v{1 + 5 * a.z - 6 * a.y, 2 + 6 * a.x - 4 * a.z, 3 + 4 * a.y - 5 * a.x};
    EXPECT_LT(norm(lattice.velocity.vector(s) - v), 1e-13);
    EXPECT_EQ(lattice.velocity.vector(s, 3), (Vec3{4, 5, 6}));
  }
  for (std::size_t i = 0; i < sim.model.mesh.nodes(); ++i) EXPECT_EQ(sim.model.mesh.v.vector(i), Vec3{});
}

TEST(InitialMotion, OfEverythingSpinsGhostsToo) {
  const std::string more = "[[initial]]\nvelocity = [0, 0, 1]\nspin = [0, 2, 0]\nabout = [0, 0, 0]\n";
  const auto ghosts = [](const std::string& rotation) {
    return "kinematics = \"small\"\n[coupling]\nrotation = \"" + rotation + "\"\n";
  };
  const Simulation sim = simulation(ghosts("one-step-back") + more);
  const Lattice& lattice = sim.model.lattices[0];
  EXPECT_EQ(lattice.ghosts.size(), 16u);
  for (const Ghost& ghost : lattice.ghosts)
    EXPECT_EQ(lattice.velocity.vector(ghost.site, 3), (Vec3{0, 2, 0}));
  for (std::size_t i = 0; i < sim.model.mesh.nodes(); ++i) {
    const Vec3 p = sim.model.mesh.points[i];
    EXPECT_LT(norm(sim.model.mesh.v.vector(i) - Vec3{2 * p.z, 0, 1 - 2 * p.x}), 1e-14);
  }
  const Simulation without = simulation(ghosts("none") + more);
  for (const Ghost& ghost : without.model.lattices[0].ghosts)
    EXPECT_EQ(without.model.lattices[0].velocity.vector(ghost.site, 3), Vec3{});
}

TEST(ProbesOfACase, KnowWhatTheyRead) {
  const Built built = build(small_case(
      "[[supports]]\nwhere = { x = 0 }\nfix = [\"x\"]\n[probes.b]\nwhere = { y = 0 }\nquantity = "
      "\"velocity\"\ncomponent = \"magnitude\"\nreduce = \"max\"\n[probes.a]\nwhere = { x = [0, 0.1] }\n"
      "quantity = \"reaction\"\ncomponent = \"x\"\n"));
  ASSERT_EQ(built.probes.size(), 2u);
  const Probe& speed = built.probes[0];
  EXPECT_EQ(speed.name, "b");
  EXPECT_EQ(speed.quantity, Probe::Quantity::velocity);
  EXPECT_EQ(speed.component, 3);
  EXPECT_EQ(speed.reduce, Probe::Reduce::max);
  EXPECT_EQ(speed.nodes.size(), 9u);
  EXPECT_EQ(speed.particles.size(), 16u);
  EXPECT_EQ(built.probes[1].held.size(), 9u);
}

TEST(ProbesOfACase, RefuseWhatIsNotThere) {
  const auto probe = [](const std::string& where, const std::string& quantity) {
    return text("[probes.p]\nwhere = " + where + "\nquantity = \"" + quantity + "\"\ncomponent = \"x\"\n");
  };
  expect_build_error(probe("{ x = 0 }", "rotation"), "[probes.p]", {"only particles have a rotation"});
  expect_build_error(probe("{ x = 0 }", "reaction"), "[probes.p]", {"no reaction"});
  expect_build_error(probe("{ x = 9 }", "displacement"), "where = { x = 9 }", {"selects nothing"});
}

TEST(EmptySelections, AreErrorsAtTheirPlace) {
  for (const std::string what : {"[[supports]]\nfix = [\"x\"]\n", "[[loads]]\ntotal_force = [1, 0, 0]\n",
                                 "[[loads]]\ntraction = [1, 0, 0]\n", "[[initial]]\nvelocity = [1, 0, 0]\n"})
    for (const std::string where : {"{ x = 0.3 }", "{ y = [3, 4] }", "{ x = 0, region = \"right\" }"})
      expect_build_error(text(what + "where = " + where + "\n"), "where = " + where, {"selects nothing"});
}

}  // namespace
}  // namespace geist
