#include "coupling/ghosts.hpp"

#include <map>

#include "core/parallel.hpp"
#include "geometry/hex8.hpp"

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
      lattice.ghosts.push_back({s, found->element, found->xi, hex8::shape(found->xi)});
  }
  for (const Ghost& ghost : lattice.ghosts) lattice.word[ghost.site] = site::ghost;
}

void follow(Lattice& lattice, const Mesh& mesh) {
  double* const u[3] = {lattice.motion[0], lattice.motion[1], lattice.motion[2]};
  const double* const u_node[3] = {mesh.u[0], mesh.u[1], mesh.u[2]};
  const Ghost* const ghosts = lattice.ghosts.data();
  const auto* const elements = mesh.elements.data();
  const auto follow_one = [=](std::size_t g) {
    const auto& node = elements[ghosts[g].element];
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (int I = 0; I < 8; ++I) sum = fma(ghosts[g].N[I], u_node[c][node[I]], sum);
      u[c][ghosts[g].site] = sum;
    }
  };
  for_each(lattice.ghosts.size(), follow_one, 2000);
}

Reactions::Reactions(const Model& model) {
  std::map<std::int32_t, std::vector<Entry>> by_node;
  for (std::size_t l = 0; l < model.lattices.size(); ++l) {
    const Lattice& lattice = model.lattices[l];
    for (std::size_t g = 0; g < lattice.ghosts.size(); ++g)
      for (int I = 0; I < 8; ++I)
        if (lattice.ghosts[g].N[I] != 0)
          by_node[model.mesh.elements[lattice.ghosts[g].element][I]].push_back(
              {static_cast<std::int32_t>(l), lattice.ghost_slot[g], lattice.ghosts[g].N[I]});
  }
  begin_.push_back(0);
  for (const auto& [node, entries] : by_node) {
    nodes_.push_back(node);
    entries_.insert(entries_.end(), entries.begin(), entries.end());
    begin_.push_back(static_cast<std::int32_t>(entries_.size()));
  }
}

void Reactions::add(Model& model) const {
  struct ForceView {
    const double* c[3];
  };
  std::vector<ForceView> views;
  for (const Lattice& l : model.lattices)
    views.push_back({{l.listed_force[0], l.listed_force[1], l.listed_force[2]}});
  double* const f[3] = {model.mesh.f[0], model.mesh.f[1], model.mesh.f[2]};
  const auto add_one = [=, force = views.data(), nodes = nodes_.data(), begin = begin_.data(),
                        entries = entries_.data()](std::size_t n) {
    for (int c = 0; c < 3; ++c) {
      double sum = f[c][nodes[n]];
      for (std::int32_t k = begin[n]; k < begin[n + 1]; ++k)
        sum = fma(entries[k].N, force[entries[k].lattice].c[c][entries[k].slot], sum);
      f[c][nodes[n]] = sum;
    }
  };
  for_each(nodes_.size(), add_one, 500);
}

std::vector<double> virtual_masses(const Lattice& lattice, const Mesh& mesh) {
  std::vector<double> mass(mesh.nodes(), 0.0);
  for (const Ghost& ghost : lattice.ghosts)
    for (int I = 0; I < 8; ++I) mass[mesh.elements[ghost.element][I]] += ghost.N[I] * lattice.mass;
  return mass;
}

}  // namespace geist::coupling
