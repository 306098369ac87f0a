// Solid shapes that regions are made of.
#pragma once
#include <algorithm>
#include <limits>
#include <variant>

#include "core/vec.hpp"

namespace geist {

/// Axis-parallel box.
struct Box {
  Vec3 low, high;
};
/// Solid cylinder between the centres of its end faces.
struct Cylinder {
  Vec3 from, to;
  double radius;
};
struct Ball {
  Vec3 centre;
  double radius;
};
using Shape = std::variant<Box, Cylinder, Ball>;

/// The box of nothing, to be widened.
inline Box nowhere() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}
/// Let the box hold the ball of radius `margin` around p.
inline void widen(Box& box, Vec3 p, double margin = 0) {
  for (int c = 0; c < 3; ++c)
    box.low[c] = std::min(box.low[c], p[c] - margin), box.high[c] = std::max(box.high[c], p[c] + margin);
}
inline void widen(Box& box, const Box& other) {
  for (int c = 0; c < 3; ++c)
    box.low[c] = std::min(box.low[c], other.low[c]), box.high[c] = std::max(box.high[c], other.high[c]);
}

/// Whether p lies in the closed shape, widened by `margin` (a length) on all sides.
inline bool contains(const Box& b, Vec3 p, double margin = 0) {
  for (int c = 0; c < 3; ++c)
    if (p[c] < b.low[c] - margin || p[c] > b.high[c] + margin) return false;
  return true;
}
inline bool contains(const Cylinder& s, Vec3 p, double margin = 0) {
  const Vec3 axis = s.to - s.from;
  const double length = norm(axis), along = dot(p - s.from, axis) / length;
  const double away = norm(p - s.from - (along / length) * axis);
  return along >= -margin && along <= length + margin && away <= s.radius + margin;
}
inline bool contains(const Ball& b, Vec3 p, double margin = 0) {
  return norm(p - b.centre) <= b.radius + margin;
}
inline bool contains(const Shape& shape, Vec3 p, double margin = 0) {
  return std::visit([&](const auto& s) { return contains(s, p, margin); }, shape);
}

}  // namespace geist
