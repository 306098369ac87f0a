// The surface of a mesh.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "model/mesh.hpp"

namespace geist {

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
