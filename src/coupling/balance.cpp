#include "coupling/balance.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/hex8.hpp"

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>

namespace geist::coupling {
namespace {

using Patterns = Eigen::Matrix<double, 8, 4>;

/// Four orthonormal patterns on an element's corners that no linear field stirs.
Patterns patterns(const hex8::Corners& x) {
  const hex8::Corners& s = hex8::corner_xi;
  Eigen::Matrix<double, 8, 8> basis;
  for (int a = 0; a < 8; ++a)
    basis.row(a) << 1, x[a].x - x[0].x, x[a].y - x[0].y, x[a].z - x[0].z, s[a].y * s[a].z, s[a].z * s[a].x,
        s[a].x * s[a].y, s[a].x * s[a].y * s[a].z;
  for (int k = 0; k < 8; ++k) {
    for (int pass = 0; pass < 2; ++pass)
      for (int m = 0; m < k; ++m) basis.col(k) -= basis.col(m).dot(basis.col(k)) * basis.col(m);
    basis.col(k) /= basis.col(k).norm();
  }
  return basis.rightCols<4>();
}

/// Elements that take part in the correction: those with a node at which the pulls differ by more than
/// rounding, and the cut ones, which lead from one corner of an interface to the next; none if the pulls
/// agree.
std::vector<std::int32_t> carriers_of(const Mesh& mesh, const std::map<std::int32_t, Vec3>& defects,
                                      const Cuts& cuts) {
  std::vector<std::int32_t> carriers;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto differ = [&](std::int32_t node) {
      const auto it = defects.find(node);
      return it != defects.end() &&
             norm(it->second) > 1e-8 * std::cbrt(std::pow(hex8::volume(hex8::corners(mesh, e)), 2));
    };
    if (std::any_of(mesh.elements[e].begin(), mesh.elements[e].end(), differ))
      carriers.push_back(static_cast<std::int32_t>(e));
  }
  if (carriers.empty()) return carriers;
  const std::vector<std::int32_t> cut = cuts.elements();
  carriers.insert(carriers.end(), cut.begin(), cut.end());
  std::sort(carriers.begin(), carriers.end());
  carriers.erase(std::unique(carriers.begin(), carriers.end()), carriers.end());
  return carriers;
}

/// What of an element's volume carries a correction: one that is almost gone would answer it with much
/// strain.
double weight(const Mesh& mesh, std::int32_t e, Cuts& cuts) {
  const double all = hex8::volume(hex8::corners(mesh, static_cast<std::size_t>(e)));
  return std::max(0.0, cuts.of(e).volume - 1e-3 * all);
}

/// The equations Σ_e Σ_k γ_ka q_ek = R_a, in units of q that make Σ |q|²/V the sum of squares.
struct Equations {
  std::map<std::int32_t, int> row;     ///< by node
  std::vector<Patterns> scaled;        ///< √V γ, by carrier
  Eigen::SparseMatrix<double> matrix;  ///< four columns a carrier
  Eigen::MatrixX3d right;

  Equations(const Mesh& mesh, const std::vector<std::int32_t>& carriers,
            const std::map<std::int32_t, Vec3>& defects, Cuts& cuts) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const std::int32_t e : carriers) {
      const auto at = static_cast<std::size_t>(e);
      const int column = static_cast<int>(4 * scaled.size());
      scaled.push_back(std::sqrt(weight(mesh, e, cuts)) * patterns(hex8::corners(mesh, at)));
      for (int a = 0; a < 8; ++a) {
        const int i = row.try_emplace(mesh.elements[at][a], static_cast<int>(row.size())).first->second;
        for (int p = 0; p < 4; ++p) entries.emplace_back(i, column + p, scaled.back()(a, p));
      }
    }
    matrix.resize(static_cast<Eigen::Index>(row.size()), static_cast<Eigen::Index>(4 * carriers.size()));
    matrix.setFromTriplets(entries.begin(), entries.end());
    right = Eigen::MatrixX3d::Zero(matrix.rows(), 3);
    for (const auto& [node, defect] : defects)
      if (const auto it = row.find(node); it != row.end())
        right.row(it->second) << defect.x, defect.y, defect.z;
  }

  /// The solution of least norm, as conjugate gradients start from nothing; the nearest if there is none.
  Eigen::MatrixX3d solution() const {
    Eigen::LeastSquaresConjugateGradient<Eigen::SparseMatrix<double>> solver(matrix);
    solver.setTolerance(1e-12);
    solver.setMaxIterations(2000);
    return solver.solve(right);
  }
};

}  // namespace

void balance(const Mesh& mesh, const std::map<std::int32_t, Vec3>& defects, Cuts& cuts) {
  const std::vector<std::int32_t> carriers = carriers_of(mesh, defects, cuts);
  if (carriers.empty()) return;
  const Equations equations(mesh, carriers, defects, cuts);
  const Eigen::MatrixX3d q = equations.solution();
  for (std::size_t k = 0; k < carriers.size(); ++k) {
    const Eigen::Matrix<double, 8, 3> G =
        equations.scaled[k] * q.middleRows<4>(static_cast<Eigen::Index>(4 * k));
    HexCut& cut = cuts.of(carriers[k]);
    for (int a = 0; a < 8; ++a) cut.gradient[a] += Vec3{G(a, 0), G(a, 1), G(a, 2)};
  }
}

}  // namespace geist::coupling
