// Point blocks: every place's own stiffness, inverted. The local part of the statics' preconditioner. With
// finite rotations it is turned as the body is (axes.hpp).
#pragma once
#include <Eigen/Core>
#include <vector>

#include "solver/places.hpp"

namespace geist {

class PointBlocks {
 public:
  PointBlocks(const Model& model, const Places& places);

  /// z = D⁻¹ r, zero in what is not free. Motions that no stiffness resists stay zero too.
  void solve(const PlaceVector& r, PlaceVector& z) const;

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  void add_elements(const Model& model, const Places& places);
  void add_lattice(const Lattice& lattice, std::int32_t l, const Places& places);
  void turn(std::size_t k, int free, const Eigen::Matrix3d& R);

  std::size_t places_;
  std::vector<std::int32_t> of_place_;  ///< index into nodes_, or −1 − index into sites_
  std::vector<Eigen::Matrix3d> nodes_;
  std::vector<Matrix6> sites_;  ///< sites with the same bonds and supports share one, in their own axes
  std::vector<Eigen::Matrix3d> axes_;  ///< of places, where sites turn
};

}  // namespace geist
