#include "contact/contactors.hpp"

#include <algorithm>
#include <utility>

#include "core/disjoint_sets.hpp"
#include "core/parallel.hpp"

namespace geist::contact {
namespace {

/// A node once for each region whose facets it belongs to, with a quarter of each of these facets.
void add_nodes(const Surface& surface, std::vector<Contactor>& contactors) {
  for (std::size_t i = 0; i < surface.nodes.size(); ++i) {
    const std::size_t first = contactors.size();
    for (std::int32_t s = surface.around_begin[i]; s < surface.around_begin[i + 1]; ++s) {
      const SurfaceFacet& facet = surface.facets[surface.around[s] / 4];
      const double area = facet.area / 4;
      auto it = std::find_if(contactors.begin() + static_cast<std::ptrdiff_t>(first), contactors.end(),
                             [&](const Contactor& c) { return c.region == facet.region; });
      if (it == contactors.end())
        it = contactors.insert(it, {static_cast<std::int32_t>(i), facet.region, 0, 0, 0});
      it->depth = (it->depth * it->area + facet.depth * area) / (it->area + area);
      it->area += area;
    }
  }
}

bool lacks_bonds(const Lattice& lattice, std::size_t s) {
  return lattice.is(s, site::particle) && (lattice.word[s] & site::bonds) != site::bonds;
}

Vec3 free_inverse(double mass, std::uint8_t held) {
  Vec3 inverse;
  for (int c = 0; c < 3; ++c) inverse[c] = held >> c & 1 ? 0 : 1 / mass;
  return inverse;
}

Vec3 inverse_mass(const Model& model, Place place) {
  if (place.lattice < 0) return free_inverse(model.mesh.mass[place.index], model.mesh.held[place.index]);
  const Lattice& lattice = model.lattices[place.lattice];
  const bool listed = !lattice.is(place.index, site::free);
  return free_inverse(lattice.mass, listed ? lattice.listed_held[listed_slot(lattice, place.index)] : 0);
}

/// Displacements by index at the present time: u + ahead v, to the bit what a drift makes of them.
struct Displacement {
  std::array<const double*, 3> u, v;
  double ahead;
  double operator()(int c, std::int32_t i) const {
    return ahead > 0 ? fma(ahead, v[c][i], u[c][i]) : u[c][i];
  }
};

Displacement displacement_of(const Model& model, const PlaceRange& range, double ahead) {
  if (range.lattice < 0) return {components<3>(model.mesh.u), components<3>(model.mesh.v), 0};
  const Lattice& lattice = model.lattices[range.lattice];
  return {components<3>(lattice.motion), components<3>(lattice.velocity), ahead};
}

/// Moves places of a range and measures how far they went.
struct Follower {
  std::array<double*, 3> x;
  std::array<const double*, 3> X, searched;
  Displacement u;
  const std::int32_t* index;

  Follower(Places& places, const Displacement& displacement)
      : x(components<3>(places.x)),
        X(components<3>(std::as_const(places.X))),
        searched(components<3>(std::as_const(places.x_searched))),
        u(displacement),
        index(places.index.data()) {}

