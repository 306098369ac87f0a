#include "solver/point_blocks.hpp"

#include <array>
#include <map>

#include "core/parallel.hpp"
#include "de/stiffness.hpp"
#include "fe/stiffness.hpp"
#include "solver/axes.hpp"

#include <Eigen/Eigenvalues>

namespace geist {
namespace {

/// Inverse of a symmetric matrix over its free rows and columns, and zero along what it does not resist.
template <int N>
Eigen::Matrix<double, N, N> inverse_over(Eigen::Matrix<double, N, N> A, int free) {
  for (int c = 0; c < N; ++c)
    if (!(free >> c & 1)) A.row(c).setZero(), A.col(c).setZero();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(A);
  const auto& values = solver.eigenvalues();
  const double least = 1e-10 * values(N - 1);
  Eigen::Matrix<double, N, 1> inverse;
  for (int c = 0; c < N; ++c) inverse(c) = values(c) > least ? 1 / values(c) : 0;
  return solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
}

/// y = A x for the first N of six components, the others zero.
template <int N>
void multiply(const Eigen::Matrix<double, N, N>& A, const double* x, double* y) {
  for (int c = 0; c < 6; ++c) y[c] = 0;
  for (int d = 0; d < N; ++d)
    for (int c = 0; c < N; ++c) y[c] = fma(A(c, d), x[d], y[c]);
}

/// y = R A Rᵀ x, R turning displacement and rotation alike.
void multiply_turned(const Eigen::Matrix<double, 6, 6>& A, const Eigen::Matrix3d& R, const double* x,
                     double* y) {
  using Two = Eigen::Matrix<double, 3, 2>;
  Eigen::Matrix<double, 6, 1> in, out;
  Eigen::Map<Two>(in.data()) = R.transpose().lazyProduct(Eigen::Map<const Two>(x));
  multiply<6>(A, in.data(), out.data());
  Eigen::Map<Two>{y} = R.lazyProduct(Eigen::Map<Two>(out.data()));
}

/// What the cells and skins around a site add to its stiffness: Σ k s_a s_aᵀ.
Eigen::Matrix3d dilatation_stiffness(const de::BondMatrices& bonds, const Lattice& lattice, std::size_t s) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int corner = 0; lattice.dilates() && corner < 8; ++corner) {
    const std::size_t lowest = s - de::to_corner(lattice.grid, corner);
    if (lowest >= lattice.dilating.size()) continue;
    de::visit_swellings(lattice, bonds.dilatation(), lowest, [&](const de::Swelling& w) {
      for (int a = 0; a < w.corners; ++a) {
        const Eigen::Vector3d n(w.s[a].x, w.s[a].y, w.s[a].z);
        if (w.site[a] == s) sum += w.k * n * n.transpose();
      }
    });
  }
  return sum;
}

/// Stiffness of a site's bonds, cells and skins against its own motion.
de::Matrix6 own_stiffness(const de::BondMatrices& bonds, const Lattice& lattice, std::size_t s) {
  de::Matrix6 K = de::Matrix6::Zero();
  for (int d = 0; d < 18; ++d)
    if (lattice.word[s] >> d & 1)
      K += bonds.strain(d).B_i.transpose() * bonds.stiffness(s, d) * bonds.strain(d).B_i;
  K.topLeftCorner<3, 3>() += dilatation_stiffness(bonds, lattice, s);
  return K;
}

}  // namespace

PointBlocks::PointBlocks(const Model& model, const Places& places)
    : places_(places.size()), of_place_(places.size()), nodes_(model.mesh.nodes(), Eigen::Matrix3d::Zero()) {
  add_elements(model, places);
  for (std::size_t l = 0; l < model.lattices.size(); ++l)
    add_lattice(model.lattices[l], static_cast<std::int32_t>(l), places);
  for_each(nodes_.size(), [this, &places](std::size_t i) {
    nodes_[i] = inverse_over<3>(nodes_[i], places[places.of_node(i)].free);
  });
}

void PointBlocks::add_elements(const Model& model, const Places& places) {
  const Mesh& mesh = model.mesh;
  for (std::size_t i = 0; i < mesh.nodes(); ++i) of_place_[places.of_node(i)] = static_cast<std::int32_t>(i);
  const auto add = [&](std::size_t e, const fe::Matrix24& K) {
    const Eigen::Matrix3d R = element_axes(mesh, e);
    for (int a = 0; a < 8; ++a)
      nodes_[mesh.elements[e][a]] += R * K.block<3, 3>(3 * a, 3 * a) * R.transpose();
  };
  fe::visit_stiffness(
      mesh, [](std::size_t) { return true; }, add);
}

void PointBlocks::add_lattice(const Lattice& lattice, std::int32_t l, const Places& places) {
  const de::BondMatrices bonds(lattice);
  std::map<std::array<std::uint32_t, 3>, std::int32_t> known;  // by bonds, law and freedom
  for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
    const std::int32_t k = places.of_site(l, s);
    if (k < 0) continue;
    const int free = places[k].free;
    const auto index = static_cast<std::int32_t>(sites_.size());
    const auto [it, is_new] = known.try_emplace(
        {lattice.word[s] & site::bonds, bonds.law_of(s), static_cast<std::uint32_t>(free)}, index);
    if (is_new) sites_.push_back(inverse_over<6>(own_stiffness(bonds, lattice, s), free));
    of_place_[k] = -1 - it->second;
    if (lattice.kinematics == Kinematics::finite)
      turn(static_cast<std::size_t>(k), free, bond_axes(lattice, s, s));
  }
  for (const Ghost& ghost : lattice.ghosts) {
    const Eigen::Matrix3d R = bond_axes(lattice, ghost.site, ghost.site),
                          K = R * own_stiffness(bonds, lattice, ghost.site).topLeftCorner<3, 3>() *
                              R.transpose();
    for (const GhostNode& I : ghost.nodes) nodes_[I.node] += I.N * I.N * K;
  }
}

/// Where a support holds some directions but not all, axes stay.
void PointBlocks::turn(std::size_t k, int free, const Eigen::Matrix3d& R) {
  if (axes_.empty()) axes_.assign(places_, Eigen::Matrix3d::Identity());
  const auto all_or_none = [](int three) { return three == 0b111 || three == 0; };
  if (all_or_none(free & 0b111) && all_or_none(free >> 3)) axes_[k] = R;
}

void PointBlocks::solve(const PlaceVector& r, PlaceVector& z) const {
  for_each(
      places_,
      [this, from = r.data(), to = z.data()](std::size_t k) {
        const std::int32_t i = of_place_[k];
        if (i >= 0)
          multiply<3>(nodes_[i], from + 6 * k, to + 6 * k);
        else if (axes_.empty())
          multiply<6>(sites_[-1 - i], from + 6 * k, to + 6 * k);
        else
          multiply_turned(sites_[-1 - i], axes_[k], from + 6 * k, to + 6 * k);
      },
      1000);
}

}  // namespace geist
