// Faces of ghosts: the surface on which the hexahedra end where the lattice's cells begin.
//
// A homogeneous stress σ pulls at a ghost with σ A_g, A_g = Σ r² n over its near squares. It pulls at the
// hexahedra with σ ∫ N_a n dA. Both agree at node a, and a homogeneous state is one of equilibrium, if
//
//   Σ_g N_ga A_g = ∫ N_a n dA                                              (*)
//
// A ghost in the middle of its face (2r × 2r, flat: everywhere but at the corners of interfaces) therefore
// takes the mean displacement of its face, N_ga = mean of N_a. In one hexahedron that is N_a at the ghost, as
// published; it differs where the face reaches over several. Where (*) is still not fulfilled, balance.hpp
// mends it.
#pragma once
#include <map>

#include "geometry/locator.hpp"
#include "model/model.hpp"

namespace geist::coupling {

/// Let ghosts take the mean displacement of their faces. Returns, by node, what (*) lacks then:
/// Σ_g N_ga A_g − ∫ N_a n dA.
std::map<std::int32_t, Vec3> spread_ghosts(Model& model, const Locator& locator);

}  // namespace geist::coupling
