#include "case/select.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/bounds.hpp"

namespace geist {
namespace {

/// Whether faces may lie in it: in one plane they do, but two make an edge and three a point.
bool may_hold_faces(const Where& where) {
  return std::count_if(where.axis.begin(), where.axis.end(), [](const auto& a) { return a && a->plane(); }) ==
         1;
}

}  // namespace

Selector::Selector(const Model& model)
    : model_(model), facets_(exterior_facets(model.mesh)), bounds_(geist::bounds(model)) {
  for (int c = 0; c < 3; ++c)
    slack_ = std::max({slack_, 1e-8 * std::abs(bounds_.low[c]), 1e-8 * std::abs(bounds_.high[c])});
  for (const HexRegion& region : model.mesh.regions) {
    std::vector<bool>& in = node_in_region_.emplace_back(model.mesh.nodes(), false);
    for (std::size_t e = region.first; e < region.first + region.count; ++e)
      for (const std::int32_t node : model.mesh.elements[e]) in[node] = true;
  }
}

bool Selector::node_in(const Where& where, std::int32_t node) const {
  for (int c = 0; c < 3; ++c) {
    const double x = model_.mesh.points[node][c];
    const auto& a = where.axis[c];
    if (a && (x < a->low - slack_ || x > a->high + slack_)) return false;
  }
  if (!where.region) return true;
  for (std::size_t r = 0; r < model_.mesh.regions.size(); ++r)
    if (model_.mesh.regions[r].name == *where.region) return node_in_region_[r][node];
  return false;
}

bool Selector::particle_in(const Where& where, const Lattice& lattice, std::size_t s) const {
  if (!lattice.is(s, site::particle) || (where.region && *where.region != lattice.name)) return false;
  const Vec3 x = lattice.grid.centre(s);
  for (int c = 0; c < 3; ++c) {
    const auto& a = where.axis[c];
    const double margin = a && a->plane() ? lattice.radius() + slack_ : slack_;
    if (a && (x[c] < a->low - margin || x[c] > a->high + margin)) return false;
  }
  return true;
}

Selection Selector::select(const Where& where) const {
  Selection found;
  for (std::size_t i = 0; i < model_.mesh.nodes(); ++i)
    if (node_in(where, static_cast<std::int32_t>(i))) found.nodes.push_back(static_cast<std::int32_t>(i));
  for (std::size_t l = 0; l < model_.lattices.size(); ++l)
    for (std::size_t s = 0; s < model_.lattices[l].grid.size(); ++s)
      if (particle_in(where, model_.lattices[l], s))
        found.particles.push_back({static_cast<std::int32_t>(l), s});
  return found;
}

double Selector::exposed_area(const Where& where, const ParticleId& particle) const {
  if (!may_hold_faces(where)) return 0;
  const Lattice& lattice = model_.lattices[particle.lattice];
  const Grid& grid = lattice.grid;
  const auto at = grid.ijk(particle.site);
  const Vec3 x = grid.centre(particle.site);
  double area = 0;
  for (int c = 0; c < 3; ++c) {
    if (!where.axis[c] || !where.axis[c]->plane()) continue;
    for (const int side : {-1, 1}) {
      auto next = at;
      next[c] += side;
      const bool taken = grid.contains(next[0], next[1], next[2]) &&
                         lattice.word[grid.index(next[0], next[1], next[2])] != 0;
      const bool on_plane = std::abs(x[c] + side * lattice.radius() - where.axis[c]->low) <= slack_;
      if (on_plane && !taken) area += grid.pitch * grid.pitch;
    }
  }
  return area;
}

std::vector<double> Selector::node_areas(const Where& where) const {
  std::vector<double> area(model_.mesh.nodes(), 0.0);
  if (!may_hold_faces(where)) return area;
  for (const Facet& facet : facets_) {
    if (!std::all_of(facet.node.begin(), facet.node.end(), [&](auto n) { return node_in(where, n); }))
      continue;
    const auto share = tributary_areas(model_.mesh, facet);
    for (int a = 0; a < 4; ++a) area[facet.node[a]] += share[a];
  }
  return area;
}

Selector::Shares Selector::shares(const Where& where, const Selection& selection) const {
  Shares s;
  const std::vector<double> area = node_areas(where);
  for (const std::int32_t node : selection.nodes) s.nodes.push_back(area[node]), s.total += area[node];
  for (const ParticleId& p : selection.particles)
    s.particles.push_back(exposed_area(where, p)), s.total += s.particles.back();
  s.by_area = s.total > 0;
  if (!s.by_area) {
    for (std::size_t i = 0; i < selection.nodes.size(); ++i)
      s.total += s.nodes[i] = model_.mesh.mass[selection.nodes[i]];
    for (std::size_t i = 0; i < selection.particles.size(); ++i)
      s.total += s.particles[i] = model_.lattices[selection.particles[i].lattice].mass;
  }
  for (double& x : s.nodes) x /= s.total;
  for (double& x : s.particles) x /= s.total;
  return s;
}

}  // namespace geist
