#include "coupling/faces.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
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

/// The near squares of one ghost, with what they share out.
struct Face {
  std::vector<Square> squares;
  std::vector<Shares> shares;

  /// Four squares around the ghost in one plane.
  bool is_flat() const {
    return squares.size() == 4 && std::all_of(squares.begin(), squares.end(), [this](const Square& square) {
             return dot(square.n, squares[0].n) > 0.5;
           });
  }
};

/// Give a ghost the nodes of its face, unless they are its hexahedron's.
void spread(Ghost& ghost, const Face& face, double r) {
  Shares all;
  for (const Shares& part : face.shares) {
    for (const auto& [node, share] : part.by_node) all.by_node[node] += share;
    all.area += part.area;
  }
  if (std::abs(all.area - 4 * r * r) > 1e-6 * r * r) return;
  for (const GhostNode& I : ghost.nodes) all.by_node.try_emplace(I.node, 0.0);
  if (all.by_node.size() == ghost.nodes.size()) return;
  std::map<std::int32_t, Vec3> gradient;
  for (const GhostNode& I : ghost.nodes) gradient[I.node] = I.gradient;
  ghost.nodes.clear();
  for (const auto& [node, share] : all.by_node) {
    const auto own = gradient.find(node);
    ghost.nodes.push_back({node, share / all.area, own == gradient.end() ? Vec3{} : own->second});
  }
}

}  // namespace

std::map<std::int32_t, Vec3> spread_ghosts(Model& model, const Locator& locator) {
  std::map<std::int32_t, Vec3> defects;
  for (Lattice& lattice : model.lattices) {
    const double r = lattice.radius();
    std::vector<Face> faces(lattice.ghosts.size());
    const auto integrate_face = [&](std::size_t g) {
      visit_octants(lattice, lattice.ghosts[g], [&](const Octant& octant) {
        for (Square& square : near_squares(lattice, octant)) {
          faces[g].shares.push_back(integrate(square, r, model.mesh, locator));
          faces[g].squares.push_back(std::move(square));
        }
      });
    };
    for_each(faces.size(), integrate_face);
    for (std::size_t g = 0; g < faces.size(); ++g) {
      Ghost& ghost = lattice.ghosts[g];
      const auto& [squares, shares] = faces[g];
      if (faces[g].is_flat()) spread(ghost, faces[g], r);
      for (std::size_t k = 0; k < squares.size(); ++k) {
        for (const auto& [node, share] : shares[k].by_node) defects[node] -= share * squares[k].n;
        for (const GhostNode& I : ghost.nodes) defects[I.node] += (shares[k].area * I.N) * squares[k].n;
      }
    }
  }
  return defects;
}

}  // namespace geist::coupling
