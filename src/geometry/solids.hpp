// Solid bodies cut into hexahedra.
//
// A block is the trilinear image of a cube. A ball and a cylinder are O-grids: a core block whose faces
// bulge, and shells around it out to the curved surface, so that no element is degenerate (a sphere or a
// circle that is the image of a block has flat elements where the block has edges).
#pragma once
#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "geometry/grading.hpp"
#include "geometry/shapes.hpp"

namespace geist {

struct BlockBody {
  std::array<Vec3, 8> corners;  ///< in the order of model/mesh.hpp
  std::array<int, 3> divisions;
};
/// core × core × core elements in the middle, and `shells` elements from there to the surface.
struct BallBody {
  Ball shape;
  int core, shells;
};
/// core × core elements in the middle of each of `layers` layers, and `shells` elements from there to the
/// surface.
struct CylinderBody {
  Cylinder shape;
  int core, shells, layers;
};
using Body = std::variant<BlockBody, BallBody, CylinderBody>;

/// Gradings along a body's own directions. Of a ball and a cylinder's disc x, y (and z) are those of the
/// core, and `radius` of the shells, low at the core; along the axis of a cylinder is z.
struct Gradings {
  std::array<Grading, 3> axis{};
  Grading radius{};
};

/// Elements with nodes of their own.
struct Hexahedra {
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 8>> elements;  ///< in the order of model/mesh.hpp
  double spacing;                                     ///< length of an element, roughly
};

/// Corners of an axis-parallel box in the order of model/mesh.hpp.
std::array<Vec3, 8> corners_of(const Box& box);

/// Number of its elements.
double element_count(const Body& body);

/// Its elements. A ball, and what is symmetric about the planes through its centre, is so to the last bit
/// where the centre is the origin; its surface nodes are at the radius, and those planes are faces of
/// elements where `core` is even and the grading symmetric. The same goes for a cylinder. Across the axis, x
/// and y are the coordinate axes that follow the axis's own in the order x, y, z, x, y, projected if it is
/// slanted.
Hexahedra mesh_of(const Body& body, const Gradings& gradings = {});

}  // namespace geist
