// The consistent lattice: bonds assembled from the material that there is. docs/theory.md, "Consistent
// lattice".
//
// Cut the region into cubes between the centres of particles. A site is the corner of eight of them, and of
// each the octant next to it is material if the site is occupied. Of a cube whose occupied corners are
//   all eight             a cell: its 12 edges get ¼ and its 12 face diagonals ½ of an inner bond;
//   all four of a face    a skin r thick in plane stress, for each such face: 4 sides ½, 2 diagonals 1 of
//                         k_n1 = rE/(1+ν), k_s1 = rE(1−3ν)/((1+ν)(1−ν)) and k_n2 = rνE/(1−ν²), k_s2 = 0;
//   both of an edge       a bar r × r, k_n = Er/2, so that there is one for each occupied edge: an edge in no
//                         skin adds one, an edge in two skins, whose material is the same there, takes one
//                         away. A bar in no skin also shears like a beam, k_s = 5/6 G r/2.
// So every homogeneous state that leaves the faces free is exact. At an interface cubes end in the plane of
// the ghosts: there only springs are left, with what the cubes on the lattice's side give them.
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

/// Of the bond in direction d of a site with these surroundings, if it exists.
Parts parts_of(Surroundings around, int d);

/// The springs that they add up to in a bond of this group.
ElasticBond assembled(const Parts& parts, int group, const Material& material, double r);

/// Make a connected lattice consistent: the classes of its sites, and bonds between ghosts that are corners
/// of one cell, skin or bar. Ghosts count as occupied, but a cube of ghosts alone is nothing: it is
/// hexahedra. Throws std::invalid_argument where a bond's stiffness would be negative at the material's
/// Poisson's ratio.
void assemble(Lattice& lattice);

/// What the classes add, at most, to the largest ω² of the endless lattice.
double surface_excess(const Lattice& lattice);

}  // namespace geist::de
