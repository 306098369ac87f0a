#include "coupling/balance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "core/parallel.hpp"
#include "geometry/hex8.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

namespace geist::coupling {
namespace {

constexpr std::size_t worth_threads = 1000;

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

/// A number for each of the three components, as they are solved for side by side.
using Three = double __attribute__((vector_size(4 * sizeof(double))));

Three three(double a, double b, double c) { return Three{a, b, c, 0}; }

/// Σ a_i².
Three squares_of(const std::vector<Three>& a) {
  Three sum{};
  for (const Three& b : a) sum += b * b;
  return sum;
}

/// Σ a_i² and Σ a_i w_i a_i.
std::pair<Three, Three> dots(const std::vector<Three>& a, const std::vector<double>& weight) {
  Three sum{}, weighted{};
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * a[i], weighted += a[i] * (weight[i] * a[i]);
  return {sum, weighted};
}

/// The matrix A of the equations Σ_e Σ_k γ_ka q_ek = R_a, in units of q that make Σ |q|²/V the sum of
/// squares: 8 × 4 numbers √V γ a carrier, in order of rows.
class Equations {
 public:
  Equations(const Mesh& mesh, const std::vector<std::int32_t>& carriers, Cuts& cuts) {
    std::map<std::int32_t, std::int32_t> row;
    for (const std::int32_t e : carriers) {
      const auto at = static_cast<std::size_t>(e);
      const Patterns scaled = std::sqrt(weight(mesh, e, cuts)) * patterns(hex8::corners(mesh, at));
      std::array<std::pair<std::int32_t, int>, 8> corners;
      for (int a = 0; a < 8; ++a) {
        const std::int32_t node = mesh.elements[at][a];
        const auto [it, is_new] = row.try_emplace(node, static_cast<std::int32_t>(nodes_.size()));
        if (is_new) nodes_.push_back(node);
        corners[a] = {it->second, a};
      }
      std::sort(corners.begin(), corners.end());
      Carrier& c = carriers_.emplace_back();
      for (int i = 0; i < 8; ++i) {
        c.row[i] = corners[i].first, c.corner[i] = corners[i].second;
        for (int k = 0; k < 4; ++k) c.scaled[k][i] = scaled(corners[i].second, k);
      }
    }
    list_by_row();
  }

  /// Nodes of the rows.
  const std::vector<std::int32_t>& nodes() const { return nodes_; }
  std::size_t columns() const { return 4 * carriers_.size(); }

  /// y = A q, row by row in order of columns.
  void multiply(const std::vector<Three>& q, std::vector<Three>& y) const {
    for_each(
        y.size(),
        [this, from = q.data(), to = y.data()](std::size_t r) {
          Three sum{};
          for (std::size_t p = begin_[r]; p < begin_[r + 1]; ++p) {
            const Carrier& c = carriers_[places_[p] / 8];
            const Three* const q_e = from + 4 * (places_[p] / 8);
            for (int k = 0; k < 4; ++k) sum += c.scaled[k][places_[p] % 8] * q_e[k];
          }
          to[r] = sum;
        },
        worth_threads);
  }
  /// q = Aᵀ y.
  void multiply_transposed(const std::vector<Three>& y, std::vector<Three>& q) const {
    for_each(
        carriers_.size(),
        [this, from = y.data(), to = q.data()](std::size_t e) {
          const Carrier& c = carriers_[e];
          for (int k = 0; k < 4; ++k) {
            Three sum{};
            for (int i = 0; i < 8; ++i) sum += c.scaled[k][i] * from[c.row[i]];
            to[4 * e + k] = sum;
          }
        },
        worth_threads);
  }
  /// 1 over the diagonal of Aᵀ A.
  std::vector<double> inverse_squares() const {
    std::vector<double> inverse;
    for (const Carrier& c : carriers_)
      for (int k = 0; k < 4; ++k) {
        double sum = 0;
        for (int i = 0; i < 8; ++i) sum += c.scaled[k][i] * c.scaled[k][i];
        inverse.push_back(sum > 0 ? 1 / sum : 1);
      }
    return inverse;
  }
  /// A D⁻¹ Aᵀ, below and on its diagonal, and `little` of an identity.
  Eigen::SparseMatrix<double> squared(const std::vector<double>& inverse, double little) const {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t e = 0; e < carriers_.size(); ++e)
      for (int i = 0; i < 8; ++i)
        for (int j = 0; j <= i; ++j) {
          double sum = 0;
          for (int k = 0; k < 4; ++k)
            sum += carriers_[e].scaled[k][i] * inverse[4 * e + k] * carriers_[e].scaled[k][j];
          entries.emplace_back(carriers_[e].row[i], carriers_[e].row[j], sum);
        }
    const auto m = static_cast<int>(nodes_.size());
    for (int r = 0; r < m; ++r) entries.emplace_back(r, r, little);
    Eigen::SparseMatrix<double> matrix(m, m);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }
  /// Σ_k √V γ_ka q_k at corner a of a carrier.
  std::array<Three, 8> at_corners(std::size_t carrier, const std::vector<Three>& q) const {
    const Carrier& c = carriers_[carrier];
    const Three* const q_e = q.data() + 4 * carrier;
    std::array<Three, 8> sum;
    for (int i = 0; i < 8; ++i)
      sum[c.corner[i]] = (c.scaled[0][i] * q_e[0] + c.scaled[1][i] * q_e[1]) +
                         (c.scaled[2][i] * q_e[2] + c.scaled[3][i] * q_e[3]);
    return sum;
  }

