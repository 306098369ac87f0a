// The consistent lattice: bonds assembled from the material that there is. docs/theory.md, "Consistent
// lattice".
//
// Cut the region into cubes between the centres of particles. A site is the corner of eight of them, and of
// each the octant next to it is material if the site is occupied. Of a cube whose occupied corners are
//   all eight             a cell: its 12 edges get ¼ and its 12 face diagonals ½ of a bond (5);
//   all four of a face    a skin r thick in plane stress, for each such face: 4 sides ½, 2 diagonals 1 of
//                         k_n1 = rE/(1+ν), k_s1 = rE(1−3ν)/((1+ν)(1−ν)) and k_n2 = rνE/(1−ν²), k_s2 = 0;
//   both of an edge       a bar r × r, k_n = Er/2, so that there is one for each occupied edge: an edge in no
//                         skin adds one, an edge in two skins, whose material is the same there, takes one
//                         away. A bar in no skin also shears like a beam, k_s = 5/6 G r/2.
// So every homogeneous state that leaves the faces free is exact.
#pragma once
#include "de/elastic_bond.hpp"
#include "model/lattice.hpp"

namespace geist::de {

/// How many cells, skins and bars (−: taken away) a bond is part of; bars in no skin once more.
struct Parts {
  int cells = 0, skins = 0, bars = 0, lone_bars = 0;
  bool operator==(const Parts&) const = default;
  auto operator<=>(const Parts&) const = default;
};

/// Of the bond in direction d of a site with these neighbours (BondClass::neighbours), if it exists.
Parts parts_of(std::uint32_t neighbours, int d);

/// The springs that they add up to in a bond of this group.
ElasticBond assembled(const Parts& parts, int group, const Material& material, double r);

/// Neighbour at (a, b, c), each −1, 0 or 1, as a bit of BondClass::neighbours.
constexpr std::uint32_t neighbour_bit(int a, int b, int c) {
  return 1u << (9 * (c + 1) + 3 * (b + 1) + a + 1);
}
inline constexpr std::uint32_t all_neighbours = ((1u << 27) - 1) & ~neighbour_bit(0, 0, 0);

/// Make a connected lattice consistent: the classes of its sites. Ghosts count as occupied. Throws
/// std::invalid_argument where a bond's stiffness would be negative at the material's Poisson's ratio.
void assemble(Lattice& lattice);

/// What the classes add, at most, to the largest ω² of the endless lattice.
double surface_excess(const Lattice& lattice);

}  // namespace geist::de