  /// Lowest and highest displacement since the last search of the places first ≤ i < last.
  Box operator()(std::size_t first, std::size_t last) const {
    Box extent = nowhere();
    for (int c = 0; c < 3; ++c) {
      double low = extent.low[c], high = extent.high[c];
      for (std::size_t i = first; i < last; ++i) {
        const double now = X[c][i] + u(c, index[i]), moved = now - searched[c][i];
        x[c][i] = now;
        low = moved < low ? moved : low, high = moved > high ? moved : high;
      }
      extent.low[c] = low, extent.high[c] = high;
    }
    return extent;
  }
};

/// Regions of hexahedra that share nodes, as one number each: of the first of them.
std::vector<std::int32_t> clusters(const Model& model) {
  const Mesh& mesh = model.mesh;
  const std::size_t regions = mesh.regions.size() + model.lattices.size();
  DisjointSets sets(regions);
  std::vector<std::int32_t> owner(mesh.nodes(), -1);
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    const HexRegion& region = mesh.regions[r];
    for (std::size_t e = region.first; e < region.first + region.count; ++e)
      for (const std::int32_t node : mesh.elements[e]) {
        if (owner[node] < 0) owner[node] = static_cast<std::int32_t>(r);
        sets.join(static_cast<std::size_t>(owner[node]), r);
      }
  }
  std::vector<std::int32_t> cluster;
  for (std::size_t r = 0; r < regions; ++r) cluster.push_back(static_cast<std::int32_t>(sets.of(r)));
  return cluster;
}

/// Ranges of the surface's nodes, cluster by cluster.
void add_node_ranges(const Surface& surface, Places& places) {
  std::vector<std::int32_t> cluster_of(surface.nodes.size());
  for (const SurfaceFacet& facet : surface.facets)
    for (const std::int32_t corner : facet.corner) cluster_of[corner] = places.cluster[facet.region];
  for (std::size_t i = 0; i < surface.nodes.size(); ++i) {
    if (places.ranges.empty() || places.ranges.back().cluster != cluster_of[i])
      places.ranges.push_back({-1, cluster_of[i], i, i});
    ++places.ranges.back().end;
    places.list.push_back({-1, static_cast<std::size_t>(surface.nodes[i])});
  }
}

Vec3 reference_position(const Model& model, Place place) {
  return place.lattice < 0 ? model.mesh.points[place.index]
                           : model.lattices[place.lattice].grid.centre(place.index);
}

/// The arrays of places whose list is complete.
void finish(Places& places, const Model& model) {
  const std::size_t n = places.list.size();
  places.X = Field<3>(n), places.x = Field<3>(n), places.x_searched = Field<3>(n);
  places.inverse_mass = Field<3>(n);
  for (std::size_t i = 0; i < n; ++i) {
    places.index.push_back(static_cast<std::int32_t>(places.list[i].index));
    places.X.set(i, reference_position(model, places.list[i]));
    places.inverse_mass.set(i, inverse_mass(model, places.list[i]));
  }
  places.moved.assign(places.cluster.size(), nowhere());
}

}  // namespace

/// Every thread follows the rows that it moves: what others read would have to be fetched back to be written.
void Places::follow(const Model& model, double ahead) {
  std::fill(moved.begin(), moved.end(), nowhere());
  std::vector<Box> extents(static_cast<std::size_t>(threads()));
  for (const PlaceRange& range : ranges) {
    const Grid* const grid = range.lattice < 0 ? nullptr : &model.lattices[range.lattice].grid;
    const std::size_t rows = grid ? grid->rows() : model.mesh.nodes(), stride = grid ? grid->stride() : 1;
    const Follower follow{*this, displacement_of(model, range, ahead)};
    std::fill(extents.begin(), extents.end(), nowhere());
    for_each_share(rows, [=, this, extent = extents.data()](Indices share) {
      extent[share.number] =
          follow(first_from(range, share.begin * stride), first_from(range, share.end * stride));
    });
    for (const Box& extent : extents) widen(moved[range.cluster], extent);
  }
}

std::size_t Places::first_from(const PlaceRange& range, std::size_t i) const {
  const std::int32_t* const all = index.data();
  return static_cast<std::size_t>(
      std::lower_bound(all + range.begin, all + range.end, static_cast<std::int32_t>(i)) - all);
}

std::vector<Contactor> make_contactors(const Model& model, const Surface& surface, const LawTable& laws,
                                       Places& places) {
  std::vector<Contactor> contactors;
  places.cluster = clusters(model);
  add_node_ranges(surface, places);
  add_nodes(surface, contactors);
  const std::vector<std::uint8_t> touching = laws.touching();
  for (std::size_t l = 0; l < model.lattices.size(); ++l) {
    const Lattice& lattice = model.lattices[l];
    const auto region = static_cast<std::int32_t>(model.mesh.regions.size() + l);
    if (!touching[region]) continue;
    const std::size_t first = places.list.size();
    for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
      if (!lacks_bonds(lattice, s)) continue;
      const double r = lattice.radius();
      contactors.push_back({static_cast<std::int32_t>(places.list.size()), region, r, 0, r});
      places.list.push_back({static_cast<std::int32_t>(l), s});
    }
    places.ranges.push_back({static_cast<std::int32_t>(l), region, first, places.list.size()});
  }
  finish(places, model);
  return contactors;
}

}  // namespace geist::contact
