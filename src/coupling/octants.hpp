// The octants of ghosts' cubes that are the lattice's: those whose cube between centres has a particle for a
// corner. Their near squares, r × r with the ghost at a corner, are where the hexahedra end.
#pragma once
#include <array>
#include <vector>

#include "geometry/hex8.hpp"
#include "geometry/polyhedron.hpp"
#include "model/lattice.hpp"

namespace geist::coupling {

struct Octant {
  const Ghost* ghost;
  Vec3 x_g;
  std::array<int, 3> sign;  ///< where it lies as seen from the ghost
  Box box;
};

/// Whether the octant of a site's cube on that side is the lattice's.
inline bool is_the_lattices(const Lattice& lattice, std::size_t site, const std::array<int, 3>& sign) {
  const Grid& grid = lattice.grid;
  const auto [i, j, k] = grid.ijk(site);
  for (int corner = 1; corner < 8; ++corner) {
    const int a = i + (corner & 1 ? sign[0] : 0), b = j + (corner & 2 ? sign[1] : 0),
              c = k + (corner & 4 ? sign[2] : 0);
    if (grid.contains(a, b, c) && lattice.is(grid.index(a, b, c), site::particle)) return true;
  }
  return false;
}

/// Call visit(octant) for the octants of a ghost that are the lattice's.
template <class Visit>
void visit_octants(const Lattice& lattice, const Ghost& ghost, Visit visit) {
  const double r = lattice.radius();
  const Vec3 x_g = lattice.grid.centre(ghost.site);
  for (int octant = 0; octant < 8; ++octant) {
    const std::array<int, 3> sign{octant & 1 ? 1 : -1, octant & 2 ? 1 : -1, octant & 4 ? 1 : -1};
    if (!is_the_lattices(lattice, ghost.site, sign)) continue;
    Box box = nowhere();
    widen(box, x_g), widen(box, x_g + r * Vec3{1.0 * sign[0], 1.0 * sign[1], 1.0 * sign[2]});
    visit(Octant{&ghost, x_g, sign, box});
  }
}

/// The half-spaces of an element's faces; a warped face is taken as the plane through its centre.
inline std::array<HalfSpace, 6> half_spaces(const hex8::Corners& x) {
  constexpr std::array<std::array<int, 4>, 6> faces{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 4, 7, 3}, {1, 2, 6, 5}}};
  std::array<HalfSpace, 6> halves;
  for (int k = 0; k < 6; ++k) {
    const auto& [a, b, c, d] = faces[k];
    const Vec3 normal = cross(x[c] - x[a], x[d] - x[b]), n = normal * (1 / norm(normal));
    halves[k] = {n, dot(n, 0.25 * (x[a] + x[b] + x[c] + x[d]))};
  }
  return halves;
}

}  // namespace geist::coupling
