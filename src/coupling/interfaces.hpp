// Checks that regions meet as the coupling needs it: flush, without overlap or thin gap.
#pragma once
#include <optional>
#include <string>

#include "geometry/locator.hpp"
#include "model/model.hpp"

namespace geist::coupling {

/// What is wrong between two regions, and where.
struct Clash {
  std::string first, second;  ///< regions
  std::string message;        ///< with the place
};

/// The first place at which
///  - a particle's cell overlaps a hexahedron or another lattice region's cell,
///  - a hexahedron or another lattice region lies less than a particle away without touching,
///  - hexahedra touch a particle but are too thin to hold its ghost,
///  - two lattice regions touch (they would not be bonded),
///  - two regions of hexahedra overlap, or touch without sharing nodes.
/// Ghosts have been placed; `locator` belongs to model.mesh. If lattices are not coupled to anything, only
/// overlaps and what is wrong between hexahedra count.
std::optional<Clash> find_clash(const Model& model, const Locator& locator, bool coupled = true);

}  // namespace geist::coupling
