#include "contact/contactors.hpp"

#include <algorithm>

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

}  // namespace

double Places::follow(const Model& model) {
  struct Largest {
    double square = 0;
    Largest& operator+=(const Largest& b) { return square = std::max(square, b.square), *this; }
  };
  const Mesh& mesh = model.mesh;
  return sum<Largest>(list.size(),
                      [this, &model, &mesh](std::size_t i) {
                        const auto [lattice, index] = list[i];
                        const Vec3 now = lattice < 0 ? mesh.X.vector(index) + mesh.u.vector(index)
                                                     : model.lattices[lattice].grid.centre(index) +
                                                           model.lattices[lattice].motion.vector(index);
                        x.set(i, now);
                        const Vec3 moved = now - x_searched.vector(i);
                        return Largest{dot(moved, moved)};
                      })
      .square;
}

std::vector<Contactor> make_contactors(const Model& model, const Surface& surface, const LawTable& laws,
                                       Places& places) {
  std::vector<Contactor> contactors;
  for (const std::int32_t node : surface.nodes) places.list.push_back({-1, static_cast<std::size_t>(node)});
  add_nodes(surface, contactors);
  const std::vector<std::uint8_t> touching = laws.touching();
  for (std::size_t l = 0; l < model.lattices.size(); ++l) {
    const Lattice& lattice = model.lattices[l];
    const auto region = static_cast<std::int32_t>(model.mesh.regions.size() + l);
    if (!touching[region]) continue;
    for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
      if (!lacks_bonds(lattice, s)) continue;
      const double r = lattice.radius();
      contactors.push_back({static_cast<std::int32_t>(places.list.size()), region, r, 0, r});
      places.list.push_back({static_cast<std::int32_t>(l), s});
    }
  }
  const std::size_t n = places.list.size();
  places.x = Field<3>(n), places.x_searched = Field<3>(n), places.inverse_mass = Field<3>(n);
  for (std::size_t i = 0; i < n; ++i) places.inverse_mass.set(i, inverse_mass(model, places.list[i]));
  return contactors;
}

}  // namespace geist::contact
