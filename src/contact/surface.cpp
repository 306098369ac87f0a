#include "contact/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "geometry/facets.hpp"
#include "geometry/hex8.hpp"
#include "geometry/triangle.hpp"

namespace geist::contact {
namespace {

/// Whether this facet of a region is a lattice's interface: its ghosts ride there, and its particles touch it
/// at rest.
class InterfaceFinder {
 public:
  explicit InterfaceFinder(const Model& model) : model_(model) {
    for (const Lattice& lattice : model.lattices) {
      hosts_.emplace_back(model.mesh.regions.size(), false);
      for (const Ghost& ghost : lattice.ghosts) hosts_.back()[region_of(model.mesh, ghost.element)] = true;
    }
  }

  bool operator()(std::int32_t region, const std::array<Vec3, 4>& corner) const {
    for (std::size_t l = 0; l < hosts_.size(); ++l)
      if (hosts_[l][region] && touches(model_.lattices[l], corner)) return true;
    return false;
  }

 private:
  static bool touches(const Lattice& lattice, const std::array<Vec3, 4>& corner) {
    const Grid& grid = lattice.grid;
    const Vec3 centre = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
    const double r = lattice.radius(), reach = r * (1 + 1e-6);
    std::array<int, 3> low{}, high{};
    const std::array<int, 3> n{grid.nx, grid.ny, grid.nz};
    for (int c = 0; c < 3; ++c) {
      const auto [a, b] = std::minmax({corner[0][c], corner[1][c], corner[2][c], corner[3][c]});
      low[c] = std::max(0, static_cast<int>(std::floor((a - reach - grid.origin[c]) / grid.pitch)));
      high[c] = std::min(n[c] - 1, static_cast<int>(std::ceil((b + reach - grid.origin[c]) / grid.pitch)));
    }
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i) {
          if (!lattice.is(grid.index(i, j, k), site::particle)) continue;
          const Vec3 x = grid.centre(i, j, k);
          for (int e = 0; e < 4; ++e)
            if (norm(x - nearest_point(x, corner[e], corner[(e + 1) % 4], centre).p) <= reach) return true;
        }
    return false;
  }
  const Model& model_;
  std::vector<std::vector<bool>> hosts_;  ///< by lattice and region: whether its ghosts ride there
};

SurfaceFacet make_facet(const Mesh& mesh, const Facet& facet) {
  const auto areas = tributary_areas(mesh, facet);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double volume = hex8::volume(hex8::corners(mesh, static_cast<std::size_t>(facet.element)));
  return {facet.node, {-1, -1, -1, -1}, 0, 0, area, volume / (2 * area)};
}

/// Corners become places in surface.nodes, and the lists around them are made.
void number_nodes(Surface& surface, std::size_t mesh_nodes) {
  std::vector<std::int32_t> place(mesh_nodes, -1);
  for (const SurfaceFacet& facet : surface.facets)
    for (const std::int32_t node : facet.corner) place[node] = 0;
  for (std::size_t i = 0; i < mesh_nodes; ++i)
    if (place[i] == 0) {
      place[i] = static_cast<std::int32_t>(surface.nodes.size());
      surface.nodes.push_back(static_cast<std::int32_t>(i));
    }
  surface.around_begin.assign(surface.nodes.size() + 1, 0);
  for (SurfaceFacet& facet : surface.facets)
    for (std::int32_t& corner : facet.corner) ++surface.around_begin[(corner = place[corner]) + 1];
  std::partial_sum(surface.around_begin.begin(), surface.around_begin.end(), surface.around_begin.begin());
  surface.around.resize(surface.around_begin.back());
  std::vector<std::int32_t> next(surface.around_begin.begin(), surface.around_begin.end() - 1);
  for (std::size_t f = 0; f < surface.facets.size(); ++f)
    for (int k = 0; k < 4; ++k)
      surface.around[next[surface.facets[f].corner[k]]++] = static_cast<std::int32_t>(4 * f) + k;
}

/// Facets whose edges run along each other in opposite directions are neighbours. Where four meet in an edge
/// (two blocks that touch there), they have none.
void find_neighbours(Surface& surface) {
  std::unordered_map<std::uint64_t, std::vector<std::int32_t>> edges;  // by nodes from → to: 4 · facet + edge
  const auto key = [](std::int32_t from, std::int32_t to) {
    return static_cast<std::uint64_t>(from) << 32 | static_cast<std::uint32_t>(to);
  };
  for (std::size_t f = 0; f < surface.facets.size(); ++f)
    for (int k = 0; k < 4; ++k) {
      const auto& corner = surface.facets[f].corner;
      edges[key(corner[k], corner[(k + 1) % 4])].push_back(static_cast<std::int32_t>(4 * f) + k);
    }
  for (SurfaceFacet& facet : surface.facets)
    for (int k = 0; k < 4; ++k) {
      const auto it = edges.find(key(facet.corner[(k + 1) % 4], facet.corner[k]));
      if (it != edges.end() && it->second.size() == 1) facet.across[k] = it->second[0] / 4;
    }
}

double angle_between(Vec3 a, Vec3 b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

}  // namespace

Surface make_surface(const Model& model, const std::vector<std::uint8_t>& wanted) {
  const Mesh& mesh = model.mesh;
  Surface surface;
  const std::vector<std::int32_t> body = bodies_of(mesh);
  const InterfaceFinder at_interface(model);
  for (const Facet& exterior : exterior_facets(mesh)) {
    const std::int32_t region = region_of(mesh, exterior.element);
    if (!wanted.empty() && !wanted[region]) continue;
    std::array<Vec3, 4> corner;
    for (int k = 0; k < 4; ++k) corner[k] = mesh.points[exterior.node[k]];
    if (at_interface(region, corner)) continue;
    SurfaceFacet facet = make_facet(mesh, exterior);
    facet.region = region, facet.body = body[exterior.node[0]];
    surface.facets.push_back(facet);
  }
  number_nodes(surface, mesh.nodes());
  surface.node_area.assign(surface.nodes.size(), 0);
  for (const SurfaceFacet& facet : surface.facets)
    for (const std::int32_t corner : facet.corner) surface.node_area[corner] += facet.area / 4;
  find_neighbours(surface);
  return surface;
}

FacetPoints points_of(const SurfaceFacet& facet, const Field<3>& x) {
  FacetPoints at;
  for (int k = 0; k < 4; ++k) at.corner[k] = x.vector(facet.corner[k]);
  at.centre = 0.25 * (at.corner[0] + at.corner[1] + at.corner[2] + at.corner[3]);
  return at;
}

Vec3 node_normal(const Surface& surface, const Field<3>& x, std::int32_t node) {
  Vec3 normal;
  for (std::int32_t s = surface.around_begin[node]; s < surface.around_begin[node + 1]; ++s) {
    const int k = surface.around[s] % 4;
    const FacetPoints at = points_of(surface.facets[surface.around[s] / 4], x);
    const Vec3 corner = at.corner[k];
    for (const int triangle : {k, (k + 3) % 4}) {
      const Vec3 other = at.corner[triangle == k ? (k + 1) % 4 : triangle];
      const Vec3 n = triangle_normal(at, triangle);
      normal += angle_between(other - corner, at.centre - corner) / norm(n) * n;
    }
  }
  return normal;
}

Vec3 area_vector(const Surface& surface, const Field<3>& x, std::int32_t node, std::int32_t region) {
  Vec3 total;
  for (std::int32_t s = surface.around_begin[node]; s < surface.around_begin[node + 1]; ++s) {
    const SurfaceFacet& facet = surface.facets[surface.around[s] / 4];
    if (facet.region != region) continue;
    const Vec3 normal = facet_normal(points_of(facet, x));
    total += (0.25 * facet.area / norm(normal)) * normal;
  }
  return total;
}

}  // namespace geist::contact
