#include "solver/ledger.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "fe/elements.hpp"
#include "solver/simulation.hpp"

namespace geist {
namespace {

/// What one node or site adds.
struct Share {
  double kinetic = 0, rotational = 0;
  Vec3 linear, angular;
  Share& operator+=(const Share& b) {
    kinetic += b.kinetic, rotational += b.rotational, linear += b.linear, angular += b.angular;
    return *this;
  }
};

Share node_share(const Mesh& mesh, std::size_t i, bool present) {
  const Vec3 v = 0.5 * (mesh.v_before.vector(i) + mesh.v.vector(i)), p = mesh.mass[i] * v;
  return {0.5 * dot(p, v), 0, p, cross(mesh.points[i] + (present ? mesh.u.vector(i) : Vec3{}), p)};
}

Share site_share(const Lattice& lattice, std::size_t s, bool present) {
  if (!(lattice.word[s] & (site::particle | site::ghost))) return {};
  const auto at = [&](int first) {
    return 0.5 * (lattice.velocity_before.vector(s, first) + lattice.velocity.vector(s, first));
  };
  const Vec3 omega = at(3), spin = lattice.inertia * omega;
  Share share{0, 0.5 * dot(spin, omega), {}, spin};
  if (!lattice.is(s, site::particle)) return share;
  const Vec3 v = at(0), p = lattice.mass * v;
  const Vec3 x = lattice.grid.centre(s) + (present ? lattice.motion.vector(s) : Vec3{});
  share += {0.5 * dot(p, v), 0, p, cross(x, p)};
  return share;
}

/// Force out of balance by the change of velocity: Δt f = m ((1 + β) v⁺ − (1 − β) v⁻), damping left out.
struct Imbalance {
  double beta, dt;
  double square(double mass, double before, double after) const {
    const double f = mass * ((1 + beta) * after - (1 - beta) * before) / dt;
    return f * f;
  }
};

double node_residual(const Mesh& mesh, Imbalance imbalance) {
  return sum<double>(mesh.nodes(), [&mesh, imbalance](std::size_t i) {
    double squares = 0;
    for (int c = 0; c < 3; ++c)
      if (!(mesh.held[i] >> c & 1))
        squares += imbalance.square(mesh.mass[i], mesh.v_before[c][i], mesh.v[c][i]);
    return squares;
  });
}

/// A moment counts as moment / r.
double site_residual(const Lattice& lattice, std::size_t s, std::uint8_t held, Imbalance imbalance) {
  double squares = 0;
  for (int c = 0; c < 6; ++c)
    if (!(held >> c & 1))
      squares += imbalance.square(c < 3 ? lattice.mass : lattice.inertia / lattice.radius(),
                                  lattice.velocity_before[c][s], lattice.velocity[c][s]);
  return squares;
}

double lattice_residual(const Lattice& lattice, Imbalance imbalance) {
  double squares = sum<double>(lattice.grid.size(), [&lattice, imbalance](std::size_t s) {
    return lattice.is(s, site::free) ? site_residual(lattice, s, 0, imbalance) : 0.0;
  });
  for (std::size_t slot = 0; slot < lattice.listed.size(); ++slot)
    squares += site_residual(lattice, lattice.listed[slot], lattice.listed_held[slot], imbalance);
  return squares;
}

}  // namespace

Ledger Simulation::ledger() {
  const auto timing = timers.time(Phase::observe);
  const Mesh& mesh = model.mesh;
  const bool present = !contacts.empty() || turns_finitely(model);
  Share all =
      sum<Share>(mesh.nodes(), [&mesh, present](std::size_t i) { return node_share(mesh, i, present); });
  const fe::Energies elements = fe::energies(mesh);
  de::BondEnergies bonds;
  for (const Lattice& lattice : model.lattices) {
    all += sum<Share>(lattice.grid.size(),
                      [&lattice, present](std::size_t s) { return site_share(lattice, s, present); });
    bonds += de::energies(lattice);
  }
  settle(loads, model, model.time);
  Ledger l;
  l.kinetic_translation = all.kinetic, l.kinetic_rotation = all.rotational;
  l.strain_elements = elements.strain, l.hourglass = elements.hourglass;
  l.strain_bonds = bonds.bonds, l.strain_coupling = bonds.coupling;
  const contact::Energies& touching = contacts.energies();
  l.contact = touching.stored, l.friction = touching.friction, l.contact_damping = touching.damping;
  l.damping = damping_work_;
  l.external = supports.work;
  for (const Load& load : loads) l.external += load.work;
  l.initial = initial_energy_;
  l.linear = all.linear, l.angular = all.angular;
  return l;
}

double Simulation::residual() const {
  const Imbalance imbalance{alpha * dt / 2, dt};
  double squares = node_residual(model.mesh, imbalance);
  for (const Lattice& lattice : model.lattices) squares += lattice_residual(lattice, imbalance);
  const double scale = std::max(norm(loads, model, model.time), supports.reaction_norm());
  return scale > 0 ? std::sqrt(squares) / scale : std::sqrt(squares);
}

}  // namespace geist
