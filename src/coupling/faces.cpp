#include "coupling/faces.hpp"

#include <cmath>

#include "coupling/octants.hpp"

namespace geist::coupling {
namespace {

/// A near square: its corners, the ghost first, and its unit normal, out of the hexahedra.
struct Square {
  std::vector<Vec3> corners;
  Vec3 n;
};

/// The near squares of an octant: across an axis where the octant beyond is not the lattice's too.
std::vector<Square> near_squares(const Lattice& lattice, const Octant& octant) {
  std::vector<Square> squares;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<int, 3> beside = octant.sign;
    beside[axis] = -beside[axis];
    if (is_the_lattices(lattice, octant.ghost->site, beside)) continue;
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    Square square{std::vector<Vec3>(4, octant.x_g), {}};
    for (const int k : {1, 2}) square.corners[k][b] += octant.sign[b] * lattice.radius();
    for (const int k : {2, 3}) square.corners[k][c] += octant.sign[c] * lattice.radius();
    square.n[axis] = octant.sign[axis];
    squares.push_back(square);
  }
  return squares;
}

/// ∫ N_a dA over a square, by node, and its area: over the hexahedra behind it.
struct Shares {
  std::map<std::int32_t, double> by_node;
  double area = 0;
};

Shares integrate(const Square& square, double r, const Mesh& mesh, const Locator& locator) {
  const Vec3 behind = -1e-6 * r * square.n;
  std::vector<Vec3> polygon = square.corners;
  Box box = nowhere();
  for (Vec3& p : polygon) p += behind, widen(box, p);
  Shares shares;
  for (const std::int32_t e : locator.near(box)) {
    const hex8::Corners x = hex8::corners(mesh, static_cast<std::size_t>(e));
    std::vector<Vec3> part = polygon;
    for (const HalfSpace& half : half_spaces(x))
      if (!part.empty()) part = clipped(part, half, 1e-9 * r);
    for (const auto& [p, area] : quadrature(part)) {
      const auto [xi, converged] = hex8::inverse_map(x, p - behind);
      if (!converged) continue;
      const auto N = hex8::shape(xi);
      for (int a = 0; a < 8; ++a)
        shares.by_node[mesh.elements[static_cast<std::size_t>(e)][a]] += area * N[a];
      shares.area += area;
    }
  }
  return shares;
}

bool parallel(Vec3 a, Vec3 b) { return dot(a, b) > 0.5; }

/// Give a ghost the nodes of its face, unless they are its hexahedron's.
void spread(Ghost& ghost, const std::vector<Square>& squares, double r, const Mesh& mesh,
            const Locator& locator) {
  Shares face;
  for (const Square& square : squares) {
    const Shares part = integrate(square, r, mesh, locator);
    for (const auto& [node, share] : part.by_node) face.by_node[node] += share;
    face.area += part.area;
  }
  if (std::abs(face.area - 4 * r * r) > 1e-6 * r * r) return;
  for (const GhostNode& I : ghost.nodes) face.by_node.try_emplace(I.node, 0.0);
  if (face.by_node.size() == ghost.nodes.size()) return;
  std::map<std::int32_t, Vec3> gradient;
  for (const GhostNode& I : ghost.nodes) gradient[I.node] = I.gradient;
  ghost.nodes.clear();
  for (const auto& [node, share] : face.by_node) {
    const auto own = gradient.find(node);
    ghost.nodes.push_back({node, share / face.area, own == gradient.end() ? Vec3{} : own->second});
  }
}

}  // namespace

void spread_ghosts(Model& model, const Locator& locator) {
  for (Lattice& lattice : model.lattices) {
    std::map<Ghost*, std::vector<Square>> faces;
    visit_octants(lattice, [&](Ghost& ghost, const Octant& octant) {
      for (const Square& square : near_squares(lattice, octant)) faces[&ghost].push_back(square);
    });
    for (auto& [ghost, squares] : faces) {
      bool flat = squares.size() == 4;
      for (const Square& square : squares) flat = flat && parallel(square.n, squares[0].n);
      if (flat) spread(*ghost, squares, lattice.radius(), model.mesh, locator);
    }
  }
}

std::map<std::int32_t, Vec3> pull_defects(const Model& model, const Locator& locator) {
  std::map<std::int32_t, Vec3> defects;
  for (const Lattice& lattice : model.lattices)
    visit_octants(lattice, [&](const Ghost& ghost, const Octant& octant) {
      for (const Square& square : near_squares(lattice, octant)) {
        const Shares shares = integrate(square, lattice.radius(), model.mesh, locator);
        for (const auto& [node, share] : shares.by_node) defects[node] -= share * square.n;
        for (const GhostNode& I : ghost.nodes) defects[I.node] += (shares.area * I.N) * square.n;
      }
    });
  return defects;
}

}  // namespace geist::coupling
