// Lattice: the sites of one discrete region on a grid of pitch 2r. Arrays, no physics.
//
// Sites lie in grid order, x fastest, rows padded to whole Packs; a neighbour is a constant offset, so no
// list of neighbours or bonds exists. A site is empty, a particle, or a ghost; the grid is just large enough
// to hold the particles and their ghosts. What differs from site to site is one word (see Site below).
#pragma once
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/field.hpp"
#include "core/pack.hpp"
#include "core/vec.hpp"
#include "model/kinematics.hpp"
#include "model/material.hpp"

namespace geist {

/// The 18 neighbours in steps of the pitch: 6 of group 1, 12 of group 2. Direction d is opposite to 17 − d.
inline constexpr std::array<std::array<int, 3>, 18> directions{{{0, -1, -1},
                                                                {-1, 0, -1},
                                                                {0, 0, -1},
                                                                {1, 0, -1},
                                                                {0, 1, -1},
                                                                {-1, -1, 0},
                                                                {0, -1, 0},
                                                                {1, -1, 0},
                                                                {-1, 0, 0},
                                                                {1, 0, 0},
                                                                {-1, 1, 0},
                                                                {0, 1, 0},
                                                                {1, 1, 0},
                                                                {0, -1, 1},
                                                                {-1, 0, 1},
                                                                {0, 0, 1},
                                                                {1, 0, 1},
                                                                {0, 1, 1}}};
inline constexpr int opposite(int d) { return 17 - d; }

/// A site's word: bits 0–17 say which of its bonds exist, then what the site is.
namespace site {
inline constexpr std::uint32_t bonds = (1u << 18) - 1;
inline constexpr std::uint32_t particle = 1u << 18;
inline constexpr std::uint32_t ghost = 1u << 19;
/// A particle that only bonds act on: the lattice kernel advances it. Otherwise its force is handed over.
inline constexpr std::uint32_t free = 1u << 20;
/// Its bonds are not those of the endless lattice: see Lattice::class_of. Consistent lattices only.
inline constexpr std::uint32_t surface = 1u << 21;
/// An inner particle: all bonds, free.
inline constexpr std::uint32_t inner = bonds | particle | free;
}  // namespace site

/// What the site is the lowest corner of and resists dilatation: bit 6 says whether a cell, bits 2a and 2a +
/// 1 count the skins across axis a (none to two).
namespace dilating {
inline constexpr std::uint8_t cell = 1u << 6;
inline constexpr std::uint64_t eight_cells = 0x0101010101010101u * cell;
constexpr int count(std::uint8_t here, int kind) { return here >> 2 * kind & 3; }
}  // namespace dilating

/// Position of sites on the grid.
struct Grid {
  int nx = 0, ny = 0, nz = 0;  ///< sites in each direction
  Vec3 origin;                 ///< centre of site (0, 0, 0)
  double pitch = 0;            ///< 2r

  std::size_t stride() const { return (static_cast<std::size_t>(nx) + lanes - 1) / lanes * lanes; }
  std::size_t rows() const { return static_cast<std::size_t>(ny) * nz; }
  std::size_t size() const { return rows() * stride(); }
  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * ny + j) * stride() + static_cast<std::size_t>(i);
  }
  std::array<int, 3> ijk(std::size_t s) const {
    const std::size_t row = s / stride();
    return {static_cast<int>(s % stride()), static_cast<int>(row % ny), static_cast<int>(row / ny)};
  }
  bool contains(int i, int j, int k) const {
    return i >= 0 && i < nx && j >= 0 && j < ny && k >= 0 && k < nz;
  }
  Vec3 centre(int i, int j, int k) const {
    return {origin.x + pitch * i, origin.y + pitch * j, origin.z + pitch * k};
  }
  Vec3 centre(std::size_t s) const {
    const auto [i, j, k] = ijk(s);
    return centre(i, j, k);
  }
  std::ptrdiff_t offset(int d) const {
    const auto [i, j, k] = directions[d];
    return (static_cast<std::ptrdiff_t>(k) * ny + j) * static_cast<std::ptrdiff_t>(stride()) + i;
  }
  /// Places that a stencil may look beyond either end.
  std::size_t guard() const { return static_cast<std::size_t>(ny + 1) * stride() + lanes; }
};

/// A node that a ghost rides on.
struct GhostNode {
  std::int32_t node;
  double N;            ///< share of the node's displacement in the ghost's
  Vec3 gradient = {};  ///< ∂N/∂x at the ghost, of the shape functions of its hexahedron
};

