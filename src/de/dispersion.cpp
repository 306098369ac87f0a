// What the endless lattice does: its fastest vibration and its elastic constants.
//
// A plane wave (u, θ) e^{i κ·x} of the endless lattice obeys the 6 × 6 Hermitian eigenproblem D(κ) φ = ω² M
// φ, where the bond in direction e with arm a = r e has the relative displacement
//   d = (e^{iβ} − 1) u − (e^{iβ} + 1) θ × a,   β = κ·(2 r e),
// and D = Σ over the nine directions that meet each bond once of Bᴴ K B, d = B (u, θ). Bonds of consistent
// lattices that bend add |e^{iβ} − 1|² diag(k) to the rotations' part, and cells that resist dilatation
// k q q̄ᵀ.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "de/assembly.hpp"
#include "de/bonds.hpp"
#include "de/elastic_bond.hpp"
#include "de/stiffness.hpp"

namespace geist::de {
namespace {

using Complex = std::complex<double>;
using Matrix6c = Eigen::Matrix<Complex, 6, 6>;

/// k of a cell (de/dilatation.hpp) of the endless lattice.
double endless_cell(const Lattice& lattice) {
  return lattice.consistent() ? Dilatation::from(lattice.material, lattice.radius()).cell : 0;
}

/// Sheets and rows have none.
bool has_cells(const Lattice& lattice) {
  return std::any_of(lattice.dilating.begin(), lattice.dilating.end(),
                     [](std::uint8_t here) { return here & dilating::cell; });
}

/// q of waves (u) for the cell with its lowest corner at the origin: q = Σ_a s_a·u e^{iβ·a}.
Eigen::Vector3cd swelling(const Eigen::Vector3d& beta) {
  Eigen::Vector3cd q = Eigen::Vector3cd::Zero();
  for (int a = 0; a < 8; ++a) {
    const Eigen::Vector3d corner(a & 1, a >> 1 & 1, a >> 2);
    q += std::polar(1.0, beta.dot(corner)) * (2 * corner - Eigen::Vector3d::Ones());
  }
  return q;
}

/// Largest ω² of waves with phase advance β = 2 r κ per pitch, each component in [0, π].
double fastest(const Lattice& lattice, const EndlessBond& bonds, double cell, const Eigen::Vector3d& beta) {
  const double r = lattice.radius();
  Matrix6c D = Matrix6c::Zero();
  for (int d = 9; d < 18; ++d) {
    const Eigen::Vector3d e(directions[d][0], directions[d][1], directions[d][2]);
    const Complex phase = std::polar(1.0, beta.dot(e));
    Eigen::Matrix<Complex, 3, 6> B;
    B.leftCols<3>() = (phase - 1.0) * Eigen::Matrix3cd::Identity();
    B.rightCols<3>() = (phase + 1.0) * cross_matrix(r * e).cast<Complex>();
    D += B.adjoint() * spring_matrix(bonds.of(group(d)), e).cast<Complex>() * B;
    if (group(d) == 1)
      D.bottomRightCorner<3, 3>() += std::norm(phase - 1.0) * turning_matrix(bonds, e).cast<Complex>();
  }
  const Eigen::Vector3cd q = swelling(beta);
  D.topLeftCorner<3, 3>() += cell * q.conjugate() * q.transpose();
  Eigen::Matrix<double, 6, 1> scale;
  scale << Eigen::Vector3d::Constant(1 / std::sqrt(lattice.mass)),
      Eigen::Vector3d::Constant(1 / std::sqrt(lattice.inertia));
  const Matrix6c A = scale.cast<Complex>().asDiagonal() * D * scale.cast<Complex>().asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Matrix6c>(A, Eigen::EigenvaluesOnly).eigenvalues()(5);
}

/// The bonds of a lattice far from its faces.
EndlessBond endless_bonds(const Lattice& lattice) {
  if (lattice.consistent()) return EndlessBond::from(lattice.material, lattice.radius());
  const ElasticBond alike = ElasticBond::from(lattice.material, lattice.radius());
  return {{}, alike, alike};
}

}  // namespace

double largest_frequency_squared(const Lattice& lattice) {
  const EndlessBond bonds = endless_bonds(lattice);
  const double cell = has_cells(lattice) ? endless_cell(lattice) : 0;
  // By cubic symmetry 0 ≤ β_x ≤ β_y ≤ β_z ≤ π is all there is. Published, for ν from −0.9 to ¼ and both
  // inertias, the largest lies at a corner of that (a grid of n = 40 finds nothing higher), so a coarse grid
  // holds it exactly. Consistent, it may lie between: n = 4 misses up to 0.3 % of ω², n = 16 a sixteenth of
  // that; 10⁻³ is added.
  const bool published = !lattice.consistent();
  const int n = published ? 4 : 16;
  double largest = 0;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= i; ++j)
      for (int k = 0; k <= j; ++k) {
        const Eigen::Vector3d beta = Eigen::Vector3d(k, j, i) * (M_PI / n);
        largest = std::max(largest, fastest(lattice, bonds, cell, beta));
      }
  return published ? largest : (1 + 1e-3) * largest + surface_excess(lattice);
}

Recovered recovered_constants(const Lattice& lattice) {
  const EndlessBond bonds = endless_bonds(lattice);
  const double r = lattice.radius(), volume = std::pow(lattice.grid.pitch, 3), cell = endless_cell(lattice);
  const auto energy_density = [&](const Eigen::Matrix3d& strain) {
    double energy = 0;
    for (int d = 9; d < 18; ++d) {
      const Eigen::Vector3d e(directions[d][0], directions[d][1], directions[d][2]);
      const Eigen::Vector3d relative = strain * (2 * r * e);
      energy += 0.5 * relative.dot(spring_matrix(bonds.of(group(d)), e) * relative);
    }
    const double q = 8 * r * strain.trace();  // of a cell
    return (energy + 0.5 * cell * q * q) / volume;
  };
  Eigen::Matrix3d xx = Eigen::Matrix3d::Zero(), yy = xx;
  xx(0, 0) = 1, yy(1, 1) = 1;
  const double c11 = 2 * energy_density(xx), c12 = energy_density(xx + yy) - c11;
  return {(c11 - c12) * (c11 + 2 * c12) / (c11 + c12), c12 / (c11 + c12)};
}

}  // namespace geist::de
