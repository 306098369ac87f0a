// What the tests of elements share: elements of several shapes, meshes of a box, literal reference matrices.
// Include it before any header of Eigen, as fe/stiffness.hpp sets how Eigen computes.
#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>

#include "fe/elements.hpp"
#include "fe/formulations.hpp"
#include "fe/parameters.hpp"
#include "fe/stiffness.hpp"
#include "geometry/hex8.hpp"

#include <Eigen/SparseCholesky>

namespace geist::fe::testing {

/// The formulations as a list of types for typed tests, and their names there.
template <class List>
struct AsTypes;
template <class... F>
struct AsTypes<FormulationList<F...>> {
  using type = ::testing::Types<F...>;
};
using EveryFormulation = AsTypes<Formulations>::type;

struct FormulationName {
  template <class F>
  static std::string GetName(int) {
    std::string name(F::name);
    for (char& c : name)
      if (c == '-') c = '_';
    return name;
  }
};

inline constexpr Parameters steel_like{1.7, 1.1, 2.3, 0.05};

/// A formulation whose kernels are compiled once, and not into every place of use: what the tests call.
template <class F>
struct Outlined {
  F law{steel_like};

  template <class T>
  [[gnu::noinline]] T forces(const Corners<T>& X, const Corners<T>& u, const Corners<T>& v,
                             Corners<T>& f) const {
    return law.forces(X, u, v, f);
  }
  template <class T>
  [[gnu::noinline]] Stored<T> energy(const Corners<T>& X, const Corners<T>& u) const {
    return law.energy(X, u);
  }
  static constexpr bool uses_velocity = F::uses_velocity;
};

inline Corners<double> to_array(const hex8::Corners& x) {
  Corners<double> X;
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) X[a][i] = x[a][i];
  return X;
}

/// A parallelepiped: a brick 1 × 0.7 × 1.2 sheared.
inline hex8::Corners parallelepiped() {
  hex8::Corners x;
  for (int a = 0; a < 8; ++a) {
    const Vec3 s = hex8::corner_xi[a];
    x[a] = {0.5 * s.x + 0.2 * s.y + 0.1 * s.z, 0.35 * s.y - 0.1 * s.z, 0.6 * s.z + 0.05 * s.x};
  }
  return x;
}

/// That with every corner moved at random, off the origin.
inline hex8::Corners distorted(int seed, double amount = 0.12) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-amount, amount);
  hex8::Corners x = parallelepiped();
  for (Vec3& p : x) p += Vec3{2 + shift(random), -1 + shift(random), shift(random)};
  return x;
}

inline Corners<double> random_field(int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  Corners<double> u;
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) u[a][i] = value(random);
  return u;
}

/// u = L x at the corners.
inline Corners<double> linear_field(const hex8::Corners& x, const Mat3& L) {
  Corners<double> u;
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) u[a][i] = dot(L[i], x[a]);
  return u;
}

/// λ tr ε 1 + 2 μ ε by the book.
inline Mat3 stress(const Mat3& L, double lambda, double mu) {
  Mat3 s{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) s[i][j] = mu * (L[i][j] + L[j][i]);
    s[i][i] += lambda * (L[0][0] + L[1][1] + L[2][2]);
  }
  return s;
}

/// A box of n hexahedra with corner at the origin; `place` moves its nodes.
inline Mesh box(
    std::array<int, 3> n, Vec3 size, const std::string& formulation, const Material& material,
    const std::function<Vec3(Vec3)>& place = [](Vec3 p) { return p; }) {
  Mesh mesh;
  const auto node = [&](int i, int j, int k) { return (k * (n[1] + 1) + j) * (n[0] + 1) + i; };
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i)
        mesh.points.push_back(place({size.x * i / n[0], size.y * j / n[1], size.z * k / n[2]}));
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        mesh.elements.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
                                 node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
                                 node(i, j + 1, k + 1)});
  HexRegion region;
  region.name = "box", region.material = material, region.formulation = formulation;
  region.hourglass_coefficient = 0.05, region.count = mesh.elements.size();
  mesh.regions.push_back(region);
  finish(mesh);
  return mesh;
}

/// Moves nodes inside the unit cube by up to `amount`, those on its surface not at all.
inline std::function<Vec3(Vec3)> scatter_inside(double amount) {
  return [amount](Vec3 p) {
    const double bubble = p.x * (1 - p.x) * p.y * (1 - p.y) * p.z * (1 - p.z) > 1e-12 ? amount : 0;
    return p + bubble * Vec3{std::sin(31 * p.x + 17 * p.y + 5 * p.z), std::sin(13 * p.x + 29 * p.y + 7 * p.z),
                             std::sin(3 * p.x + 11 * p.y + 37 * p.z)};
  };
}

/// Literal matrices: B-matrices at Gauss points, by the book. B_a = ∂N_a/∂x, 6 × 24.
using MatrixB = Eigen::Matrix<double, 6, 24>;

inline MatrixB strain_matrix(const std::array<Vec3, 8>& g) {
  MatrixB B = MatrixB::Zero();
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      B(i, 3 * a + i) = g[a][i];
      B(3 + i, 3 * a + i) = g[a][j];  // γ_ij
      B(3 + i, 3 * a + j) = g[a][i];
    }
  return B;
}

