// What the tests of the lattice share: lattices of any kind, and the bonds' law written out literally.
//
// `Literal` is the published law (3)–(5), (19)–(23) in total form, without grid, offsets, packs or words:
// every pair of sites at distance 2r or 2√2 r is a bond if one of the two is a particle; its mid-point c
// belongs to both, each of which carries it with u + θ × (c − x); f = k_n d_n + k_s d_t; m = (c − x) × f.
#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "de/bonds.hpp"
#include "model/lattice.hpp"

namespace geist::de::testing {

inline constexpr std::uint32_t free_particle = site::particle | site::free;

/// What a site is, by its place on the grid: 0, free_particle, site::particle (listed) or site::ghost.
using Kind = std::function<std::uint32_t(int i, int j, int k)>;

Lattice make_lattice(const std::array<int, 3>& n, const Kind& kind);

/// All sites free particles.
Lattice full_lattice(const std::array<int, 3>& n);

/// Empty sites, free and listed particles and ghosts at random.
Lattice random_lattice(const std::array<int, 3>& n, int seed);

/// Numbers of order 1 in all six components of all sites that are not empty.
void move_at_random(Lattice& lattice, int seed);
/// The same for velocities.
void push_at_random(Lattice& lattice, int seed);

/// Rotation by that vector (Rodrigues' formula).
Mat3 rotation_by(Vec3 theta);
Mat3 operator*(const Mat3& a, const Mat3& b);

/// The same lattice, consistent or published, at rest.
Lattice small(Lattice lattice, bool consistent);
/// A full consistent lattice with ν > ¼.
Lattice dilating(const std::array<int, 3>& n);

/// The same lattice with finite rotations, consistent or published, at rest.
Lattice finite(Lattice lattice, bool consistent);
void set_rotation(Lattice& lattice, std::size_t s, const Mat3& R);

/// Displacements of up to `amount` times r, rotations of up to `amount`, beside one that all share.
void turn_at_random(Lattice& lattice, int seed, double amount);

/// What kernel a lattice is for.
struct Method {
  bool consistent, finite;
};
inline const auto all_methods =
    ::testing::Values(Method{false, false}, Method{true, false}, Method{false, true}, Method{true, true});
std::string name_of(const ::testing::TestParamInfo<Method>& is);

/// A lattice of all kinds of sites, moved and pushed at random.
Lattice moving(Method method, const std::array<int, 3>& n);

/// Σ v⁻·v⁺ and Σ v⁺·v⁺ of its free particles, and those of spins.
KickSums sums_of_free(const Lattice& before, const Lattice& after);

/// By site: force and moment.
struct Loads6 {
  std::vector<Vec3> force, moment;
  double largest() const;
};

/// The literal law's forces and energy.
struct Literal {
  Loads6 on;
  double bonds = 0, coupling = 0;  ///< energies
  std::vector<double> energy;      ///< by site, half of each bond's
  std::size_t bond_count = 0;
};
Literal literal(const Lattice& lattice);

/// What the kernel makes of the present motion; velocities are overwritten.
Loads6 kernel_forces(Lattice& lattice);

/// Moved at random, a lattice of small rotations has forces that are minus the derivatives of its energy.
void expect_forces_of_the_energy(Lattice lattice);

/// The shapes that tests go over: rows shorter and longer than a Pack, single rows, single sites.
inline constexpr std::array<std::array<int, 3>, 8> shapes{
    {{1, 1, 1}, {2, 2, 2}, {9, 1, 3}, {8, 3, 3}, {1, 7, 2}, {5, 4, 3}, {26, 4, 4}, {17, 1, 1}}};

}  // namespace geist::de::testing
