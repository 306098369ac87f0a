#include "solver/probes.hpp"

#include <algorithm>
#include <limits>

#include "de/rotation.hpp"

namespace geist {
namespace {

double component_of(Vec3 a, int component) { return component < 3 ? a[component] : norm(a); }

Vec3 at_node(const Mesh& mesh, Probe::Quantity quantity, std::int32_t node) {
  if (quantity == Probe::Quantity::velocity) return 0.5 * (mesh.v_before.vector(node) + mesh.v.vector(node));
  return mesh.u.vector(node);
}

Vec3 at_particle(const Lattice& lattice, Probe::Quantity quantity, std::size_t s) {
  if (quantity == Probe::Quantity::velocity)
    return 0.5 * (lattice.velocity_before.vector(s) + lattice.velocity.vector(s));
  return quantity == Probe::Quantity::rotation ? de::rotation_vector(lattice, s) : lattice.motion.vector(s);
}

double reaction(const Probe& probe, const Simulation& sim) {
  Vec3 total;
  for (const std::size_t i : probe.held) {
    const HeldComponent& h = sim.supports.held[i];
    if (h.component < 3) total[h.component] += h.reaction;
  }
  return component_of(total, probe.component);
}

/// Resultant of the contact forces on the selection; nodes and particles are in ascending order.
double contact_force(const Probe& probe, const Simulation& sim) {
  const auto selected = [&](const contact::Place& place) {
    if (place.lattice < 0)
      return std::binary_search(probe.nodes.begin(), probe.nodes.end(),
                                static_cast<std::int32_t>(place.index));
    return std::binary_search(probe.particles.begin(), probe.particles.end(),
                              ParticleId{place.lattice, place.index});
  };
  Vec3 total;
  for (const contact::TouchedPlace& touched : sim.contacts.touched())
    if (selected(touched.place)) total += touched.force;
  return component_of(total, probe.component);
}

}  // namespace

double Probe::value(const Simulation& sim) const {
  if (quantity == Quantity::reaction) return reaction(*this, sim);
  if (quantity == Quantity::contact_force) return contact_force(*this, sim);
  double sum = 0, low = std::numeric_limits<double>::infinity(), high = -low;
  const auto take = [&](Vec3 a) {
    const double x = component_of(a, component);
    sum += x, low = std::min(low, x), high = std::max(high, x);
  };
  if (quantity != Quantity::rotation)
    for (const std::int32_t node : nodes) take(at_node(sim.model.mesh, quantity, node));
  for (const auto& [lattice, site] : particles)
    take(at_particle(sim.model.lattices[lattice], quantity, site));
  const auto count =
      static_cast<double>((quantity == Quantity::rotation ? 0 : nodes.size()) + particles.size());
  switch (reduce) {
    case Reduce::min:
      return low;
    case Reduce::max:
      return high;
    case Reduce::sum:
      return sum;
    case Reduce::mean:
      return sum / count;
  }
  return sum;
}

}  // namespace geist