/// A ghost particle: site s rides on a hexahedron at natural coordinates ξ. Its nodes are that hexahedron's,
/// N the shape functions (8) at ξ; or, where its face reaches over several hexahedra, all of theirs, N the
/// means over the face (coupling/faces.hpp).
struct Ghost {
  std::size_t site;
  std::int32_t element;
  Vec3 xi;  ///< (11)
  std::vector<GhostNode> nodes = {};
};

/// How a ghost that turns with the continuum answers a moment m_g: the force on node I is R ((K m_g) × ∇N_I).
struct GhostTurn {
  Mat3 R, K;
};

/// How ghosts turn: not at all; by themselves ("one-step-back", (15)(24)), a degree of freedom of the
/// lattice; or with the continuum, θ_g = ½ curl u.
enum class GhostRotation { none, own, continuum };

/// Which of the 27 places around and at a site are occupied (by a particle or a ghost), and which by
/// particles; place (a, b, c), each −1, 0 or 1, is bit 9(c+1) + 3(b+1) + (a+1).
struct Surroundings {
  std::uint32_t occupied = 0, particles = 0;
  auto operator<=>(const Surroundings&) const = default;
};

/// Springs of a site's bonds, by direction: the force of a bond along e (in steps of the grid) at relative
/// displacement d is shear d + along (d·e) e.
struct BondClass {
  Surroundings around;
  std::array<double, 18> shear{}, along{};
  std::array<double, 18> bends{};  ///< 1 where the bond resists bending and twisting, else 0
};

struct Lattice {
  std::string name;
  Material material;
  Kinematics kinematics = Kinematics::small;
  Grid grid;
  double mass = 0, inertia = 0;  ///< of one particle: m_d and I_d (a ghost's I_g = I_d)

  std::vector<std::uint32_t> word;  ///< one for each site

  // Consistent lattices only (published ones have no classes): the class of every site; 0 is the endless
  // lattice's.
  std::vector<BondClass> classes;
  std::vector<std::uint32_t> class_of;
  // Those with ν > ¼ only (de/dilatation.hpp): cells and skins by their lowest corner's site, and the force
  // by which they push their corners outwards along each axis, of skins across x, y, z and of cells.
  std::vector<std::uint8_t> dilating;
  Field<4> pressure;

  // State: components 0–2 of motion are the displacement u, 3–5 the rotation θ (radians); of velocity v and
  // ω.
  Field<6> motion, velocity;
  Field<6> velocity_before;  ///< half a step before motion's time; valid on observed steps only
  // Finite rotations only, in place of θ, which stays 0: R − I column by column. Component 3c + a is the part
  // along axis a of what column c, the direction that the grid's axis c has turned to, differs from e_c.
  Field<9> rotation;

  // Sites whose force the lattice kernel hands over instead of advancing them (ghosts; loaded or supported
  // particles), in ascending order, and that force and moment. listed_begin[row] .. listed_begin[row + 1].
  std::vector<std::size_t> listed;
  std::vector<std::int32_t> listed_begin;
  Field<6> listed_force;
  std::vector<std::uint8_t>
      listed_held;  ///< bit c is set if component c is not for the kick: held, or follows

  std::vector<double> row_sums;  ///< scratch of the lattice kernel, by row

  std::vector<Ghost> ghosts;  ///< in order of sites
  GhostRotation ghost_rotation = GhostRotation::own;
  std::vector<GhostTurn> ghost_turns;    ///< of the present displacement, where rotations are finite
  std::vector<std::int32_t> ghost_slot;  ///< ghost g's place in listed

  double radius() const { return grid.pitch / 2; }
  bool consistent() const { return !classes.empty(); }
  bool dilates() const { return !dilating.empty(); }
  bool is(std::size_t s, std::uint32_t flag) const { return word[s] & flag; }
  std::size_t count(std::uint32_t flag) const;
};

/// Make the (zero) state of a lattice whose grid and words are set.
void finish(Lattice& lattice);

/// Derive each site's bond bits from which sites are particles and ghosts (ghost–ghost pairs carry no bond,
/// but for those of cells with a particle: de/assembly.hpp).
void connect(Lattice& lattice);

/// Hand the force of these particles over from now on, beside that of all ghosts. Any order, repeats allowed.
void list_sites(Lattice& lattice, const std::vector<std::size_t>& particles);

/// Place of site s in lattice.listed; s must be listed.
std::int32_t listed_slot(const Lattice& lattice, std::size_t s);

}  // namespace geist
