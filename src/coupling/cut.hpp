// Every point counted once: what the cells between ghosts and particles leave of the hexahedra.
//
// Each octant (edge r) of a ghost's cube that belongs to a cell with a particle is the lattice's. The
// hexahedra's energy is integrated over the rest, and so is their mass; the mass of the octants rides on
// their ghosts. docs/theory.md, "Every point counted once".
#pragma once
#include <vector>

#include "geometry/locator.hpp"
#include "model/model.hpp"

namespace geist::coupling {

/// The cuts of all hexahedra that the lattices' ghosts lie in or reach into, in order of elements. Where less
/// than 10⁻³ of an element would be left, 10⁻³ is, so that its nodes stay attached. Warped faces are taken as
/// the planes through their centres.
std::vector<HexCut> cut_hexahedra(const Model& model, const Locator& locator);

}  // namespace geist::coupling
