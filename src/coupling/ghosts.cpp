#include "coupling/ghosts.hpp"

#include <map>

#include "core/parallel.hpp"
#include "geometry/hex8.hpp"
#include "geometry/polar.hpp"

namespace geist::coupling {
namespace {

/// Whether a bond, or a cell, could join site (i, j, k) to a particle.
bool within_reach(const Lattice& lattice, int i, int j, int k, Reach reach) {
  const Grid& grid = lattice.grid;
  const auto particle = [&](int a, int b, int c) {
    return grid.contains(i + a, j + b, k + c) && lattice.is(grid.index(i + a, j + b, k + c), site::particle);
  };
  for (const auto& [a, b, c] : directions)
    if (particle(a, b, c)) return true;
  if (reach == Reach::bonds) return false;
  for (const int a : {-1, 1})
    for (const int b : {-1, 1})
      if (particle(a, b, -1) || particle(a, b, 1)) return true;
  return false;
}

Ghost make_ghost(std::size_t site, const Location& found, const Mesh& mesh) {
  Ghost ghost{site, found.element, found.xi};
  const auto e = static_cast<std::size_t>(found.element);
  const auto N = hex8::shape(found.xi);
  const auto gradient = hex8::position_gradient(hex8::corners(mesh, e), found.xi);
  for (int I = 0; I < 8; ++I) ghost.nodes.push_back({mesh.elements[e][I], N[I], gradient[I]});
  return ghost;
}

/// F = 1 + Σ u_I ⊗ ∇N_I = R U at a ghost.
void deformation(const Ghost& ghost, const Mesh& mesh, double (&F)[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) F[i][j] = i == j ? 1 : 0;
  for (const GhostNode& I : ghost.nodes) {
    const Vec3 u = mesh.u.vector(I.node);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) F[i][j] = fma(u[i], I.gradient[j], F[i][j]);
  }
}

/// Turn a ghost as its hexahedron turns there. With Rᵀ δR = [w]× and δF = Σ δu_I ⊗ ∇N_I,
/// (tr U 1 − U) w = axial(Rᵀ δF − δFᵀ R): m_g does the work of R ((K m_g) × ∇N_I) on δu_I, K = (tr U 1 − U)⁻¹
/// Rᵀ.
GhostTurn turn_finitely(Lattice& lattice, const Ghost& ghost, const Mesh& mesh) {
  double F[3][3], R[3][3];
  deformation(ghost, mesh, F);
  rotation_of(F, R);
  Mat3 G{}, turned{};  // tr U 1 − U
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      turned[i][j] = R[i][j];
      G[i][j] = -(R[0][i] * F[0][j] + R[1][i] * F[1][j] + R[2][i] * F[2][j]);
      lattice.rotation[3 * j + i][ghost.site] = R[i][j] - (i == j ? 1 : 0);
    }
  const double trace = -(G[0].x + G[1].y + G[2].z);
  for (int i = 0; i < 3; ++i) G[i][i] += trace;
  const Mat3 inverse_G = inverse(G);
  Mat3 K{};
  for (int i = 0; i < 3; ++i) K[i] = turned * inverse_G[i];  // row i of G⁻¹ Rᵀ
  return {turned, K};
}

}  // namespace

void place_ghosts(Lattice& lattice, const Mesh& mesh, const Locator& locator, const std::vector<bool>& loose,
                  Reach reach) {
  const Grid& grid = lattice.grid;
  if (mesh.elements.empty()) return;
  for (std::size_t s = 0; s < grid.size(); ++s) {
    const auto [i, j, k] = grid.ijk(s);
    if (i >= grid.nx || lattice.word[s] || !within_reach(lattice, i, j, k, reach)) continue;
    const auto found = locator.find(grid.centre(s));
    if (found && (loose.empty() || !loose[region_of(mesh, found->element)]))
      lattice.ghosts.push_back(make_ghost(s, *found, mesh));
  }
  for (const Ghost& ghost : lattice.ghosts) lattice.word[ghost.site] = site::ghost;
}

