#include "coupling/cut.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "coupling/balance.hpp"
#include "coupling/faces.hpp"
#include "coupling/octants.hpp"

namespace geist::coupling {
namespace {

constexpr double least_share = 1e-6;

double density(const Mesh& mesh, std::int32_t e) { return mesh.regions[region_of(mesh, e)].material.density; }

HexCut whole(const Mesh& mesh, std::int32_t e) {
  const hex8::Corners x = hex8::corners(mesh, static_cast<std::size_t>(e));
  HexCut cut{e, hex8::volume(x), {}, hex8::corner_volumes(x)};
  for (const Vec3 s : hex8::corner_xi) {
    const Vec3 xi = hex8::gauss * s;
    const double dV = det(hex8::jacobian(x, xi));
    const auto gradient = hex8::position_gradient(x, xi);
    for (int a = 0; a < 8; ++a) cut.gradient[a] += dV * gradient[a];
  }
  for (double& m : cut.mass) m *= density(mesh, e);
  return cut;
}

bool is_inside(const Box& box, const HalfSpace& half, double tolerance) {
  const Vec3 farthest{(half.n.x > 0 ? box.high : box.low).x, (half.n.y > 0 ? box.high : box.low).y,
                      (half.n.z > 0 ? box.high : box.low).z};
  return dot(half.n, farthest) <= half.offset + tolerance;
}

/// Points to integrate over the part of a box that lies in an element; all of it: `whole_box`.
std::vector<WeightedPoint> points_in(const Box& box, const hex8::Corners& x, bool& whole_box) {
  const double tolerance = 1e-9 * norm(box.high - box.low);
  const auto halves = half_spaces(x);
  whole_box = std::all_of(halves.begin(), halves.end(),
                          [&](const HalfSpace& half) { return is_inside(box, half, tolerance); });
  if (whole_box) {
    const auto points = quadrature(box);
    return {points.begin(), points.end()};
  }
  ConvexPolyhedron part(box);
  for (const HalfSpace& half : halves)
    if (!part.empty()) part.cut(half, tolerance);
  return part.quadrature();
}

/// A point of an octant in an element.
struct PointInside {
  double weight;
  std::array<double, 8> N;
  std::array<Vec3, 8> gradient;
};

/// The points of an octant in an element.
struct Part {
  std::int32_t element;
  std::vector<PointInside> points = {};
};

/// The parts of a ghost's octants, octant by octant, element by element.
std::vector<Part> parts_of(const Lattice& lattice, const Ghost& ghost, const Mesh& mesh,
                           const Locator& locator) {
  std::vector<Part> parts;
  visit_octants(lattice, ghost, [&](const Octant& octant) {
    bool found_whole = false;
    for (const std::int32_t e : locator.near(octant.box)) {
      const hex8::Corners x = hex8::corners(mesh, static_cast<std::size_t>(e));
      const auto points = points_in(octant.box, x, found_whole);
      if (points.empty()) continue;
      parts.push_back({e});
      Part& part = parts.back();
      for (const auto& [p, weight] : points) {
        const auto [xi, converged] = hex8::inverse_map(x, p);
        if (converged) part.points.push_back({weight, hex8::shape(xi), hex8::position_gradient(x, xi)});
      }
      if (found_whole) break;
    }
  });
  return parts;
}

/// Take a part out of its element. Returns its mass.
double take(const Part& part, double rho, HexCut& cut) {
  double mass = 0;
  for (const auto& [weight, N, gradient] : part.points) {
    cut.volume -= weight, mass += rho * weight;
    for (int a = 0; a < 8; ++a) cut.gradient[a] -= weight * gradient[a], cut.mass[a] -= rho * weight * N[a];
  }
  return mass;
}

/// Give mass to the nodes that a ghost rides on: to those of its hexahedron by that one, to others by any
/// that is theirs; nobody asks which.
void give(double mass, const Ghost& ghost, const Mesh& mesh, Cuts& cuts,
          const std::vector<std::int32_t>& element_of_node) {
  for (const GhostNode& I : ghost.nodes) {
    const auto& own = mesh.elements[static_cast<std::size_t>(ghost.element)];
    const bool is_own = std::find(own.begin(), own.end(), I.node) != own.end();
    const std::int32_t e = is_own ? ghost.element : element_of_node[static_cast<std::size_t>(I.node)];
    const auto& nodes = mesh.elements[static_cast<std::size_t>(e)];
    cuts.of(e)
        .mass[static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), I.node) - nodes.begin())] +=
        mass * I.N;
  }
}

void take_octants(const Model& model, const Locator& locator, Cuts& cuts) {
  const Mesh& mesh = model.mesh;
  std::vector<std::int32_t> element_of_node(mesh.nodes(), -1);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const std::int32_t node : mesh.elements[e])
      element_of_node[static_cast<std::size_t>(node)] = static_cast<std::int32_t>(e);
  constexpr std::size_t at_a_time =
      1024;  // ghosts: their points are found by all threads, and taken in order
  std::vector<std::vector<Part>> parts(at_a_time);
  for (const Lattice& lattice : model.lattices)
    for (std::size_t first = 0; first < lattice.ghosts.size(); first += at_a_time) {
      const std::size_t n = std::min(at_a_time, lattice.ghosts.size() - first);
      for_each(
          n, [&](std::size_t g) { parts[g] = parts_of(lattice, lattice.ghosts[first + g], mesh, locator); });
      for (std::size_t g = 0; g < n; ++g)
        for (const Part& part : parts[g])
          give(take(part, density(mesh, part.element), cuts.of(part.element)), lattice.ghosts[first + g],
               mesh, cuts, element_of_node);
    }
}

}  // namespace

HexCut& Cuts::of(std::int32_t element) {
  const auto [it, is_new] = left_.try_emplace(element);
  if (is_new) it->second = whole(mesh_, element);
  return it->second;
}

std::vector<std::int32_t> Cuts::elements() const {
  std::vector<std::int32_t> all;
  for (const auto& [element, cut] : left_) all.push_back(element);
  return all;
}

std::vector<HexCut> Cuts::finished() {
  std::vector<HexCut> cuts;
  for (auto& [element, cut] : left_) {
    const HexCut all = whole(mesh_, element);
    for (int a = 0; a < 8; ++a) cut.mass[a] = std::max(cut.mass[a], least_share * all.mass[a]);
    if (cut.volume < least_share * all.volume) {
      cut.volume = least_share * all.volume;
      for (int a = 0; a < 8; ++a) cut.gradient[a] = least_share * all.gradient[a];
    }
    cuts.push_back(cut);
  }
  return cuts;
}

std::vector<HexCut> cut_hexahedra(Model& model, const Locator& locator) {
  const auto defects = spread_ghosts(model, locator);
  Cuts cuts(model.mesh);
  take_octants(model, locator, cuts);
  balance(model.mesh, defects, cuts);
  return cuts.finished();
}

}  // namespace geist::coupling
