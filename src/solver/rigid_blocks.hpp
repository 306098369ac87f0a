// Rigid blocks: the coarse part of the statics' preconditioner. Every block of places moves as a rigid body,
// and what lies between the blocks resists: a small stiffness matrix, factorised once. With finite rotations
// blocks are where they are now, and what lies between them is turned (axes.hpp).
#pragma once
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "solver/places.hpp"

namespace geist {

class RigidBlocks {
 public:
  RigidBlocks(const Model& model, const Places& places);

  /// z += P A⁻¹ Pᵀ r, P from the blocks' motions to the free components, A = Pᵀ K P.
  void add_solution(const PlaceVector& r, PlaceVector& z) const;

 private:
  void restrict_to_blocks(const PlaceVector& r, Eigen::VectorXd& b) const;
  void add_motion(const Eigen::VectorXd& motion, PlaceVector& z) const;

  const Places& places_;
  std::vector<Vec3> arm_;  ///< of each place, from its block's centre, about which the block rotates
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> cholesky_;
};

}  // namespace geist
