#include "coupling/cut.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/hex8.hpp"
#include "geometry/polyhedron.hpp"

namespace geist::coupling {
namespace {

constexpr double least_share = 1e-3;

/// The half-spaces of an element's six faces.
std::array<HalfSpace, 6> half_spaces(const hex8::Corners& x) {
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

/// Collects what is taken from and given to each element.
class Cutter {
 public:
  Cutter(const Model& model, const Locator& locator) : model_(model), locator_(locator) {}

  void take_octants(const Lattice& lattice) {
    for (const Ghost& ghost : lattice.ghosts)
      for (int octant = 0; octant < 8; ++octant) {
        const std::array<int, 3> sign{octant & 1 ? 1 : -1, octant & 2 ? 1 : -1, octant & 4 ? 1 : -1};
        if (has_particle(lattice, ghost.site, sign)) take(octant_box(lattice, ghost.site, sign), ghost);
      }
  }

  std::vector<HexCut> cuts() {
    std::vector<HexCut> all;
    for (auto& [element, left] : left_) {
      keep_attached(left);
      all.push_back(left);
    }
    return all;
  }

 private:
  /// Whether the cube between centres that the octant is part of has a particle for a corner.
  static bool has_particle(const Lattice& lattice, std::size_t site, const std::array<int, 3>& sign) {
    const Grid& grid = lattice.grid;
    const auto [i, j, k] = grid.ijk(site);
    for (int corner = 1; corner < 8; ++corner) {
      const int a = i + (corner & 1 ? sign[0] : 0), b = j + (corner & 2 ? sign[1] : 0),
                c = k + (corner & 4 ? sign[2] : 0);
      if (grid.contains(a, b, c) && lattice.is(grid.index(a, b, c), site::particle)) return true;
    }
    return false;
  }

  static Box octant_box(const Lattice& lattice, std::size_t site, const std::array<int, 3>& sign) {
    const double r = lattice.radius();
    const Vec3 from = lattice.grid.centre(site),
               to = from + r * Vec3{1.0 * sign[0], 1.0 * sign[1], 1.0 * sign[2]};
    Box box = nowhere();
    widen(box, from), widen(box, to);
    return box;
  }

  void take(const Box& box, const Ghost& ghost) {
    for (const std::int32_t e : locator_.near(box)) {
      const hex8::Corners x = hex8::corners(model_.mesh, static_cast<std::size_t>(e));
      const double tolerance = 1e-9 * norm(box.high - box.low);
      ConvexPolyhedron part(box);
      bool whole = true;
      for (const HalfSpace& half : half_spaces(x)) {
        whole = whole && is_inside(box, half, tolerance);
        if (!whole) part.cut(half, tolerance);
      }
      if (whole)
        take_points(e, x, quadrature(box), ghost);
      else
        take_points(e, x, part.quadrature(), ghost);
      if (whole) return;
    }
  }

  static bool is_inside(const Box& box, const HalfSpace& half, double tolerance) {
    const Vec3 farthest{(half.n.x > 0 ? box.high : box.low).x, (half.n.y > 0 ? box.high : box.low).y,
                        (half.n.z > 0 ? box.high : box.low).z};
    return dot(half.n, farthest) <= half.offset + tolerance;
  }

  template <class Points>
  void take_points(std::int32_t e, const hex8::Corners& x, const Points& points, const Ghost& ghost) {
    const double density = model_.mesh.regions[region_of(model_.mesh, e)].material.density;
    double mass = 0;
    for (const auto& [p, weight] : points) {
      const auto [xi, converged] = hex8::inverse_map(x, p);
      if (!converged) continue;
      HexCut& cut = left(e);
      const auto N = hex8::shape(xi);
      const auto gradient = hex8::position_gradient(x, xi);
      cut.volume -= weight;
      mass += density * weight;
      for (int a = 0; a < 8; ++a) {
        cut.gradient[a] -= weight * gradient[a];
        cut.mass[a] -= density * weight * N[a];
      }
    }
    if (mass == 0) return;
    HexCut& host = left(ghost.element);
    for (int a = 0; a < 8; ++a) host.mass[a] += mass * ghost.N[a];
  }

  /// What is left of an element; the whole of it at first.
  HexCut& left(std::int32_t e) {
    const auto [it, is_new] = left_.try_emplace(e);
    if (is_new) it->second = whole(e);
    return it->second;
  }

  HexCut whole(std::int32_t e) const {
    const hex8::Corners x = hex8::corners(model_.mesh, static_cast<std::size_t>(e));
    HexCut cut{e, hex8::volume(x), {}, hex8::corner_volumes(x)};
    for (const Vec3 s : hex8::corner_xi) {
      const Vec3 xi = hex8::gauss * s;
      const double dV = det(hex8::jacobian(x, xi));
      const auto gradient = hex8::position_gradient(x, xi);
      for (int a = 0; a < 8; ++a) cut.gradient[a] += dV * gradient[a];
    }
    for (double& m : cut.mass) m *= model_.mesh.regions[region_of(model_.mesh, e)].material.density;
    return cut;
  }

  void keep_attached(HexCut& cut) const {
    const HexCut all = whole(cut.element);
    for (int a = 0; a < 8; ++a) cut.mass[a] = std::max(cut.mass[a], least_share * all.mass[a]);
    if (cut.volume >= least_share * all.volume) return;
    cut.volume = least_share * all.volume;
    for (int a = 0; a < 8; ++a) cut.gradient[a] = least_share * all.gradient[a];
  }

  const Model& model_;
  const Locator& locator_;
  std::map<std::int32_t, HexCut> left_;
};

}  // namespace

std::vector<HexCut> cut_hexahedra(const Model& model, const Locator& locator) {
  Cutter cutter(model, locator);
  for (const Lattice& lattice : model.lattices) cutter.take_octants(lattice);
  return cutter.cuts();
}

}  // namespace geist::coupling
