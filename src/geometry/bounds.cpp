#include "geometry/bounds.hpp"

#include <limits>

namespace geist {

Box bounds(const Model& model) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Box box{{inf, inf, inf}, {-inf, -inf, -inf}};
  const auto widen = [&](Vec3 p, double r) {
    for (int c = 0; c < 3; ++c) {
      box.low[c] = std::min(box.low[c], p[c] - r);
      box.high[c] = std::max(box.high[c], p[c] + r);
    }
  };
  for (const Vec3 p : model.mesh.points) widen(p, 0);
  for (const Lattice& lattice : model.lattices)
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      if (lattice.is(s, site::particle)) widen(lattice.grid.centre(s), lattice.radius());
  return box;
}

Box bounds(const std::vector<Box>& boxes) {
  Box all = boxes.front();
  for (const Box& b : boxes)
    for (int c = 0; c < 3; ++c) {
      all.low[c] = std::min(all.low[c], b.low[c]);
      all.high[c] = std::max(all.high[c], b.high[c]);
    }
  return all;
}

}  // namespace geist
