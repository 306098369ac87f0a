#include "contact/support.hpp"

#include <cmath>
#include <numeric>

#include "coupling/ghosts.hpp"
#include "fe/elements.hpp"
#include "geometry/block.hpp"
#include "geometry/locator.hpp"
#include "geometry/packing.hpp"

namespace geist::contact::testing {

Vec3 Random::unit() {
  for (;;) {
    const Vec3 v = vector();
    if (const double n = norm(v); n > 0.1 && n < 1) return (1 / n) * v;
  }
}

Builder& Builder::hexahedra(const Box& box, const std::array<int, 3>& divisions,
                            const std::vector<Box>& minus, const Material& material) {
  steps_.push_back([=](Model& model) {
    HexRegion region;
    region.name = "block " + std::to_string(model.mesh.regions.size());
    region.material = material, region.formulation = "full";
    append_block(model.mesh, region, corners_of(box), divisions, minus);
  });
  return *this;
}

Builder& Builder::particles(const Box& box, double radius, const Material& material) {
  steps_.push_back([=](Model& model) {
    Lattice lattice;
    lattice.name = "lattice " + std::to_string(model.lattices.size());
    lattice.material = material;
    pack(lattice, {box}, {}, radius);
    lattice.mass = material.density * std::pow(2 * radius, 3);
    lattice.inertia = 0.4 * lattice.mass * radius * radius;
    model.lattices.push_back(std::move(lattice));
  });
  return *this;
}

Builder& Builder::move_nodes(const std::function<Vec3(Vec3)>& moved) {
  steps_.push_back([=](Model& model) {
    for (Vec3& p : model.mesh.points) p = moved(p);
  });
  return *this;
}

Builder& Builder::hold(const std::function<bool(Vec3)>& where) { return held_ = where, *this; }
Builder& Builder::coupled() { return coupled_ = true, *this; }
Builder& Builder::list_all() { return listed_ = true, *this; }

Model Builder::made() const {
  Model model;
  for (const auto& step : steps_) step(model);
  finish(model.mesh);
  fe::lump_masses(model.mesh);
  for (std::size_t i = 0; held_ && i < model.mesh.nodes(); ++i)
    if (held_(model.mesh.points[i])) model.mesh.held[i] = 0b111;
  for (Lattice& lattice : model.lattices) {
    if (coupled_) coupling::place_ghosts(lattice, model.mesh, Locator(model.mesh));
    trim(lattice), connect(lattice), finish(lattice);
    std::vector<std::size_t> all;
    for (std::size_t s = 0; listed_ && s < lattice.grid.size(); ++s)
      if (lattice.is(s, site::particle)) all.push_back(s);
    list_sites(lattice, all);
  }
  return model;
}

Probed::Probed(const Builder& builder)
    : model(builder.made()), surface(make_surface(model)), x(surface.nodes.size()) {
  for (std::size_t i = 0; i < surface.nodes.size(); ++i) x.set(i, model.mesh.points[surface.nodes[i]]);
  all.resize(surface.facets.size());
  std::iota(all.begin(), all.end(), 0);
}

Touch Probed::sphere(Vec3 centre, double radius) const {
  return touch(surface, x, all, {centre, radius, radius, -1, {}});
}

Touch Probed::node(Vec3 at, Vec3 outward, double reach) const {
  return touch(surface, x, all, {at, 0, reach, -1, outward});
}

LawTable one_law(std::size_t regions, std::int32_t a, std::int32_t b, const Law& law) {
  LawTable laws(regions);
  laws.set(a, b, law);
  return laws;
}

void move_at_random(Model& model, Random& random, double displacement, double velocity) {
  Mesh& mesh = model.mesh;
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    mesh.u.set(i, mesh.u.vector(i) + random.vector(displacement)), mesh.v.set(i, random.vector(velocity));
  for (Lattice& lattice : model.lattices)
    for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
      if (!lattice.is(s, site::particle)) continue;
      lattice.motion.add(s, random.vector(displacement));
      lattice.velocity.set(s, random.vector(velocity));
      lattice.velocity.set(s, random.vector(velocity / lattice.radius()), 3);
    }
}

}  // namespace geist::contact::testing
