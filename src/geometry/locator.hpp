// Locator: which hexahedron holds a point.
#pragma once
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "geometry/shapes.hpp"
#include "model/mesh.hpp"

namespace geist {

/// A point's element and its natural coordinates there.
struct Location {
  std::int32_t element;
  Vec3 xi;
};

/// Elements sorted into a uniform grid of cells by their bounding boxes (reference positions).
class Locator {
 public:
  explicit Locator(const Mesh& mesh);

  /// The hexahedron that holds p, natural coordinates within [−1 − slack, 1 + slack]; of several the first,
  /// but never one that has `stranger` for a corner.
  std::optional<Location> find(Vec3 p, double slack = 1e-7, std::int32_t stranger = -1) const;

  /// The hexahedra whose bounding boxes meet the box, in order of elements.
  std::vector<std::int32_t> near(const Box& box) const;

 private:
  std::array<long, 3> cell(Vec3 p) const;
  const Mesh& mesh_;
  Vec3 low_;
  double width_ = 1;
  std::unordered_map<std::uint64_t, std::vector<std::int32_t>> elements_;
};

}  // namespace geist
