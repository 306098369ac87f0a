// All hexahedra of a mesh: internal forces, energies, stresses, masses, and frequencies for the time step.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "model/mesh.hpp"

namespace geist::fe {

/// mesh.f += factor · the forces of a sweep's elements on their corners, −f_I^int of (1), from mesh.u (and
/// mesh.v for viscous hourglass control). Returns the power that their viscous hourglass control dissipates,
/// otherwise 0, without the factor.
double add_internal_forces(Mesh& mesh, const Sweep& sweep, double factor);

/// mesh.f = −f_I^int of (1), the forces of all elements. Returns their power as above.
double internal_forces(Mesh& mesh);

/// Energy stored by strain and by hourglass control.
struct Energies {
  double strain = 0, hourglass = 0;
  Energies& operator+=(const Energies& e) { return strain += e.strain, hourglass += e.hourglass, *this; }
};
Energies energies(const Mesh& mesh);

/// Stress of the mean strain in global axes, by element: xx, yy, zz, xy, yz, xz.
std::vector<std::array<double, 6>> centre_stresses(const Mesh& mesh);

/// The first element whose mean deformation turns it inside out, det F ≤ 0. With finite kinematics it has no
/// rotation, and its forces are not numbers; small kinematics asks for none.
std::optional<std::size_t> first_inverted(const Mesh& mesh);

/// From now on these elements are cut (in order of elements); others are whole.
void set_cuts(Mesh& mesh, std::vector<HexCut> cuts);

/// Lumped mass ρ ∫ N_a dV of an element's corners (m_I in (1) is their sum), or what its cut says.
std::array<double, 8> corner_masses(const Mesh& mesh, std::size_t element);

/// The same of elements [first, first + 8) of a region; beyond its end, anything.
std::array<std::array<double, 8>, lanes> corner_masses_of_eight(const Mesh& mesh, const HexRegion& region,
                                                                std::size_t first);

/// visit(e, corner masses) for all elements, in order: quicker than asking for each.
template <class Visit>
void visit_corner_masses(const Mesh& mesh, Visit visit) {
  for (const HexRegion& region : mesh.regions) {
    const std::size_t end = region.first + region.count;
    for (std::size_t first = region.first; first < end; first += lanes) {
      const auto mass = corner_masses_of_eight(mesh, region, first);
      for (std::size_t e = first; e < std::min(end, first + lanes); ++e) visit(e, mass[e - first]);
    }
  }
}

/// By region, the mass of its elements.
std::vector<double> region_masses(const Mesh& mesh);

/// Set mesh.mass to the sum of all elements' corner masses.
void lump_masses(Mesh& mesh);

/// By element, ω_e² such that Δt ≤ 2/ω_e for all e is stable when elements act alone: frequencies.cpp says
/// why and how. Of each region, at most so many eigenproblems are solved (about 0.1 ms each); see there what
/// the others get.
std::vector<double> frequencies_squared(const Mesh& mesh, std::size_t most_eigenproblems = 10'000);

}  // namespace geist::fe
