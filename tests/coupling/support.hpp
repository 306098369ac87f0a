// What the tests of the coupling share: models made of boxes.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "coupling/ghosts.hpp"
#include "coupling/interfaces.hpp"
#include "geometry/block.hpp"
#include "geometry/packing.hpp"
#include "model/model.hpp"

namespace geist::coupling::testing {

/// Collects regions; couple() makes ghosts, bonds and state.
class Builder {
 public:
  Builder& hexahedra(const std::string& name, const Box& box, const std::array<int, 3>& divisions,
                     const std::vector<Box>& minus = {});
  Builder& particles(const std::string& name, const std::vector<Box>& boxes, double radius,
                     const std::vector<Shape>& minus = {});
  /// Move nodes before anything is located.
  Builder& move_nodes(const std::function<Vec3(Vec3)>& moved);

  /// Ghosts placed, grids not yet trimmed; what find_clash() is asked about.
  std::optional<Clash> clash() const;
  /// The model ready to run.
  Model couple() const;

 private:
  Model made() const;
  std::vector<std::function<void(Model&)>> steps_;
};

/// Centres of all ghosts, rounded to a thousandth of the radius, in units of it.
std::vector<std::array<long, 3>> ghost_places(const Lattice& lattice);
/// The same for points, sorted.
std::vector<std::array<long, 3>> places(const std::vector<Vec3>& points, double radius);

}  // namespace geist::coupling::testing
