// The matrices of bonds, column by column from the kernel's own functions. For set-up code and tests.
#pragma once
#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "de/dilatation.hpp"
#include "de/elastic_bond.hpp"
#include "de/stencil.hpp"

namespace geist::de {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// K of a bond along the step e, in the lattice's axes.
inline Eigen::Matrix3d spring_matrix(double shear, double along, const Eigen::Vector3d& e) {
  return shear * Eigen::Matrix3d::Identity() + along * e * e.transpose();
}
inline Eigen::Matrix3d spring_matrix(const ElasticBond& law, const Eigen::Vector3d& e) {
  return spring_matrix(law.k_s, (law.k_n - law.k_s) / e.squaredNorm(), e);
}

/// Stiffness of a bond along e, of group 1, against relative rotation.
inline Eigen::Matrix3d turning_matrix(const Bending& law, const Eigen::Vector3d& e) {
  const Eigen::Matrix3d along = e * e.transpose(), across = Eigen::Matrix3d::Identity() - along;
  return law.k_b * across + law.k_t * along;
}

/// a as a matrix: [a]× v = a × v.
inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// How a bond is strained: (d, θ_j − θ_i) = B_i (u_i, θ_i) + B_j (u_j, θ_j).
struct BondStrain {
  Matrix6 B_i, B_j;
};

namespace detail {

template <int D>
BondStrain bond_strain(double r) {
  BondStrain m{Matrix6::Zero(), Matrix6::Zero()};
  const double none[6] = {};
  for (int c = 0; c < 6; ++c) {
    double unit[6] = {}, d[3];
    unit[c] = 1;
    relative_displacement<D>(unit, none, r, d);
    m.B_i.col(c).head<3>() = Eigen::Vector3d(d[0], d[1], d[2]);
    relative_displacement<D>(none, unit, r, d);
    m.B_j.col(c).head<3>() = Eigen::Vector3d(d[0], d[1], d[2]);
  }
  m.B_i.bottomRightCorner<3, 3>() = -Eigen::Matrix3d::Identity();
  m.B_j.bottomRightCorner<3, 3>() = Eigen::Matrix3d::Identity();
  return m;
}

template <int D, class Law>
Matrix6 bond_stiffness(const Law& law, double r) {
  Matrix6 K = Matrix6::Zero();
  for (int c = 0; c < 3; ++c) {
    double d[3] = {}, f[3];
    d[c] = 1;
    bond_force<D>(law, d, f);
    K.col(c).head<3>() = Eigen::Vector3d(f[0], f[1], f[2]);
    if constexpr (Law::bends && group(D) == 1) K(3 + c, 3 + c) = r * law.template turn<D>(c);
  }
  return K;
}

template <class Law>
std::array<Matrix6, 18> stiffnesses(const Law& law, double r) {
  return [&]<int... D>(std::integer_sequence<int, D...>) {
    return std::array<Matrix6, 18>{bond_stiffness<D>(law, r)...};
  }
  (std::make_integer_sequence<int, 18>{});
}

}  // namespace detail

/// Strains and stiffnesses of a lattice's bonds, by direction (model/lattice.hpp): the energy of a bond is
/// ½ s·K s, s its strain.
class BondMatrices {
 public:
  explicit BondMatrices(const Lattice& lattice) : lattice_(lattice) {
    const double r = lattice.radius();
    strains_ = [&]<int... D>(std::integer_sequence<int, D...>) {
      return std::array<BondStrain, 18>{detail::bond_strain<D>(r)...};
    }
    (std::make_integer_sequence<int, 18>{});
    const Bending bending = Bending::from(lattice.material, r);
    for (std::uint32_t c = 0; c < lattice.classes.size(); ++c)
      stiffnesses_.push_back(detail::stiffnesses(ClassBonds<double>(bending, lattice.classes.data(), &c), r));
    if (lattice.dilates()) dilatation_ = Dilatation::from(lattice.material, r);
    if (stiffnesses_.empty())
      stiffnesses_.push_back(detail::stiffnesses(ElasticBond::from(lattice.material, r), r));
  }

  const BondStrain& strain(int d) const { return strains_[static_cast<std::size_t>(d)]; }
  const Matrix6& stiffness(std::size_t site, int d) const {
    return stiffnesses_[law_of(site)][static_cast<std::size_t>(d)];
  }
  /// Of cells and skins.
  const Dilatation& dilatation() const { return dilatation_; }
  /// Sites with the same law have the same stiffnesses.
  std::uint32_t law_of(std::size_t site) const { return lattice_.consistent() ? lattice_.class_of[site] : 0; }

 private:
  const Lattice& lattice_;
  std::array<BondStrain, 18> strains_;
  Dilatation dilatation_;
  std::vector<std::array<Matrix6, 18>> stiffnesses_;
};

}  // namespace geist::de
