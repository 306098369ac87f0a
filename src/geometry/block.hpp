// Appending bodies to a mesh.
#pragma once
#include <array>
#include <vector>

#include "geometry/facets.hpp"
#include "geometry/solids.hpp"
#include "model/mesh.hpp"

namespace geist {

/// Append a region: the elements of a body but for those that lie in one of `minus`. Nodes that coincide with
/// nodes of earlier regions are shared. region.first and .count are set. Throws std::invalid_argument if an
/// element is turned inside out or none is left, or if a box of `minus` cuts through an element.
void append(Mesh& mesh, HexRegion region, const Hexahedra& body, const std::vector<Box>& minus = {});

/// The same for the trilinear image of a cube with these corners, cut into divisions[0] × [1] × [2] elements.
void append_block(Mesh& mesh, HexRegion region, const std::array<Vec3, 8>& corners,
                  const std::array<int, 3>& divisions, const std::vector<Box>& minus = {});

}  // namespace geist