inline Eigen::Matrix<double, 6, 6> elasticity(double lambda, double mu) {
  Eigen::Matrix<double, 6, 6> D = Eigen::Matrix<double, 6, 6>::Zero();
  D.topLeftCorner<3, 3>().setConstant(lambda);
  for (int i = 0; i < 6; ++i) D(i, i) += i < 3 ? 2 * mu : mu;
  return D;
}

inline Matrix24 gauss_stiffness(const hex8::Corners& x, double lambda, double mu) {
  Matrix24 K = Matrix24::Zero();
  for (Vec3 s : hex8::corner_xi) {
    const MatrixB B = strain_matrix(hex8::position_gradient(x, hex8::gauss * s));
    K += B.transpose() * elasticity(lambda, mu) * B * det(hex8::jacobian(x, hex8::gauss * s));
  }
  return K;
}

/// (1/V) ∫ ∂N_a/∂x dV.
inline std::array<Vec3, 8> mean_position_gradient(const hex8::Corners& x) {
  std::array<Vec3, 8> mean{};
  for (Vec3 s : hex8::corner_xi) {
    const auto g = hex8::position_gradient(x, hex8::gauss * s);
    for (int a = 0; a < 8; ++a) mean[a] += det(hex8::jacobian(x, hex8::gauss * s)) / hex8::volume(x) * g[a];
  }
  return mean;
}

inline Matrix24 mean_stiffness(const hex8::Corners& x, double lambda, double mu) {
  const MatrixB B = strain_matrix(mean_position_gradient(x));
  return B.transpose() * elasticity(lambda, mu) * B * hex8::volume(x);
}

/// Σ_k γ_k γ_kᵀ/8 for each component, γ_ka = Γ_ka − (Γ_k · x) · b_a, with Γ written out as in Flanagan &
/// Belytschko.
inline Matrix24 hourglass_patterns(const hex8::Corners& x) {
  constexpr double pattern[4][8] = {{1, 1, -1, -1, -1, -1, 1, 1},   // ηζ
                                    {1, -1, -1, 1, -1, 1, 1, -1},   // ζξ
                                    {1, -1, 1, -1, 1, -1, 1, -1},   // ξη
                                    {-1, 1, -1, 1, 1, -1, 1, -1}};  // ξηζ
  const auto b = mean_position_gradient(x);
  Matrix24 P = Matrix24::Zero();
  for (const auto& h : pattern) {
    Vec3 moment;
    for (int a = 0; a < 8; ++a) moment += h[a] * x[a];
    for (int p = 0; p < 8; ++p)
      for (int q = 0; q < 8; ++q)
        for (int i = 0; i < 3; ++i)
          P(3 * p + i, 3 * q + i) += (h[p] - dot(moment, b[p])) * (h[q] - dot(moment, b[q])) / 8;
  }
  return P;
}

/// Σ_a B_a·B_a with B_a = V b_a.
inline double square_of_gradient(const hex8::Corners& x) {
  double s = 0;
  for (Vec3 b : mean_position_gradient(x)) s += dot(b, b);
  return s * hex8::volume(x) * hex8::volume(x);
}

/// K of a mesh, with 1 on the diagonal for nodes that are not free.
inline Eigen::SparseMatrix<double> stiffness_with_held(const Mesh& mesh, const std::vector<int>& free) {
  const HexRegion& region = mesh.regions[0];
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    Matrix24 K;
    visit_formulation(region.formulation, parameters(region),
                      [&](auto law) { K = stiffness_matrix(law, to_array(hex8::corners(mesh, e))); });
    const auto& nodes = mesh.elements[e];
    for (int p = 0; p < 24; ++p)
      for (int q = 0; q < 24; ++q)
        if (free[nodes[p / 3]] && free[nodes[q / 3]])
          entries.emplace_back(3 * nodes[p / 3] + p % 3, 3 * nodes[q / 3] + q % 3, K(p, q));
  }
  const int count = static_cast<int>(mesh.nodes());
  for (int i = 0; i < 3 * count; ++i)
    if (!free[i / 3]) entries.emplace_back(i, i, 1.0);
  Eigen::SparseMatrix<double> A(3 * count, 3 * count);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// Its deflection under a unit force in direction d, spread by tributary area over an end face of equal
/// facets: the mean over that face, weighted alike.
inline double tip_deflection(const Mesh& mesh, int d) {
  Vec3 low = mesh.points[0], high = low;
  for (const Vec3 X : mesh.points)
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], X[i]), high[i] = std::max(high[i], X[i]);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(mesh.nodes()));
  std::vector<int> free(mesh.nodes(), 1);
  for (std::size_t n = 0; n < mesh.nodes(); ++n) {
    const Vec3 X = mesh.points[n];
    if (X.x == 0) free[n] = 0;
    const bool side = X.y == low.y || X.y == high.y, top = X.z == low.z || X.z == high.z;
    if (X.x == high.x) load(3 * static_cast<Eigen::Index>(n) + d) = (side ? 0.5 : 1) * (top ? 0.5 : 1);
  }
  load /= load.sum();
  const Eigen::SparseMatrix<double> K = stiffness_with_held(mesh, free);
  return load.dot(Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(K).solve(load));
}

}  // namespace geist::fe::testing
