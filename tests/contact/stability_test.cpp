// What contact adds to frequencies: the stiffness of small models by differences of forces, against what is
// charged for the time step.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "contact/contacts.hpp"
#include "contact/support.hpp"

namespace geist::contact {
namespace {

using namespace testing;

/// The degrees of freedom that a model's contacts act on, one after the other.
struct Freedom {
  double *motion, *velocity;
  double mass, charge;  ///< charge: allowed ω² of this one
};

std::vector<Freedom> freedoms(Model& model, const Contacts& contacts) {
  std::vector<Freedom> all;
  Mesh& mesh = model.mesh;
  const std::vector<double> charges = contacts.node_charges(model);
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    for (int c = 0; c < 3; ++c)
      if (mesh.held[i] != 0b111)
        all.push_back({&mesh.u[c][i], &mesh.v[c][i], mesh.mass[i], charges[i] / mesh.mass[i]});
  for (std::size_t l = 0; l < model.lattices.size(); ++l) {
    Lattice& lattice = model.lattices[l];
    const double charge = contacts.particle_charge(model, static_cast<std::int32_t>(l));
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      for (int c = 0; c < 6 && lattice.is(s, site::particle); ++c)
        all.push_back(
            {&lattice.motion[c][s], &lattice.velocity[c][s], c < 3 ? lattice.mass : lattice.inertia, charge});
  }
  return all;
}

std::vector<double> forces(Model& model, const std::vector<Freedom>& all, const Contacts& contacts) {
  std::vector<double> f(all.size(), 0.0);
  const auto add = [&](const double* motion, double force) {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].motion == motion) f[i] += force;
  };
  for (const TouchedPlace& t : contacts.touched())
    for (int c = 0; c < 3; ++c) {
      if (t.place.lattice < 0) {
        add(&model.mesh.u[c][t.place.index], t.force[c]);
        continue;
      }
      Lattice& lattice = model.lattices[t.place.lattice];
      add(&lattice.motion[c][t.place.index], t.force[c]);
      add(&lattice.motion[c + 3][t.place.index], t.moment[c]);
    }
  return f;
}

/// The largest eigenvalue of D^−½ K D^−½ with D = charge · mass: at most 1 if the charges bound the contacts.
double worst(const Builder& builder, const LawTable& laws) {
  Model model = builder.made();
  const Contacts shape(model, laws);
  const std::vector<Freedom> all = freedoms(model, shape);
  const auto n = static_cast<Eigen::Index>(all.size());
  const double h = 1e-7, dt = 1;
  const auto moved = [&](std::size_t j, double by) {
    Contacts contacts(model, laws);
    contacts.find(model, 0);
    *all[j].motion += by, *all[j].velocity = by / dt;
    contacts.find(model, dt);
    const std::vector<double> f = forces(model, all, contacts);
    *all[j].motion -= by, *all[j].velocity = 0;
    return f;
  };
  Eigen::MatrixXd K(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto after = moved(static_cast<std::size_t>(j), h), before = moved(static_cast<std::size_t>(j), -h);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Freedom &a = all[static_cast<std::size_t>(i)], &b = all[static_cast<std::size_t>(j)];
      const double scale = std::sqrt(a.mass * b.mass * a.charge * b.charge);
      const double k = -(after[static_cast<std::size_t>(i)] - before[static_cast<std::size_t>(i)]) / (2 * h);
      K(i, j) = scale > 0 ? k / scale : 0;
    }
  }
  const Eigen::MatrixXd symmetric = 0.5 * (K + K.transpose());
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvalues().maxCoeff();
}

const Law sticky{Law::Normal::penalty, 1, 1, 100};

TEST(Charges, BoundMatchingBlocks) {
  Builder builder;
  builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {2, 2, 1}).hexahedra({{0, 0, 0.999}, {1, 1, 2}}, {2, 2, 1});
  const double most = worst(builder, one_law(2, 0, 1, sticky));
  EXPECT_LE(most, 1 + 1e-6);
  EXPECT_GT(most, 0.3);  // and not far off
}

TEST(Charges, BoundBlocksOfDifferentDivisionsAndMaterials) {
  for (const auto& [coarse, fine] : {std::array{2, 3}, std::array{1, 3}, std::array{2, 6}}) {
    Builder builder;
    builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {fine, fine, fine})
        .hexahedra({{0, 0, 0.999}, {1, 1, 2}}, {coarse, coarse, 1}, {}, soft);
    EXPECT_LE(worst(builder, one_law(2, 0, 1, sticky)), 1 + 1e-6) << coarse << ' ' << fine;
  }
}

TEST(Charges, BoundParticlesOnABlock) {
  for (const Law::Normal normal : {Law::Normal::penalty, Law::Normal::hertz})
    for (const int n : {1, 4}) {
      Builder builder;
      builder.hexahedra({{0, 0, 0}, {1, 1, 1}}, {n, n, n})
          .particles({{0.1, 0.1, 0.99}, {0.9, 0.9, 1.39}}, 0.2, soft);
      Law law = sticky;
      law.normal = normal;
      EXPECT_LE(worst(builder, one_law(2, 0, 1, law)), 1 + 1e-6) << n;
    }
}

TEST(Charges, BoundTwoParticles) {
  for (const Law::Normal normal : {Law::Normal::penalty, Law::Normal::hertz}) {
    Builder builder;
    builder.particles({{0, 0, 0}, {1, 1, 1}}, 0.5).particles({{0, 0, 0.99}, {1, 1, 1.99}}, 0.5, soft);
    Law law = sticky;
    law.normal = normal;
    EXPECT_LE(worst(builder, one_law(2, 0, 1, law)), 1 + 1e-6);
  }
}

}  // namespace
}  // namespace geist::contact
