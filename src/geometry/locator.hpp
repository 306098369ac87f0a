// Locator: which hexahedron holds a point.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/shapes.hpp"
#include "model/mesh.hpp"

namespace geist {

/// A point's element and its natural coordinates there.
struct Location {
  std::int32_t element;
  Vec3 xi;
};

/// Elements sorted into cells by their bounding boxes (reference positions); every region has its own grid of
/// cells, as wide as its elements are long in the mean.
class Locator {
 public:
  explicit Locator(const Mesh& mesh);

  /// The hexahedron that holds p, natural coordinates within [−1 − slack, 1 + slack]; of several the first,
  /// but never one that has `stranger` for a corner.
  std::optional<Location> find(Vec3 p, double slack = 1e-7, std::int32_t stranger = -1) const;

  /// The first hexahedron before `end` that holds p.
  std::optional<Location> find_before(std::int32_t end, Vec3 p) const;

  /// The hexahedra whose bounding boxes meet the box, in order of elements.
  std::vector<std::int32_t> near(const Box& box) const;

 private:
  struct Cells {
    Box around;  ///< all elements and a margin
    double width = 1;
    std::array<int, 3> n{};
    std::vector<std::uint32_t> begin;   ///< of cell c: elements [begin[c], begin[c + 1])
    std::vector<std::int32_t> element;  ///< ascending in every cell

    std::array<int, 3> at(Vec3 p) const;
    std::size_t index(const std::array<int, 3>& cell) const;
    /// f(cell) for all cells that the box meets.
    template <class F>
    void visit(const Box& box, F f) const;
  };
  void sort(std::size_t first, std::size_t count);
  template <class Wanted>
  std::optional<Location> first_of(Vec3 p, double slack, Wanted wanted) const;

  const Mesh& mesh_;
  double margin_ = 0;
  std::vector<Box> box_;      ///< by element, with the margin
  std::vector<Cells> cells_;  ///< by region
};

}  // namespace geist
