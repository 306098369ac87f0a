// The lattice's part of a step, and what can be asked of its bonds.
#pragma once
#include <vector>

#include "core/pack.hpp"
#include "core/vec.hpp"
#include "model/lattice.hpp"

namespace geist::de {

/// How a kick turns the velocity half a step before into the one half a step after:
/// v⁺ = keep · v⁻ + per_mass · f + gravity (and with per_inertia for the spins).
struct Kick {
  double keep = 1;         ///< (1 − αΔt/2) / (1 + αΔt/2)
  double per_mass = 0;     ///< Δt / (m (1 + αΔt/2))
  double per_inertia = 0;  ///< Δt / (I (1 + αΔt/2))
  Vec3 gravity;            ///< Δt g / (1 + αΔt/2)

  /// The same for a lattice's particles, if this is for one unit of mass and inertia.
  Kick of(const Lattice& lattice) const {
    return {keep, per_mass / lattice.mass, per_inertia / lattice.inertia, gravity};
  }
  /// Component c of v⁺: 0–2 of the velocity, 3–5 of the spin.
  template <class T>
  GEIST_INLINE T operator()(int c, T before, T force) const {
    const T kept = c < 3 ? fma(keep, before, constant<T>(gravity[c])) : keep * before;
    return fma(c < 3 ? per_mass : per_inertia, force, kept);
  }
};

/// Σ v⁻·v⁺ and Σ v⁺·v⁺ over the particles that were kicked; the same for spins. For one unit of mass and of
/// inertia.
struct KickSums {
  double across = 0, after = 0, spin_across = 0, spin_after = 0;
  KickSums& operator+=(const KickSums& b) {
    across += b.across, after += b.after, spin_across += b.spin_across, spin_after += b.spin_after;
    return *this;
  }
};

/// Forces of all bonds (3)–(5) at the present motion, and the kick (15)–(18), (24)–(27) of the free particles
/// with them, in one pass. The force on listed sites goes to lattice.listed_force and leaves them as they
/// are. Any number of threads gives the same bits.
KickSums bond_forces_and_kick(Lattice& lattice, const Kick& kick);

/// u^{n+1} = u^n + Δt v^{n+1/2} of every site, θ likewise, or R by the rotation about Δt ω. Ghosts that turn
/// with the continuum keep their R.
void drift(Lattice& lattice, double dt);

/// drift() and bond_forces_and_kick() to the same bits, but in one pass over memory where the lattice does
/// not resist dilatation. Ghosts must follow their hexahedra already: nothing changes their displacement.
KickSums advance(Lattice& lattice, const Kick& kick, double dt);

/// The same kick for the listed sites, with lattice.listed_force, in the components that are not held.
KickSums kick_listed(Lattice& lattice, const Kick& kick);

struct BondEnergies {
  double bonds = 0, coupling = 0;  ///< between particles; with a ghost at an end
  BondEnergies& operator+=(const BondEnergies& b) {
    bonds += b.bonds, coupling += b.coupling;
    return *this;
  }
};

/// Strain energy of the bonds at the present motion.
BondEnergies energies(const Lattice& lattice);

/// Strain energy by site: half of that of each of its bonds.
std::vector<double> site_energies(const Lattice& lattice);

/// Number of bonds (each counted once).
std::size_t bond_count(const Lattice& lattice);

/// An upper bound of the largest ω². Published: that of the endless lattice; no lattice cut from it vibrates
/// faster, since missing bonds only soften it. Consistent: that and surface_excess (de/assembly.hpp).
double largest_frequency_squared(const Lattice& lattice);

/// Young's modulus and Poisson's ratio of the endless lattice under homogeneous strain, by its bonds'
/// energies.
struct Recovered {
  double young, poisson;
};
Recovered recovered_constants(const Lattice& lattice);

}  // namespace geist::de
