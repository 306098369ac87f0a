#include "geometry/bounds.hpp"

namespace geist {

Box bounds(const Model& model) {
  Box box = nowhere();
  for (const Vec3 p : model.mesh.points) widen(box, p);
  for (const Lattice& lattice : model.lattices)
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      if (lattice.is(s, site::particle)) widen(box, lattice.grid.centre(s), lattice.radius());
  return box;
}

Box bounds(const std::vector<Box>& boxes) {
  Box all = nowhere();
  for (const Box& b : boxes) widen(all, b);
  return all;
}

}  // namespace geist
