// The nodes' part of a step: the kick and the drift.
#pragma once
#include "de/bonds.hpp"
#include "model/mesh.hpp"

namespace geist {

/// (16)(25): v⁺ = keep · v⁻ + (Δt f / m + Δt g) / (1 + αΔt/2) for the components that no support holds.
/// kick.per_mass is Δt / (1 + αΔt/2) here. The sums are weighted with the masses.
de::KickSums kick_nodes(Mesh& mesh, const de::Kick& kick);

/// Displacement of the step: u^{n+1} = u^n + Δt v^{n+1/2}.
void drift(Mesh& mesh, double dt);

}  // namespace geist
