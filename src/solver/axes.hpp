// Axes that turn with elements and sites, for the preconditioner of the statics: where rotations are finite,
// the stiffness of the undeformed state, turned.
#pragma once
#include "fe/corotational.hpp"
#include "fe/stiffness.hpp"
#include "geometry/polar.hpp"
#include "solver/places.hpp"

namespace geist {

/// Rotation of the mean deformation of an element; 1 where rotations are small.
inline Eigen::Matrix3d element_axes(const Mesh& mesh, std::size_t e) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (mesh.kinematics == Kinematics::small) return R;
  fe::Corners<double> u;
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) u[a][i] = mesh.u[i][mesh.elements[e][a]];
  const fe::TurningAxes<double> axes(fe::local_corners(mesh, e), u);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) R(i, j) = axes.R[i][j];
  return R;
}

/// The mean rotation of two sites, which may be the same; 1 where rotations are small.
inline Eigen::Matrix3d bond_axes(const Lattice& lattice, std::size_t s, std::size_t t) {
  Eigen::Matrix3d mean = Eigen::Matrix3d::Identity();
  if (lattice.kinematics == Kinematics::small) return mean;
  double F[3][3], R[3][3];
  for (int c = 0; c < 3; ++c)
    for (int a = 0; a < 3; ++a)
      F[a][c] = 0.5 * (lattice.rotation[3 * c + a][s] + lattice.rotation[3 * c + a][t]) + (a == c ? 1 : 0);
  rotation_of(F, R);
  for (int c = 0; c < 3; ++c)
    for (int a = 0; a < 3; ++a) mean(a, c) = R[a][c];
  return mean;
}

/// Where a place is: of finite rotations, now.
inline Vec3 position(const Model& model, const Place& place) {
  if (place.lattice < 0)
    return model.mesh.kinematics == Kinematics::small ? place.X : place.X + model.mesh.u.vector(place.index);
  const Lattice& lattice = model.lattices[place.lattice];
  return lattice.kinematics == Kinematics::small ? place.X : place.X + lattice.motion.vector(place.index);
}

}  // namespace geist