void follow(Lattice& lattice, const Mesh& mesh) {
  const bool turn = lattice.ghost_rotation == GhostRotation::continuum,
             finite = lattice.kinematics == Kinematics::finite;
  if (turn && finite) lattice.ghost_turns.resize(lattice.ghosts.size());
  const auto follow_one = [&lattice, &mesh, turn, finite](std::size_t g) {
    const Ghost& ghost = lattice.ghosts[g];
    Vec3 u, curl;
    for (const auto& [node, N, gradient] : ghost.nodes) {
      const Vec3 u_I = mesh.u.vector(node);
      for (int c = 0; c < 3; ++c) u[c] = fma(N, u_I[c], u[c]);
      if (turn && !finite) curl += cross(gradient, u_I);
    }
    lattice.motion.set(ghost.site, u);
    if (turn && !finite) lattice.motion.set(ghost.site, 0.5 * curl, 3);
    if (turn && finite) lattice.ghost_turns[g] = turn_finitely(lattice, ghost, mesh);
  };
  for_each(lattice.ghosts.size(), follow_one, 1000);
}

Reactions::Reactions(const Model& model) {
  std::map<std::int32_t, std::vector<Entry>> by_node;
  for (std::size_t l = 0; l < model.lattices.size(); ++l) {
    const Lattice& lattice = model.lattices[l];
    const bool turn = lattice.ghost_rotation == GhostRotation::continuum;
    for (std::size_t g = 0; g < lattice.ghosts.size(); ++g)
      for (const auto& [node, N, gradient] : lattice.ghosts[g].nodes)
        if (N != 0 || turn)
          by_node[node].push_back({static_cast<std::int32_t>(l), static_cast<std::int32_t>(g), N,
                                   turn ? 0.5 * gradient : Vec3{}});
  }
  begin_.push_back(0);
  for (const auto& [node, entries] : by_node) {
    nodes_.push_back(node);
    entries_.insert(entries_.end(), entries.begin(), entries.end());
    begin_.push_back(static_cast<std::int32_t>(entries_.size()));
  }
}

void Reactions::add(Model& model) const {
  const auto add_one = [this, &model](std::size_t n) {
    Vec3 sum = model.mesh.f.vector(nodes_[n]);
    for (std::int32_t k = begin_[n]; k < begin_[n + 1]; ++k) {
      const Entry& entry = entries_[k];
      const Lattice& lattice = model.lattices[entry.lattice];
      const std::int32_t slot = lattice.ghost_slot[entry.ghost];
      const Vec3 force = lattice.listed_force.vector(slot), moment = lattice.listed_force.vector(slot, 3);
      for (int c = 0; c < 3; ++c) sum[c] = fma(entry.N, force[c], sum[c]);
      if (lattice.ghost_turns.empty()) {
        sum += cross(moment, entry.half_gradient);
      } else {
        const GhostTurn& turn = lattice.ghost_turns[entry.ghost];
        sum += turn.R * cross(turn.K * moment, 2 * entry.half_gradient);
      }
    }
    model.mesh.f.set(nodes_[n], sum);
  };
  for_each(nodes_.size(), add_one, 500);
}

std::vector<double> virtual_masses(const Lattice& lattice, const Mesh& mesh) {
  // m_d |Σ N_I u_I|² ≤ m_d Σ N_I |u_I|², and I_d |½ Σ ∇N_I × u_I|² ≤ ¼ I_d (Σ_J |∇N_J|) Σ |∇N_I| |u_I|²
  const bool turn = lattice.ghost_rotation == GhostRotation::continuum;
  std::vector<double> mass(mesh.nodes(), 0.0);
  for (const Ghost& ghost : lattice.ghosts) {
    double sum = 0;
    for (const GhostNode& I : ghost.nodes) sum += norm(I.gradient);
    for (const auto& [node, N, gradient] : ghost.nodes)
      mass[node] += N * lattice.mass + (turn ? 0.25 * lattice.inertia * sum * norm(gradient) : 0);
  }
  return mass;
}

}  // namespace geist::coupling
