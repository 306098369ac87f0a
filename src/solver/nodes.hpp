// The nodes' part of a step: gather the forces of their elements, and the kick.
#pragma once
#include "de/bonds.hpp"
#include "model/mesh.hpp"

namespace geist {

/// mesh.f = Σ over the corners of all elements that meet at a node, in order of elements (1).
void gather_internal_forces(Mesh& mesh);

/// (16)(25): v⁺ = keep · v⁻ + (Δt f / m + Δt g) / (1 + αΔt/2) for the components that no support holds.
/// kick.per_mass is Δt / (1 + αΔt/2) here. The sums are weighted with the masses.
de::KickSums kick_nodes(Mesh& mesh, const de::Kick& kick);

/// Displacement of the step: u^{n+1} = u^n + Δt v^{n+1/2}.
void drift(Mesh& mesh, double dt);

}  // namespace geist
