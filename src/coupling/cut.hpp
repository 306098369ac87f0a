// Every point counted once: what the cells between ghosts and particles leave of the hexahedra.
//
// An octant (octants.hpp) is the lattice's. The hexahedra's energy is integrated over the rest, and so is
// their mass; the mass of the octants rides on their ghosts. docs/theory.md, "Every point counted once".
#pragma once
#include <map>
#include <vector>

#include "geometry/locator.hpp"
#include "model/model.hpp"

namespace geist::coupling {

/// What is left of elements; an element that is asked for is whole at first.
class Cuts {
 public:
  explicit Cuts(const Mesh& mesh) : mesh_(mesh) {}
  HexCut& of(std::int32_t element);
  std::vector<std::int32_t> elements() const;  ///< that were asked for, in order

  /// All that were asked for, in order of elements. Where less than 10⁻⁶ of an element would be left, 10⁻⁶
  /// is, so that its nodes stay attached.
  std::vector<HexCut> finished();

 private:
  const Mesh& mesh_;
  std::map<std::int32_t, HexCut> left_;
};

/// Couple consistently: let ghosts take the mean motion of their faces (faces.hpp), and return the cuts of
/// all hexahedra that octants reach into, with balanced gradients (balance.hpp).
std::vector<HexCut> cut_hexahedra(Model& model, const Locator& locator);

}  // namespace geist::coupling
