#include "solver/loads.hpp"

#include <cmath>

#include "core/parallel.hpp"

namespace geist {
namespace {

/// Σ m u over everything.
Vec3 mass_moment(const Model& model) {
  const Mesh& mesh = model.mesh;
  Vec3 total = sum<Vec3>(mesh.nodes(), [&mesh](std::size_t i) { return mesh.mass[i] * mesh.u.vector(i); });
  for (const Lattice& lattice : model.lattices)
    total += lattice.mass * sum<Vec3>(lattice.grid.size(), [&lattice](std::size_t s) {
               return lattice.is(s, site::particle) ? lattice.motion.vector(s) : Vec3{};
             });
  return total;
}

/// q = Σ F·u
double conjugate_displacement(const Load& load, const Model& model) {
  if (load.is_gravity) return dot(load.gravity, mass_moment(model));
  double q = 0;
  for (const NodeForce& p : load.nodes) q += dot(p.force, model.mesh.u.vector(p.node));
  for (const ParticleForce& p : load.particles)
    q += dot(p.force, model.lattices[p.lattice].motion.vector(p.site));
  return q;
}

}  // namespace

void add_loads(const std::vector<Load>& loads, Model& model, double t) {
  for (const Load& load : loads) {
    const double c = load.curve.at(t);
    const auto add_to_node = [&, c](std::size_t i) {
      model.mesh.f.add(load.nodes[i].node, c * load.nodes[i].force);
    };
    const auto add_to_particle = [&, c](std::size_t i) {
      const ParticleForce& p = load.particles[i];
      model.lattices[p.lattice].listed_force.add(p.slot, c * p.force);
    };
    for_each(load.nodes.size(), add_to_node, 500);  // a load names a place once only
    for_each(load.particles.size(), add_to_particle, 500);
  }
}

Vec3 gravity(const std::vector<Load>& loads, double t) {
  Vec3 g;
  for (const Load& load : loads)
    if (load.is_gravity) g += load.curve.at(t) * load.gravity;
  return g;
}

void settle(std::vector<Load>& loads, const Model& model, double until) {
  for (Load& load : loads) {
    const double now = model.time;
    if (until > now && load.curve.constant_over(load.t_settled, until)) continue;
    const double q = conjugate_displacement(load, model);
    load.work += 0.5 * (load.curve.at(load.t_settled) + load.curve.at(now)) * (q - load.q_settled);
    load.q_settled = q, load.t_settled = now;
  }
}

void reckon_proportional(std::vector<Load>& loads, const Model& model) {
  for (Load& load : loads) load.work = 0.5 * load.curve.at(model.time) * conjugate_displacement(load, model);
}

double norm(const std::vector<Load>& loads, const Model& model, double t) {
  double squares = 0;
  for (const Load& load : loads) {
    const double c = load.curve.at(t);
    for (const NodeForce& p : load.nodes) squares += c * c * dot(p.force, p.force);
    for (const ParticleForce& p : load.particles) squares += c * c * dot(p.force, p.force);
  }
  const Vec3 g = gravity(loads, t);
  const double g2 = dot(g, g);
  if (g2 > 0) {
    for (const double m : model.mesh.mass) squares += m * m * g2;
    for (const Lattice& l : model.lattices)
      squares += static_cast<double>(l.count(site::particle)) * l.mass * l.mass * g2;
  }
  return std::sqrt(squares);
}

}  // namespace geist
