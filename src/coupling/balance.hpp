// Gradients that make every homogeneous state one of equilibrium.
//
// At the corners of an interface the pulls of ghosts and hexahedra (faces.hpp) differ by σ R_a. Gradients of
// the hexahedra there are corrected, G_ea += Σ_k γ_ka q_ek, with the smallest Σ |q_ek|²/V_e such that
//
//   Σ_e Σ_k γ_ka q_ek = R_a
//
// where γ_1 … γ_4 are an element's patterns that no linear field stirs, so that the gradient of every linear
// field stays exact: variationally consistent integration (Chen, Hillman & Rüter, IJNME 95 (2013) 387–418). R
// has no constant and no linear part (ghosts integrate linear fields exactly), so there is a solution where
// elements meet around the corner; if there is none, the nearest one is taken.
#pragma once
#include <map>

#include "coupling/cut.hpp"

namespace geist::coupling {

void balance(const Mesh& mesh, const std::map<std::int32_t, Vec3>& defects, Cuts& cuts);

}  // namespace geist::coupling
