// Structured blocks of hexahedra.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "geometry/shapes.hpp"
#include "model/mesh.hpp"

namespace geist {

/// Corners of an axis-parallel box in the order of model/mesh.hpp.
std::array<Vec3, 8> corners_of(const Box& box);

/// Append a region: the trilinear image of a cube with these corners, cut into divisions[0] × [1] × [2]
/// elements, of which those whose centre lies in one of `minus` are left out. Nodes that coincide with nodes
/// of earlier regions (within `merge_distance`) are shared. region.first and .count are set. Throws
/// std::invalid_argument if an element is turned inside out or none is left, or if a box of `minus` cuts
/// through an element.
void append_block(Mesh& mesh, HexRegion region, const std::array<Vec3, 8>& corners,
                  const std::array<int, 3>& divisions, const std::vector<Box>& minus = {});

/// A facet of one element that no other element shares.
struct Facet {
  std::int32_t element;
  std::array<std::int32_t, 4> node;  ///< seen from outside counter-clockwise
};

/// All facets that belong to one element only, in order of elements.
std::vector<Facet> exterior_facets(const Mesh& mesh);

/// ∫ N_I dA over a facet for its four nodes (2 × 2 Gauss): the tributary areas.
std::array<double, 4> tributary_areas(const Mesh& mesh, const Facet& facet);

}  // namespace geist
