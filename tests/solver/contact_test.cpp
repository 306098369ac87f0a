// Contact in the step: bouncing particles against what collisions must do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "fe/elements.hpp"
#include "geometry/block.hpp"
#include "geometry/packing.hpp"
#include "solver/simulation.hpp"
#include "solver/time_step.hpp"

namespace geist {
namespace {

const Material stone{"stone", 2.5, 30, 0.2};

Lattice single(Vec3 centre, double radius) {
  Lattice lattice;
  lattice.name = "ball", lattice.material = stone;
  pack(lattice, {{centre - Vec3{radius, radius, radius}, centre + Vec3{radius, radius, radius}}}, {}, radius);
  lattice.mass = 2.5 * std::pow(2 * radius, 3), lattice.inertia = 0.4 * lattice.mass * radius * radius;
  trim(lattice), connect(lattice), finish(lattice), list_sites(lattice, {});
  return lattice;
}

std::size_t site_of(const Lattice& lattice) {
  const auto at = std::find_if(lattice.word.begin(), lattice.word.end(),
                               [](std::uint32_t w) { return w & site::particle; });
  return static_cast<std::size_t>(at - lattice.word.begin());
}

void ready(Simulation& sim, const contact::Law& law) {
  const std::size_t regions = sim.model.mesh.regions.size() + sim.model.lattices.size();
  contact::LawTable laws(regions);
  laws.set(0, 1, law);
  sim.reactions = coupling::Reactions(sim.model);
  sim.contacts = contact::Contacts(sim.model, std::move(laws));
  sim.dt = critical(time_step_bounds(sim.model, sim.contacts)).bound;
  sim.start();
}

/// A ball above a block that is held all over.
void above_a_block(Simulation& sim, Vec3 velocity, double radius) {
  Mesh& mesh = sim.model.mesh;
  HexRegion region;
  region.name = "block", region.material = stone, region.formulation = "full";
  append_block(mesh, region, corners_of({{0, 0, 0}, {1, 1, 1}}), {1, 1, 1});
  finish(mesh), fe::lump_masses(mesh);
  std::fill(mesh.held.begin(), mesh.held.end(), 0b111);
  sim.supports.motions.push_back({});
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    for (int c = 0; c < 3; ++c) sim.supports.held.push_back({-1, i, -1, c, 0});
  sim.model.lattices.push_back(single({0.45, 0.4, 1 + radius + 0.01}, radius));
  sim.model.lattices[0].velocity.set(site_of(sim.model.lattices[0]), velocity);
}

TEST(Bounce, OnAHeldBlockHasTheGivenRestitution) {
  set_threads(1);
  for (const contact::Law::Normal normal : {contact::Law::Normal::penalty, contact::Law::Normal::hertz})
    for (const double e : {1.0, 0.8, 0.5, 0.2}) {
      Simulation sim;
      above_a_block(sim, {0, 0, -0.5}, 0.2);
      ready(sim, {normal, 1, e, 0});
      sim.dt /= 50;
      const Lattice& ball = sim.model.lattices[0];
      const std::size_t s = site_of(ball);
      for (int i = 0; i < 2'000'000 && (ball.velocity[2][s] < 0 || ball.motion[2][s] < -0.005); ++i)
        sim.step(false);
      EXPECT_NEAR(ball.velocity[2][s], 0.5 * e, 0.005 * e) << e;
      sim.step(true);
      EXPECT_NEAR(sim.ledger().balance(), 0, 2e-3 * sim.ledger().initial) << e;
    }
}

/// The largest step that a spring k and its dashpot, reckoned with the velocity of half a step before, allow
/// a mass m: k Δt² + 2 c Δt ≤ 4 m, c = 2 ζ √(k m).
double lagged_bound(double k, double mass, double zeta) {
  return 2 * std::sqrt(mass / k) * (std::sqrt(1 + zeta * zeta) - zeta);
}

TEST(Bounce, MakesNoEnergyWhereStepsResolveIt) {
  set_threads(1);
  for (const double factor : {1.0, 100.0})
    for (const double e : {1.0, 0.5, 0.2, 0.05}) {
      Simulation sim;
      above_a_block(sim, {0, 0, -0.05}, 0.2);
      ready(sim, {contact::Law::Normal::penalty, factor, e, 0});
      const Lattice& ball = sim.model.lattices[0];
      const double k = factor * 2 * 0.2 * contact::layer_modulus(stone);
      sim.dt = std::min(sim.dt, 0.3 * lagged_bound(k, ball.mass, contact::damping_ratio({}, e)));
      const std::size_t s = site_of(ball);
      for (int i = 0; i < 50'000 && (ball.velocity[2][s] <= 0 || ball.motion[2][s] < -0.005); ++i)
        sim.step(false);
      EXPECT_LE(std::abs(ball.velocity[2][s]), 0.05 * 1.05) << factor << ' ' << e;
    }
}

TEST(Collision, OfTwoBallsObliquelyKeepsMomenta) {
  std::vector<Ledger> ends;
  for (const int n : {1, 2, 4}) {
    set_threads(n);
    Simulation sim;
    finish(sim.model.mesh);
    sim.model.lattices.push_back(single({0, 0, 0}, 0.5));
    sim.model.lattices.push_back(single({0.4, 0.2, 0.95}, 0.6));
    Lattice &a = sim.model.lattices[0], &b = sim.model.lattices[1];
    a.velocity.set(site_of(a), {0.1, 0.3, 0.5}), b.velocity.set(site_of(b), {-0.2, 0.1, -0.4});
    b.velocity.set(site_of(b), {0.3, -1, 2}, 3);
    ready(sim, {contact::Law::Normal::hertz, 1, 0.7, 0.3});
    const Ledger before = sim.ledger();
    for (int i = 0; i < 300; ++i) sim.step(i == 299);
    const Ledger after = sim.ledger();
    ends.push_back(after);
    EXPECT_LE(norm(after.linear - before.linear), 1e-12);
    EXPECT_LE(norm(after.angular - before.angular), 1e-12);
    EXPECT_GT(after.friction + after.contact_damping, 0);
    EXPECT_NEAR(after.balance(), 0, 0.02 * after.initial);
  }
  set_threads(1);
  for (const Ledger& end : ends) {
    EXPECT_EQ(end.kinetic(), ends[0].kinetic());
    EXPECT_EQ(end.angular, ends[0].angular);
  }
}

}  // namespace
}  // namespace geist
