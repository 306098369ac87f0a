// Contactors: the points that may touch something, and where they are.
//
// A place is a node of the surface or a particle that lacks bonds; places 0 .. surface.nodes.size() − 1 are
// the surface's nodes. A contactor is a place as part of a region: a node where two regions meet is one of
// each.
#pragma once
#include <cstdint>
#include <vector>

#include "contact/law.hpp"
#include "contact/surface.hpp"

namespace geist::contact {

/// A node of the mesh (lattice < 0) or a site.
struct Place {
  std::int32_t lattice;
  std::size_t index;
};

struct Places {
  std::vector<Place> list;
  Field<3> x;             ///< present positions
  Field<3> inverse_mass;  ///< by component: 0 where a support holds it
  Field<3> x_searched;    ///< positions at the last search

  /// Bring x up to date. Returns the largest squared distance from x_searched.
  double follow(const Model& model);
};

struct Contactor {
  std::int32_t place;
  std::int32_t region;  ///< hexahedra first, then lattices
  double radius;        ///< 0 for a node
  double area;          ///< of a node: a quarter of each facet of its region around it
  double depth;         ///< half of the thickness of the elements behind a node; a particle's radius
};

/// Nodes and particles of all regions that have a law with some region.
std::vector<Contactor> make_contactors(const Model& model, const Surface& surface, const LawTable& laws,
                                       Places& places);

}  // namespace geist::contact
