// Follow and react: exact for linear fields, and each the other's transpose.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/parallel.hpp"
#include "coupling/ghosts.hpp"
#include "coupling/support.hpp"

namespace geist::coupling {
namespace {

using namespace testing;

/// Two lattices of different radii on either side of hexahedra that are distorted inside.
Model distorted_model() {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> shift(-0.08, 0.08);
  return Builder()
      .particles("left", {{{0, 0, 0}, {1, 2, 2}}}, 0.125)
      .hexahedra("between", {{1, 0, 0}, {3, 2, 2}}, {4, 4, 4})
      .particles("right", {{{3, 0, 0}, {4, 2, 2}}}, 0.0625)
      .move_nodes([&](Vec3 p) {
        for (int c = 0; c < 3; ++c) {
          const double low = c == 0 ? 1 : 0, high = c == 0 ? 3 : 2;
          if (p[c] > low + 0.01 && p[c] < high - 0.01) p[c] += shift(random);  // faces stay plane
        }
        return p;
      })
      .couple();
}

void fill(Field<3>& field, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  for (std::size_t i = 0; i < field.size(); ++i)
    field.set(i, {number(random), number(random), number(random)});
}

/// Random forces and moments on all listed sites.
void load_ghosts(Model& model, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  for (Lattice& lattice : model.lattices)
    for (std::size_t slot = 0; slot < lattice.listed.size(); ++slot)
      for (int c = 0; c < 6; ++c) lattice.listed_force[c][slot] = number(random);
}

Vec3 force_on(const Lattice& lattice, std::size_t g) {
  return lattice.listed_force.vector(lattice.ghost_slot[g]);
}

TEST(Follow, IsExactForLinearFieldsInDistortedHexahedra) {
  Model model = distorted_model();
  const Mat3 slope{{Vec3{0.3, -1, 2}, Vec3{0.7, 0.1, -0.4}, Vec3{-2, 1.5, 0.9}}};
  const Vec3 shift{5, -6, 7};
  for (std::size_t i = 0; i < model.mesh.nodes(); ++i)
    model.mesh.u.set(i, shift + slope * model.mesh.points[i]);
  for (Lattice& lattice : model.lattices) {
    EXPECT_GE(lattice.ghosts.size(), 64u);
    follow(lattice, model.mesh);
    for (const Ghost& ghost : lattice.ghosts) {
      const Vec3 expected = shift + slope * lattice.grid.centre(ghost.site);
      EXPECT_LT(norm(lattice.motion.vector(ghost.site) - expected), 1e-12);
    }
  }
}

TEST(Follow, TouchesNothingButTheDisplacementOfGhosts) {
  Model model = distorted_model();
  std::mt19937 random(1);
  fill(model.mesh.u, random);
  Lattice& lattice = model.lattices[0];
  for (std::size_t s = 0; s < lattice.grid.size(); ++s)
    for (int c = 0; c < 6; ++c) lattice.motion[c][s] = 9;
  follow(lattice, model.mesh);
  for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
    EXPECT_EQ(lattice.motion.vector(s) == (Vec3{9, 9, 9}), !lattice.is(s, site::ghost));
    EXPECT_EQ(lattice.motion.vector(s, 3), (Vec3{9, 9, 9}));
  }
}

TEST(Reactions, HaveThePowerOfTheGhostsForces) {
  Model model = distorted_model();
  std::mt19937 random(2);
  const Reactions reactions(model);
  for (int repeat = 0; repeat < 5; ++repeat) {
    fill(model.mesh.u, random);  // a virtual velocity
    load_ghosts(model, random);
    for (std::size_t i = 0; i < model.mesh.nodes(); ++i) model.mesh.f.set(i, {});
    for (Lattice& lattice : model.lattices) follow(lattice, model.mesh);
    reactions.add(model);
    double of_ghosts = 0, of_nodes = 0;
    std::size_t ghosts = 0;
    for (const Lattice& lattice : model.lattices)
      for (std::size_t g = 0; g < lattice.ghosts.size(); ++g, ++ghosts)
        of_ghosts += dot(force_on(lattice, g), lattice.motion.vector(lattice.ghosts[g].site));
    for (std::size_t i = 0; i < model.mesh.nodes(); ++i)
      of_nodes += dot(model.mesh.f.vector(i), model.mesh.u.vector(i));
    EXPECT_NEAR(of_nodes, of_ghosts, 1e-15 * 3 * static_cast<double>(ghosts));
    EXPECT_GT(std::abs(of_ghosts), 1e-3);
  }
}

TEST(Reactions, KeepMomentumAndItsMoment) {
  Model model = distorted_model();
  std::mt19937 random(3);
  load_ghosts(model, random);
  const Reactions reactions(model);
  reactions.add(model);
  Vec3 force, moment;
  for (const Lattice& lattice : model.lattices)
    for (std::size_t g = 0; g < lattice.ghosts.size(); ++g) {
      force += force_on(lattice, g);
      moment += cross(lattice.grid.centre(lattice.ghosts[g].site), force_on(lattice, g));
    }
  for (std::size_t i = 0; i < model.mesh.nodes(); ++i) {
    force -= model.mesh.f.vector(i);
    moment -= cross(model.mesh.points[i], model.mesh.f.vector(i));
  }
  EXPECT_LT(norm(force), 1e-12);  // of some 400 forces of order 1
  EXPECT_LT(norm(moment), 1e-11);
}

TEST(Reactions, AddToWhatIsThere) {
  Model model = distorted_model();
  std::mt19937 random(4);
  load_ghosts(model, random);
  const Reactions reactions(model);
  reactions.add(model);
  std::vector<Vec3> once;
  for (std::size_t i = 0; i < model.mesh.nodes(); ++i) once.push_back(model.mesh.f.vector(i));
  reactions.add(model);
  for (std::size_t i = 0; i < model.mesh.nodes(); ++i)
    EXPECT_LT(norm(model.mesh.f.vector(i) - 2 * once[i]), 1e-13);
}

TEST(Reactions, HaveTheSameBitsForAnyNumberOfThreads) {
  std::vector<std::vector<Vec3>> results;
  for (int n_threads = 1; n_threads <= 4; ++n_threads) {
    set_threads(n_threads);
    // 32 × 32 ghosts a side and 17 × 17 nodes on a face: enough for the threads to share the loops.
    Model model = Builder()
                      .particles("left", {{{0, 0, 0}, {0.25, 4, 4}}}, 0.03125)
                      .hexahedra("a", {{0.25, 0, 0}, {0.5, 4, 4}}, {1, 16, 16})
                      .couple();
    std::mt19937 random(5);
    fill(model.mesh.u, random);
    load_ghosts(model, random);
    follow(model.lattices[0], model.mesh);
    Reactions(model).add(model);
    auto& now = results.emplace_back();
    for (const Ghost& ghost : model.lattices[0].ghosts)
      now.push_back(model.lattices[0].motion.vector(ghost.site));
    for (std::size_t i = 0; i < model.mesh.nodes(); ++i) now.push_back(model.mesh.f.vector(i));
    EXPECT_GT(model.lattices[0].ghosts.size(), 2000u);
    EXPECT_EQ(now, results.front());
  }
}

TEST(Reactions, VirtualMassesAreTheGhosts) {
  const Model model = distorted_model();
  std::vector<double> mass(model.mesh.nodes(), 0.0);
  for (const Lattice& lattice : model.lattices) {
    const std::vector<double> share = virtual_masses(lattice, model.mesh);
    for (std::size_t i = 0; i < mass.size(); ++i) mass[i] += share[i];
  }
  double total = 0, expected = 0;
  Vec3 moment, expected_moment;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    EXPECT_GE(mass[i], -1e-9);
    total += mass[i], moment += mass[i] * model.mesh.points[i];
  }
  for (const Lattice& lattice : model.lattices)
    for (const Ghost& ghost : lattice.ghosts) {
      expected += lattice.mass;
      expected_moment += lattice.mass * lattice.grid.centre(ghost.site);
    }
  EXPECT_NEAR(total, expected, 1e-13 * expected);
  EXPECT_LT(norm(moment - expected_moment), 1e-12 * expected);
}

TEST(Reactions, OfNoGhostsAreNothing) {
  Model model = Builder().hexahedra("a", {{0, 0, 0}, {1, 1, 1}}, {1, 1, 1}).couple();
  Reactions(model).add(model);
  Reactions().add(model);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(model.mesh.f.vector(i), Vec3{});
}

}  // namespace
}  // namespace geist::coupling