 private:
  struct Carrier {
    std::array<std::int32_t, 8> row;
    std::array<int, 8> corner;
    double scaled[4][8];
  };
  void list_by_row() {
    begin_.assign(nodes_.size() + 1, 0);
    for (const Carrier& c : carriers_)
      for (const std::int32_t r : c.row) ++begin_[r + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    places_.resize(8 * carriers_.size());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t e = 0; e < carriers_.size(); ++e)
      for (std::size_t i = 0; i < 8; ++i) places_[next[carriers_[e].row[i]]++] = 8 * e + i;
  }

  std::vector<Carrier> carriers_;
  std::vector<std::int32_t> nodes_;
  std::vector<std::size_t> begin_, places_;  ///< of row r: 8 · carrier + i, in order of carriers
};

constexpr double tolerance = 1e-12;

/// The solution of least norm, as conjugate gradients start from nothing; the nearest if there is none. All
/// three components take their own steps, until each is found; nothing, if one takes too many.
std::optional<std::vector<Three>> by_conjugate_gradients(const Equations& A, std::vector<Three> residual) {
  constexpr int most_steps = 100;
  const std::size_t m = residual.size(), n = A.columns();
  const std::vector<double> inverse = A.inverse_squares();
  std::vector<Three> x(n, Three{}), normal(n), p(n, Three{}), step(m);
  A.multiply_transposed(residual, normal);
  auto [squares, now] = dots(normal, inverse);
  const Three threshold = tolerance * tolerance * squares;
  auto open = squares > threshold;
  Three beta{};
  for (int i = 0; open[0] || open[1] || open[2]; ++i) {
    if (i == most_steps) return std::nullopt;
    for (std::size_t k = 0; k < n; ++k) p[k] = inverse[k] * normal[k] + beta * p[k];
    A.multiply(p, step);
    const Three alpha = open ? now / squares_of(step) : Three{};
    for (std::size_t k = 0; k < n; ++k) x[k] += alpha * p[k];
    for (std::size_t k = 0; k < m; ++k) residual[k] -= alpha * step[k];
    A.multiply_transposed(residual, normal);
    const Three before = now;
    std::tie(squares, now) = dots(normal, inverse);
    open &= squares >= threshold;
    beta = open ? now / before : Three{};
  }
  return x;
}

/// The same solution, q = D⁻¹ Aᵀ y with A D⁻¹ Aᵀ y = R and D the diagonal of Aᵀ A, by a Cholesky
/// factorisation. What no pattern stirs is held by a little on the diagonal; a few sweeps take its effect
/// out.
std::vector<Three> by_factorisation(const Equations& A, const std::vector<Three>& right) {
  constexpr double little = 1e-9;
  constexpr int most_sweeps = 20;
  const std::size_t m = right.size(), n = A.columns();
  const std::vector<double> inverse = A.inverse_squares();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(A.squared(inverse, little));
  std::vector<Three> x(n, Three{}), y(m, Three{}), residual = right, normal(n);
  A.multiply_transposed(residual, normal);
  const Three threshold = tolerance * tolerance * squares_of(normal);
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    Eigen::MatrixX3d open(m, 3);
    for (std::size_t r = 0; r < m; ++r) open.row(r) << residual[r][0], residual[r][1], residual[r][2];
    open = factors.solve(open).eval();
    for (std::size_t r = 0; r < m; ++r) y[r] += three(open(r, 0), open(r, 1), open(r, 2));
    A.multiply_transposed(y, x);
    for (std::size_t k = 0; k < n; ++k) x[k] *= inverse[k];
    A.multiply(x, residual);
    for (std::size_t r = 0; r < m; ++r) residual[r] = right[r] - residual[r];
    A.multiply_transposed(residual, normal);
    const auto found = squares_of(normal) <= threshold;
    if (found[0] && found[1] && found[2]) break;
  }
  return x;
}

/// Conjugate gradients take some tens of steps around a small interface and thousands around a long one,
/// which resists like a thin plate.
std::vector<Three> least_squares(const Equations& A, const std::vector<Three>& right) {
  if (auto x = by_conjugate_gradients(A, right)) return std::move(*x);
  return by_factorisation(A, right);
}

}  // namespace

void balance(const Mesh& mesh, const std::map<std::int32_t, Vec3>& defects, Cuts& cuts) {
  const std::vector<std::int32_t> carriers = carriers_of(mesh, defects, cuts);
  if (carriers.empty()) return;
  const Equations equations(mesh, carriers, cuts);
  std::vector<Three> right;
  for (const std::int32_t node : equations.nodes()) {
    const auto it = defects.find(node);
    right.push_back(it == defects.end() ? Three{} : three(it->second.x, it->second.y, it->second.z));
  }
  const std::vector<Three> q = least_squares(equations, right);
  for (std::size_t k = 0; k < carriers.size(); ++k) {
    const std::array<Three, 8> G = equations.at_corners(k, q);
    HexCut& cut = cuts.of(carriers[k]);
    for (int a = 0; a < 8; ++a) cut.gradient[a] += Vec3{G[a][0], G[a][1], G[a][2]};
  }
}

}  // namespace geist::coupling
