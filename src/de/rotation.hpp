// Finite rotations of particles: how they grow with the spin, and how they are told.
#pragma once
#include "core/vec.hpp"
#include "model/lattice.hpp"

namespace geist::de {

/// R^{n+1} = exp(Δt ω^{n+1/2} ×) R^n for every site of a lattice with finite rotations.
void turn(Lattice& lattice, double dt);

/// The rotation vector of a particle or ghost: θ, or with finite rotations the logarithm of R, at most π
/// long.
Vec3 rotation_vector(const Lattice& lattice, std::size_t s);

/// Its rotation matrix I + H (finite rotations only).
Mat3 rotation_matrix(const Lattice& lattice, std::size_t s);

}  // namespace geist::de
