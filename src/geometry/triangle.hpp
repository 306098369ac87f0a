// The point of a triangle that is nearest to a given point.
#pragma once
#include <array>

#include "core/vec.hpp"

namespace geist {

/// Where on a triangle a point lies: in its inside, on an edge, or at a corner.
enum class Feature { face, edge_ab, edge_bc, edge_ca, corner_a, corner_b, corner_c };

struct NearestPoint {
  Vec3 p;
  std::array<double, 3> weight;  ///< p = weight[0] a + weight[1] b + weight[2] c; they add up to 1
  Feature feature;
};

/// The point of triangle (a, b, c) nearest to x. Source: Ericson, Real-Time Collision Detection
/// (2005), 5.1.5.
NearestPoint nearest_point(Vec3 x, Vec3 a, Vec3 b, Vec3 c);

}  // namespace geist
