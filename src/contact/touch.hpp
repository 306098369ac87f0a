// Touch: where a contactor overlaps a body. The points of the surface whose distance is a local minimum are
// found here; what they add up to is the shortest way out (way_out.hpp).
#pragma once
#include <cstdint>
#include <span>

#include "contact/surface.hpp"
#include "contact/way_out.hpp"

namespace geist::contact {

/// A contactor as geometry.
struct Probing {
  Vec3 x;             ///< its centre
  double radius;      ///< 0 for a node
  double reach;       ///< depth behind the surface at which it is still taken to have come in from this side
  std::int32_t node;  ///< its own place in Surface::nodes, or −1: facets around it are left out
  Vec3 outward;       ///< a node's own surface normal, of any length: it touches only what faces it
};

/// A triangle faces a node if the cosine between their outward normals is less than this. So the corner of a
/// cube touches a plane (−0.58), and a node beside an edge does not touch the flank around that edge (0, and
/// noise).
inline constexpr double facing = -0.2;

/// Whether the contactor is within reach of the plane of any of the facets' triangles: a quick no. Its
/// outward normal need not be known.
bool may_touch(const Surface& surface, const Field<3>& x, std::span<const std::int32_t> facets,
               const Probing& probe);

/// Touch of a contactor and the given facets of one body; x: positions of the surface's nodes.
Touch touch(const Surface& surface, const Field<3>& x, std::span<const std::int32_t> facets,
            const Probing& probe);

}  // namespace geist::contact
