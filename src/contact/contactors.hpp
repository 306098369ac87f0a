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
#include "geometry/shapes.hpp"

namespace geist::contact {

/// A node of the mesh (lattice < 0) or a site.
struct Place {
  std::int32_t lattice;
  std::size_t index;
};

/// Places that lie side by side, by ascending index, and move with one field: u = field[index].
struct PlaceRange {
  std::int32_t lattice;  ///< < 0: nodes
  std::int32_t cluster;
  std::size_t begin, end;
};

/// Clusters are what moves more or less together: regions of hexahedra that share nodes, and lattices.
struct Places {
  std::vector<Place> list;
  std::vector<std::int32_t> cluster;  ///< by region
  std::vector<PlaceRange> ranges;
  std::vector<std::int32_t> index;  ///< by place: node or site
  Field<3> X;                       ///< reference positions
  Field<3> x;                       ///< present positions
  Field<3> x_searched;              ///< positions at the last search
  Field<3> inverse_mass;            ///< by component: 0 where a support holds it
  std::vector<Box> moved;           ///< by cluster: lowest and highest displacement since the last search

  /// Bring x and moved up to date; lattices are `ahead` later than their motion says.
  void follow(const Model& model, double ahead);

 private:
  /// The first place of a range whose index is not below i.
  std::size_t first_from(const PlaceRange& range, std::size_t i) const;
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
