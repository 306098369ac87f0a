// How stiff contacts are, and what they may add to frequencies.
#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/contacts.hpp"

namespace geist::contact {

/// Two columns of material in series: for a particle the half of its cell, 4 r (λ + 2μ), and the same of the
/// other side; for a node half an element's thickness on either side, over half of `area` (the other half of
/// the stiffness comes from the other surface's nodes). Hertz: 4/3 E* √R*.
NormalStiffness Contacts::spring(const Contactor& c, double area, const Opposite& other) const {
  const PairLaw& pair = pair_laws_[laws_.at(c.region, other.region)];
  const double factor = pair.law.factor, own = layer_[c.region], theirs = layer_[other.region];
  if (c.radius == 0) return {factor * 0.5 * area / (c.depth / own + other.depth / theirs), false};
  if (pair.law.normal == Law::Normal::hertz) {
    const double R = other.radius > 0 ? c.radius * other.radius / (c.radius + other.radius) : c.radius;
    return {factor * 4 / 3 * pair.moduli.E * std::sqrt(R), true};
  }
  const double cell = other.radius > 0 ? other.radius : c.radius;  // a facet counts as the particle's like
  return {factor / (1 / (4 * c.radius * own) + 1 / (4 * cell * theirs)), false};
}

std::vector<double> Contacts::node_charges(const Model& model) const {
  std::vector<double> charges(model.mesh.nodes(), 0.0);
  const auto hexahedral = static_cast<std::int32_t>(model.mesh.regions.size());
  for (const Contactor& c : contactors_) {
    if (c.radius > 0) continue;
    double most = 0;
    for (std::int32_t other = 0; other < static_cast<std::int32_t>(laws_.regions()); ++other) {
      if (laws_.at(c.region, other) < 0) continue;
      const double k = largest_stiffness(c, other);
      if (other < hexahedral) {
        most = std::max(most, 2 * 2 * k);  // as contactor, and under those of the other surface
      } else {
        const double cell = 4 * least_[other].radius * least_[other].radius;
        most = std::max(most, 2 * k * std::max(1.0, c.area / cell));
      }
    }
    charges[places_.list[c.place].index] += most;
  }
  return charges;
}

double Contacts::particle_charge(const Model& model, std::int32_t l) const {
  const Lattice& lattice = model.lattices[l];
  const auto region = static_cast<std::int32_t>(model.mesh.regions.size()) + l;
  double most = 0;
  for (std::int32_t other = 0; other < static_cast<std::int32_t>(laws_.regions()); ++other) {
    const std::int32_t law = laws_.at(region, other);
    if (law < 0) continue;
    const double k = largest_stiffness({-1, region, lattice.radius(), 0, lattice.radius()}, other);
    most = std::max(most, 2 * k / lattice.mass);
    if (laws_.law(law).friction > 0) {
      const double r = lattice.radius(), turning = 1 / lattice.mass + r * r / lattice.inertia;
      most = std::max(most, 2 * k * pair_laws_[law].moduli.tangential_ratio() * turning);
    }
  }
  return most;
}

/// Against any contactor or facet of a region; Hertz' law at the overlap where it is reported, δ = r. Of a
/// node and a particle, the particle is the contactor.
double Contacts::largest_stiffness(const Contactor& c, std::int32_t other) const {
  const Contactor& least = least_[other];
  if (c.radius == 0 && least.radius > 0) return spring(least, 0, {c.region, 0, 0}).tangent(least.radius);
  return spring(c, c.area, {other, least.radius, thinnest_[other]}).tangent(c.radius);
}

NormalStiffness Contacts::stiffness(std::int32_t number) const {
  auto [a, b] = laws_.regions_of(number);
  if (least_[a].radius == 0 && least_[b].radius > 0) std::swap(a, b);
  return spring(least_[a], 2, {b, least_[b].radius, thinnest_[b]});
}

}  // namespace geist::contact
