// A convex polyhedron: a box cut by planes, and points to integrate over it.
#pragma once
#include <array>
#include <vector>

#include "core/vec.hpp"
#include "geometry/shapes.hpp"

namespace geist {

/// The half-space n·x ≤ offset; n of unit length.
struct HalfSpace {
  Vec3 n;
  double offset;
};

/// A point of a quadrature rule: position and weight (a volume or an area).
struct WeightedPoint {
  Vec3 x;
  double weight;
};

class ConvexPolyhedron {
 public:
  explicit ConvexPolyhedron(const Box& box);

  /// Keep what lies in the half-space; what is thinner than `tolerance` (a length) is let pass.
  void cut(const HalfSpace& half, double tolerance);

  bool empty() const { return faces_.empty(); }

  /// Points and weights that integrate polynomials of second degree exactly: four in each tetrahedron between
  /// a point inside and a triangle of a face (Hammer & Stroud, MTAC 10 (1956) 137–139).
  std::vector<WeightedPoint> quadrature() const;

 private:
  std::vector<std::vector<Vec3>> faces_;  ///< corners in turn
};

/// What of a convex polygon lies in the half-space; what is within `tolerance` of the plane counts as inside.
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const HalfSpace& half, double tolerance);

/// Points and weights (areas) that integrate polynomials of second degree over a convex polygon exactly.
std::vector<WeightedPoint> quadrature(const std::vector<Vec3>& polygon);

/// The 2 × 2 × 2 Gauss points of a box: exact for the third degree in each coordinate.
std::array<WeightedPoint, 8> quadrature(const Box& box);

}  // namespace geist
