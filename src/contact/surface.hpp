// Surface: the facets of hexahedra that may be touched, and how they hang together.
//
// A facet is taken as four triangles around its centre, the mean of its corners: so it is a continuous
// surface with exact nearest points even where the four corners do not lie in one plane. Triangle k has the
// corners k, k + 1 and the centre.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/field.hpp"
#include "model/model.hpp"

namespace geist::contact {

struct SurfaceFacet {
  std::array<std::int32_t, 4> corner;  ///< places in Surface::nodes, seen from outside counter-clockwise
  std::array<std::int32_t, 4> across;  ///< the facet that shares edge k (corners k, k + 1), or −1
  std::int32_t region;                 ///< of hexahedra
  std::int32_t body;                   ///< regions that share nodes are one body
  double area;                         ///< in the reference state
  double depth;                        ///< half of the element's thickness behind it, V / (2 A)
};

struct Surface {
  std::vector<SurfaceFacet> facets;
  std::vector<std::int32_t> nodes;  ///< of the mesh, ascending

  std::vector<double> node_area;  ///< by node: a quarter of each facet around it

  /// The facets around node place i, each as 4 · facet + corner: around[around_begin[i] .. around_begin[i +
  /// 1]).
  std::vector<std::int32_t> around_begin, around;
};

/// The exterior facets of the wanted regions of hexahedra (all, if none is named), but for those at an
/// interface: a particle of a coupled lattice touches them at rest.
Surface make_surface(const Model& model, const std::vector<std::uint8_t>& wanted = {});

/// The corners of a facet and its centre at the positions x of the surface's nodes.
struct FacetPoints {
  std::array<Vec3, 4> corner;
  Vec3 centre;
};
FacetPoints points_of(const SurfaceFacet& facet, const Field<3>& x);

/// Outward normal of triangle k, not normalised: its length is twice the area.
inline Vec3 triangle_normal(const FacetPoints& at, int k) {
  return cross(at.corner[(k + 1) % 4] - at.corner[k], at.centre - at.corner[k]);
}

/// Outward normal of a whole facet, not normalised.
inline Vec3 facet_normal(const FacetPoints& at) {
  return cross(at.corner[2] - at.corner[0], at.corner[3] - at.corner[1]);
}

/// Normal of the surface at a node: the mean of the triangles around it, weighted by the angle that they take
/// up there (Bærentzen and Aanæs 2005: it tells inside from outside). Not normalised.
Vec3 node_normal(const Surface& surface, const Field<3>& x, std::int32_t node);

/// What a node stands for of a region's surface, as a vector: a quarter of each facet around it, along its
/// normal. Facets keep their reference area.
Vec3 area_vector(const Surface& surface, const Field<3>& x, std::int32_t node, std::int32_t region);

}  // namespace geist::contact
