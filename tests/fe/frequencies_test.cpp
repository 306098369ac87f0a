// Bounds on frequencies: sharp for one element, safe for a mesh.
#include <gtest/gtest.h>

#include "support.hpp"

#include <Eigen/Eigenvalues>

namespace geist::fe {
namespace {

using namespace testing;
using Eigen::MatrixXd;

const Material material{"m", 2.3, 10, 0.3};
const std::vector<std::string> names{"full", "selective-reduced", "assumed-strain", "one-point",
                                     "one-point-viscous"};

/// Column d of K (from u) or C (from v) of a mesh, by its forces.
MatrixXd assembled(Mesh& mesh, Field<3> Mesh::*field) {
  const int dofs = static_cast<int>(3 * mesh.nodes());
  MatrixXd A(dofs, dofs);
  for (int d = 0; d < dofs; ++d) {
    (mesh.*field)[d % 3][d / 3] = 1;
    internal_forces(mesh);
    (mesh.*field)[d % 3][d / 3] = 0;
    for (std::size_t n = 0; n < mesh.nodes(); ++n)
      for (int c = 0; c < 3; ++c) A(3 * static_cast<int>(n) + c, d) = -mesh.f.vector(n)[c];
  }
  return A;
}

/// Spectral radius of one step of v ← v − Δt M⁻¹ (K u + C v), u ← u + Δt v.
double growth(Mesh& mesh, double dt) {
  const MatrixXd K = assembled(mesh, &Mesh::u), C = assembled(mesh, &Mesh::v);
  const Eigen::Index n = K.rows();
  MatrixXd step = MatrixXd::Identity(2 * n, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double m = mesh.mass[i / 3];
    step.row(i).head(n) -= dt / m * C.row(i);
    step.row(i).tail(n) -= dt / m * K.row(i);
  }
  step.bottomRows(n) += dt * step.topRows(n);
  return Eigen::EigenSolver<MatrixXd>(step, false).eigenvalues().cwiseAbs().maxCoeff();
}

double largest(const std::vector<double>& a) { return *std::max_element(a.begin(), a.end()); }

Mesh with_mass(Mesh mesh) {
  lump_masses(mesh);
  return mesh;
}

TEST(Frequencies, OneElementIsStableUpToItsBoundAndNoFurther) {
  for (const std::string& name : names)
    for (double coefficient : {0.05, 0.6}) {
      Mesh mesh = with_mass(box({1, 1, 1}, {1, 1, 1}, name, material, [](Vec3 p) {
        return p + 0.2 * Vec3{p.y * p.z, p.x * p.z, p.x * p.y * p.z};
      }));
      mesh.regions[0].hourglass_coefficient = coefficient;
      const double dt = 2 / std::sqrt(frequencies_squared(mesh)[0]);
      EXPECT_LT(growth(mesh, 0.999 * dt), 1 + 1e-5) << name << coefficient;
      EXPECT_GT(growth(mesh, 1.001 * dt), 1.001) << name << coefficient;
    }
}

TEST(Frequencies, LargestBoundsTheWholeMesh) {
  for (const std::string& name : names)
    for (double coefficient : {0.05, 0.6}) {
      Mesh mesh = with_mass(box({3, 2, 2}, {1, 1, 1}, name, material, scatter_inside(0.1)));
      mesh.regions[0].hourglass_coefficient = coefficient;
      const double dt = 2 / std::sqrt(largest(frequencies_squared(mesh)));
      EXPECT_LT(growth(mesh, dt), 1 + 1e-5) << name << coefficient;
      EXPECT_GT(growth(mesh, 1.3 * dt), 1.01) << name << coefficient;  // not far below the true limit
    }
}

TEST(Frequencies, LongitudinalModeOfACube) {
  // Mean strain cube of edge h, lumped mass ρh³/8, ν = 0: six uniform strain modes. All components of one
  // normal strain: K = E h/2 per unit vector, so ω² = 4 E/(ρ h²).
  const Material plain{"p", 2, 8, 0};
  Mesh mesh = box({2, 1, 1}, {1, 0.5, 0.5}, "one-point", plain);
  for (double w2 : frequencies_squared(mesh)) EXPECT_NEAR(w2, 4 * 8 / (2 * 0.25), 1e-6);
}

TEST(Frequencies, CirclesAreSafeAndTheWorstIsSharp) {
  for (const std::string& name : names) {
    const Mesh mesh = box({4, 4, 4}, {1, 1, 1}, name, material, scatter_inside(0.06));
    const std::vector<double> sharp = frequencies_squared(mesh), circles = frequencies_squared(mesh, 0);
    for (std::size_t e = 0; e < sharp.size(); ++e) {
      EXPECT_GE(circles[e], sharp[e]);
      EXPECT_LT(circles[e], 6 * sharp[e]);
    }
    const std::vector<double> mixed = frequencies_squared(mesh, 40);
    for (std::size_t e = 0; e < sharp.size(); ++e)
      EXPECT_TRUE(mixed[e] == sharp[e] || mixed[e] == circles[e]) << e;
    EXPECT_LT(largest(mixed), largest(circles));
  }
}

TEST(Frequencies, EqualElementsShareTheirResult) {
  const Mesh mesh = box({30, 30, 30}, {3, 3, 3}, "selective-reduced", material);  // one shape, to rounding
  const std::vector<double> w2 = frequencies_squared(mesh, 1000);
  for (double w : w2) EXPECT_NEAR(w, w2[0], 4e-9 * w2[0]);
}

}  // namespace
}  // namespace geist::fe
