// What an interface reflects: the exact solution of a plane wave at normal incidence, hexahedra on one side
// and the lattice on the other, as chains of masses and springs (per area), Δt → 0.
//
//   hexahedra: masses ρh, springs M/h, M = λ + 2μ;     lattice: masses ρ 2r, springs M/2r
//   at the interface u_g = (r/h) u_{−h} + (1 − r/h) u_0, and a spring M/2r from the ghost to the first
//   particle consistent: the last element's spring is (1 − r/h) M/h, and the mass of what is cut off rides on
//   the ghost, m_0 = ρ (h² − r²)/2h;   published: M/h and ρh/2
//
// Both chains slow down short waves, by (πh/λ)²/6; what they do so differently they reflect, as meshes do
// where the size of their elements jumps. docs/theory.md, "Waves".
#pragma once
#include "model/material.hpp"

namespace geist::coupling {

/// One side of an interface.
struct Side {
  Material material;
  double spacing;  ///< h, or 2r
};

/// Share of the amplitude of a wave of that length, measured in the hexahedra, that is reflected; 1 where the
/// other side carries no wave of its frequency. h > r and wavelength > 2h.
double reflected(const Side& hexahedra, const Side& lattice, double wavelength, bool consistent);

/// The shortest wave that a region of this spacing carries within 1 % of its speed.
double finest_wavelength(double spacing);

}  // namespace geist::coupling
