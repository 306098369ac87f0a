#include "verification/subcycling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "solver/fine_part.hpp"

namespace geist::verification {
namespace {

/// Where a number of the motion and its rate lie, and its mass or inertia.
struct Degree {
  double *u, *v;
  double mass;
};

/// Nodes, particles and ghosts that spin by themselves.
std::vector<Degree> degrees_of(Model& model) {
  std::vector<Degree> all;
  for (std::size_t i = 0; i < model.mesh.nodes(); ++i)
    for (int c = 0; c < 3; ++c) all.push_back({&model.mesh.u[c][i], &model.mesh.v[c][i], model.mesh.mass[i]});
  for (Lattice& lattice : model.lattices)
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      for (int c = 0; c < 6; ++c) {
        const bool spins = lattice.ghost_rotation == GhostRotation::own && c >= 3;
        if (lattice.is(s, site::particle) || (lattice.is(s, site::ghost) && spins))
          all.push_back(
              {&lattice.motion[c][s], &lattice.velocity[c][s], c < 3 ? lattice.mass : lattice.inertia});
      }
  return all;
}

/// M^{-1/2} K̃ M^{-1/2}: the first half kick makes ½ Δt ã of what is at rest.
Eigen::MatrixXd mean_stiffness(Simulation& sim) {
  const auto count = static_cast<Eigen::Index>(degrees_of(sim.model).size());
  Eigen::MatrixXd K(count, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    // arrays change places in short steps
    for (const Degree& degree : degrees_of(sim.model)) *degree.u = *degree.v = 0;
    *degrees_of(sim.model)[static_cast<std::size_t>(j)].u = 1;
    sim.start();
    const std::vector<Degree> degrees = degrees_of(sim.model);
    const Degree& moved = degrees[static_cast<std::size_t>(j)];
    EXPECT_EQ(*moved.u, 1);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Degree& degree = degrees[static_cast<std::size_t>(i)];
      K(i, j) = -2 / sim.dt * *degree.v * std::sqrt(degree.mass / moved.mass);
    }
  }
  return K;
}

}  // namespace

bool subcycle(Simulation& sim, double dt, double safety) {
  const FinePart fine = fine_part(sim.model, time_step_limits(sim.model, sim.contacts), dt, safety);
  if (fine.empty()) return false;
  sim.dt = dt, sim.subcycling = Subcycling(sim.model, fine);
  return true;
}

std::string Spectra::words() const {
  return fmt::format("{:.4f} of the limit, {} divisions, by short steps {}", largest, found,
                     fmt::join(by_substeps, " "));
}

void expect_symmetric_and_stable(const Case& input, const std::vector<double>& steps, Spectra& spectra) {
  set_threads(1);
  for (const double dt : steps) {
    Simulation sim = std::move(build(input).simulation);
    if (!subcycle(sim, dt)) continue;
    const Eigen::MatrixXd K = mean_stiffness(sim);
    const double limit = 4 / (dt * dt);
    EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-12 * K.cwiseAbs().maxCoeff()) << dt;
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>((K + K.transpose()) / 2, Eigen::EigenvaluesOnly)
            .eigenvalues();
    const double highest = values(values.size() - 1);
    EXPECT_GT(values(0), -1e-11 * limit);
    EXPECT_LT(values(5), 1e-11 * limit);  // rigid motions
    EXPECT_GT(values(6), 1e-6 * limit);
    EXPECT_LT(highest, limit) << dt << ' ' << sim.subcycling.ratio();
    spectra.largest = std::max(spectra.largest, highest / limit);
    ++spectra.found, ++spectra.by_substeps[static_cast<std::size_t>(sim.subcycling.ratio())];
  }
}

double worst_balance(Simulation& sim, double until) {
  sim.start();
  double worst = 0;
  const auto steps = std::lround(until / sim.dt);
  for (long i = 1; i <= steps; ++i) {
    sim.step(true);
    worst = std::max(worst, std::abs(sim.ledger().balance()));
  }
  return worst;
}

}  // namespace geist::verification
