#include "solver/time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "coupling/ghosts.hpp"
#include "de/bonds.hpp"
#include "fe/elements.hpp"
#include "fe/formulations.hpp"
#include "fe/parameters.hpp"

namespace geist {
namespace {

/// What the elements, the ghosts and contacts contribute to ω² at every node, times its mass.
struct NodeBounds {
  std::vector<double> elements, ghosts, contacts;
};

NodeBounds node_bounds(const Model& model, const contact::Contacts& contacts) {
  const Mesh& mesh = model.mesh;
  NodeBounds at{std::vector<double>(mesh.nodes(), 0.0), std::vector<double>(mesh.nodes(), 0.0),
                contacts.node_charges(model)};
  const std::vector<double> omega2 = fe::frequencies_squared(mesh);
  fe::visit_corner_masses(mesh, [&](std::size_t e, const std::array<double, 8>& m) {
    for (int a = 0; a < 8; ++a) at.elements[mesh.elements[e][a]] += omega2[e] * m[a];
  });
  for (const Lattice& lattice : model.lattices) {
    if (lattice.ghosts.empty()) continue;
    const double omega2_L = de::largest_frequency_squared(lattice);
    const std::vector<double> mass = coupling::virtual_masses(lattice, mesh);
    for (std::size_t i = 0; i < mass.size(); ++i) at.ghosts[i] += omega2_L * mass[i];
  }
  return at;
}

bool has_viscous_control(const HexRegion& region) {
  bool viscous = false;
  fe::visit_formulation(region.formulation, fe::parameters(region),
                        [&](const auto& formulation) { viscous = formulation.uses_velocity; });
  return viscous;
}

/// Smallest ω² that bounds a node with ω_e² from its elements and g from its ghosts. Viscous control with the
/// velocity of half a step before grows with ω itself (K + ωC ≤ ω ω_e M), so there ω² ≥ ω ω_e + g.
double combined(double omega2_e, double g, bool viscous) {
  if (!viscous) return omega2_e + g;
  const double omega = (std::sqrt(omega2_e) + std::sqrt(omega2_e + 4 * g)) / 2;
  return omega * omega;
}

double frequency_squared(const Mesh& mesh, std::int32_t i, const NodeBounds& at, bool viscous) {
  return combined(at.elements[i] / mesh.mass[i], (at.ghosts[i] + at.contacts[i]) / mesh.mass[i], viscous);
}

/// Nothing of elements yet.
NodeLimits node_limits(const Mesh& mesh, const NodeBounds& at) {
  const std::vector<double> zero(mesh.nodes());
  NodeLimits limits{zero, zero, zero, std::vector<std::uint8_t>(mesh.nodes())};
  for (std::size_t i = 0; i < mesh.nodes(); ++i) {
    limits.of_ghosts[i] = at.ghosts[i] / mesh.mass[i];
    limits.of_contacts[i] = at.contacts[i] / mesh.mass[i];
  }
  return limits;
}

/// The region's bound; its nodes' limits are completed on the way.
TimeStepBound hex_bound(const Mesh& mesh, const HexRegion& region, const NodeBounds& at, bool held_too,
                        NodeLimits& limits) {
  const bool viscous = has_viscous_control(region);
  double worst = 0;
  std::int32_t node = 0;
  for (std::size_t e = region.first; e < region.first + region.count; ++e)
    for (const std::int32_t i : mesh.elements[e]) {
      const bool held = mesh.held[i] == 0b111;
      limits.viscous[i] |= viscous;
      if (held && !held_too) continue;
      const double omega2 = frequency_squared(mesh, i, at, viscous);
      if (!held) limits.frequency_squared[i] = std::max(limits.frequency_squared[i], omega2);
      if (omega2 > worst) worst = omega2, node = i;
    }
  const Vec3 p = mesh.points[node];
  return {region.name, 2 / std::sqrt(worst),
          fmt::format("hexahedra{}{} at ({:.4g}, {:.4g}, {:.4g})", at.ghosts[node] > 0 ? " with ghosts" : "",
                      at.contacts[node] > 0 ? " that may touch" : "", p.x, p.y, p.z)};
}

}  // namespace

std::vector<TimeStepBound> time_step_bounds(const Model& model, const contact::Contacts& contacts) {
  return time_step_limits(model, contacts).bounds;
}

TimeStepLimits time_step_limits(const Model& model, const contact::Contacts& contacts) {
  TimeStepLimits limits;
  const NodeBounds at = node_bounds(model, contacts);
  limits.nodes = node_limits(model.mesh, at);
  const auto held = [](std::uint8_t bits) { return bits == 0b111; };
  const bool all_held =
      model.lattices.empty() && std::all_of(model.mesh.held.begin(), model.mesh.held.end(), held);
  for (const HexRegion& region : model.mesh.regions)
    limits.bounds.push_back(hex_bound(model.mesh, region, at, all_held, limits.nodes));
  for (std::size_t l = 0; l < model.lattices.size(); ++l) {
    const Lattice& lattice = model.lattices[l];
    const double charge = contacts.particle_charge(model, static_cast<std::int32_t>(l));
    limits.bounds.push_back({lattice.name, 2 / std::sqrt(de::largest_frequency_squared(lattice) + charge),
                             fmt::format("bonds{} of particles, r = {:.6g}",
                                         charge > 0 ? " and contacts" : "", lattice.radius())});
    limits.particles_may_touch |= charge > 0;
  }
  return limits;
}

const TimeStepBound& critical(const std::vector<TimeStepBound>& bounds) {
  return *std::min_element(bounds.begin(), bounds.end(),
                           [](const auto& a, const auto& b) { return a.bound < b.bound; });
}

double rounded_down(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 4);
  return std::floor(x / unit) * unit;
}

}  // namespace geist
