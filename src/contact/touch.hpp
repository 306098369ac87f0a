// Touch: where a contactor overlaps a body, as geometry.
//
// The overlap is the shortest way out. Every point of the surface whose distance is a local minimum gives a
// half-space n·d ≥ δ of displacements d that lead clear of it; the overlap vector is the smallest d in all of
// them, d = Σ λ_i n_i with λ_i ≥ 0. It is the gradient of half its own square, so a force along d is
// conservative; it changes continuously when points appear, merge on a flat or shallow patch (λ_1 + λ_2 = δ,
// not 2 δ), or turn around an edge or a corner; in a groove both flanks push.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "contact/surface.hpp"

namespace geist::contact {

/// A point of the surface that carries a part of a contact.
struct TouchPoint {
  std::int32_t facet;
  std::array<double, 4> weight;  ///< of the facet's corners; they add up to 1
  Vec3 p;                        ///< on the surface
  Vec3 n;                        ///< unit normal, out of the body
  double overlap;                ///< δ_i
  double lambda;                 ///< λ_i
};

struct Touch {
  int count = 0;  ///< 0: no contact; at most three points carry
  std::array<TouchPoint, 3> point;
  double overlap = 0;  ///< |d|
  Vec3 normal;         ///< d / |d|, from the body to the contactor

  double lambda_sum() const;
};

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

/// Choose the λ of up to n half-spaces and leave in `touch` the points that carry (λ > 0). Opposed
/// half-spaces that leave no way out all push by themselves.
Touch shortest_way_out(std::span<const TouchPoint> points);

}  // namespace geist::contact
