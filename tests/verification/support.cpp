#include "verification/support.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "core/parallel.hpp"

namespace geist::verification {
namespace {

reference::Description describe(const Case& input, const Mesh& mesh) {
  reference::Description d;
  d.nodes = mesh.points;
  for (const HexRegion& region : mesh.regions)
    for (std::size_t e = region.first; e < region.first + region.count; ++e)
      d.hexahedra.push_back(
          {mesh.elements[e], region.material, region.formulation, region.hourglass_coefficient});
  for (const RegionSpec& spec : input.regions)
    if (const auto* lattice = std::get_if<LatticeSpec>(&spec.shape)) {
      d.lattice = lattice->boxes, d.radius = lattice->radius;
      d.lattice_material = input.materials.at(spec.material);
      d.cube_inertia = lattice->rotary_inertia == "cube";
    }
  d.ghosts_spin = input.rotation == "one-step-back";
  return d;
}

/// The particle at that site.
reference::Point& particle_at(reference::Incremental& body, const Lattice& lattice, std::size_t site) {
  for (reference::Point& p : body.particles)
    if (norm(p.X - lattice.grid.centre(site)) < 0.1 * lattice.radius()) return p;
  throw std::logic_error("the reference has no particle there");
}

void act_on(reference::Incremental& body, const Simulation& sim) {
  for (const Load& load : sim.loads) {
    for (const NodeForce& p : load.nodes) body.nodes[p.node].load += p.force;
    for (const ParticleForce& p : load.particles)
      particle_at(body, sim.model.lattices[p.lattice], p.site).load += p.force;
  }
  for (const HeldComponent& h : sim.supports.held)
    (h.lattice < 0 ? body.nodes[h.place] : particle_at(body, sim.model.lattices[h.lattice], h.place)).held =
        true;
}

}  // namespace

Case example(const std::string& name, const std::vector<std::string>& set) {
  return read_case(fmt::format("{}/examples/{}/case.toml", GEIST_SOURCE_DIR, name), set);
}

Case published(const std::string& name, std::vector<std::string> set) {
  set.push_back("method=published");
  return example(name, set);
}

Outcome run_to_end(const Case& input, Built& built, const std::vector<Observer*>& observers) {
  set_threads(1);
  return run(built.simulation, plan_of(input), observers);
}

double static_tip(const Case& input) {
  Built built = build(input);
  const Outcome outcome = run_to_end(input, built);
  if (outcome.status != Status::completed) throw std::runtime_error(outcome.message);
  return -built.probes.at(0).value(built.simulation);
}

std::string hexahedra(const std::string& region, double from, double to, const std::string& divisions) {
  return fmt::format(
      "regions.{}={{type=\"hexahedra\",material=\"polymer\",box=[[{},0,0],[{},2,2]],divisions={}}}", region,
      from, to, divisions);
}

reference::Incremental reference_of(const Case& input, const Simulation& sim) {
  reference::Incremental body(describe(input, sim.model.mesh));
  act_on(body, sim);
  for (std::size_t i = 0; i < body.nodes.size(); ++i) body.nodes[i].v = sim.model.mesh.v.vector(i);
  const Lattice& lattice = sim.model.lattices.at(0);
  for (reference::Point& p : body.particles) {
    p.v = lattice.velocity.vector(site_at(lattice, p.X));
    p.omega = lattice.velocity.vector(site_at(lattice, p.X), 3);
  }
  for (reference::Point& g : body.ghosts) g.omega = lattice.velocity.vector(site_at(lattice, g.X), 3);
  for (std::vector<reference::Point>* points : {&body.nodes, &body.particles})
    for (reference::Point& p : *points)
      if (p.held) p.v = p.omega = {};
  return body;
}

std::size_t site_at(const Lattice& lattice, Vec3 X) {
  const Vec3 steps = (1 / lattice.grid.pitch) * (X - lattice.grid.origin);
  const int i = static_cast<int>(std::lround(steps.x)), j = static_cast<int>(std::lround(steps.y)),
            k = static_cast<int>(std::lround(steps.z));
  if (!lattice.grid.contains(i, j, k) || norm(lattice.grid.centre(i, j, k) - X) > 0.1 * lattice.radius())
    throw std::logic_error("no site there");
  return lattice.grid.index(i, j, k);
}

}  // namespace geist::verification
