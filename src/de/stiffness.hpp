// The matrices of one bond, column by column from the kernel's own functions. For set-up code and tests.
#pragma once
#include <Eigen/Core>
#include <array>
#include <utility>

#include "de/elastic_bond.hpp"
#include "de/stencil.hpp"

namespace geist::de {

/// A bond from i to j: d = B_i (u_i, θ_i) + B_j (u_j, θ_j), force K d, energy ½ d·K d.
struct BondMatrices {
  Eigen::Matrix<double, 3, 6> B_i, B_j;
  Eigen::Matrix3d K;
};

namespace detail {

template <int D>
BondMatrices bond_matrices(const ElasticBond& law, double r) {
  BondMatrices m;
  const double none[6] = {};
  for (int c = 0; c < 6; ++c) {
    double unit[6] = {}, d[3];
    unit[c] = 1;
    relative_displacement<D>(unit, none, r, d);
    m.B_i.col(c) = Eigen::Vector3d(d[0], d[1], d[2]);
    relative_displacement<D>(none, unit, r, d);
    m.B_j.col(c) = Eigen::Vector3d(d[0], d[1], d[2]);
  }
  for (int c = 0; c < 3; ++c) {
    double d[3] = {}, f[3];
    d[c] = 1;
    law.force<directions[D][0], directions[D][1], directions[D][2]>(d, f);
    m.K.col(c) = Eigen::Vector3d(f[0], f[1], f[2]);
  }
  return m;
}

}  // namespace detail

/// By direction (model/lattice.hpp).
inline std::array<BondMatrices, 18> bond_matrices(const Lattice& lattice) {
  const ElasticBond law = ElasticBond::from(lattice.material, lattice.radius());
  return [&]<int... D>(std::integer_sequence<int, D...>) {
    return std::array<BondMatrices, 18>{detail::bond_matrices<D>(law, lattice.radius())...};
  }
  (std::make_integer_sequence<int, 18>{});
}

}  // namespace geist::de
