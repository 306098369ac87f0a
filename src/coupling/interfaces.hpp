// Checks that regions meet as the coupling needs it: flush, without overlap or thin gap.
#pragma once
#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "geometry/locator.hpp"
#include "model/model.hpp"

namespace geist::coupling {

/// What is wrong between two regions, and where.
struct Clash {
  std::string first, second;  ///< regions
  std::string message;        ///< with the place
};

/// Pairs of regions, by name, that meet in contact and are not tied: they may touch or leave any gap.
class LoosePairs {
 public:
  void add(const std::string& a, const std::string& b) { pairs_.insert(std::minmax(a, b)); }
  bool contains(const std::string& a, const std::string& b) const {
    return pairs_.contains(std::minmax(a, b));
  }

 private:
  std::set<std::pair<std::string, std::string>> pairs_;
};

/// Whether a particle's face lies flush on hexahedra of the region.
bool flush(const Lattice& lattice, const HexRegion& region, const Locator& locator);

/// The first place at which
///  - a particle's cell overlaps a hexahedron or another lattice region's cell,
///  - a hexahedron or another lattice region lies less than a particle away without touching,
///  - hexahedra touch a particle but are too thin to hold its ghost,
///  - two lattice regions touch (they would not be bonded),
///  - two regions of hexahedra overlap, or touch without sharing nodes.
/// Ghosts have been placed; `locator` belongs to model.mesh. If lattices are not coupled to anything, only
/// overlaps and what is wrong between hexahedra count; between loose pairs, overlaps.
std::optional<Clash> find_clash(const Model& model, const Locator& locator, bool coupled = true,
                                const LoosePairs& loose = {});

}  // namespace geist::coupling
