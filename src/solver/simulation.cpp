#include "solver/simulation.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "fe/elements.hpp"
#include "solver/nodes.hpp"

namespace geist {
namespace {

/// β = αΔt/2: how damping enters the kick v⁺ = ((1 − β) v⁻ + Δt (f/m + g)) / (1 + β).
double beta(double alpha, double dt) { return alpha * dt / 2; }

de::Kick make_kick(double alpha, double dt, Vec3 gravity) {
  const double b = beta(alpha, dt), scaled = dt / (1 + b);
  return {(1 - b) / (1 + b), scaled, scaled, scaled * gravity};
}

/// before ← 2 before − after: the mirror image of `after` about `before`.
template <int N>
void reflect(Field<N>& before, const Field<N>& after) {
  for (int c = 0; c < N; ++c)
    for (std::size_t i = 0; i < before.size(); ++i) before[c][i] = 2 * before[c][i] - after[c][i];
}

/// Sums of one lattice in units of energy: masses for displacement, inertias for spin, all in across and
/// after.
de::KickSums weighted(const de::KickSums& s, const Lattice& lattice) {
  return {lattice.mass * s.across + lattice.inertia * s.spin_across,
          lattice.mass * s.after + lattice.inertia * s.spin_after, 0, 0};
}

}  // namespace

void Simulation::step(bool observe) {
  {
    const auto timing = timers.time(Phase::drift);  // u^{n+1} = u^n + Δt v^{n+1/2}
    drift(model.mesh, dt);
    if (subcycling.lattices())
      for (Lattice& lattice : model.lattices) de::drift(lattice, dt);
    model.time = static_cast<double>(++model.step) * dt;
  }
  if (observe) keep_velocities();
  forces_and_kick(dt, true);
  settle(loads, model, observe ? model.time : model.time + dt);
}

void Simulation::start() {
  supports.halt(model);
  keep_velocities();
  settle(loads, model, model.time);
  for (Load& load : loads) load.work = 0;  // counts from here
  forces_and_kick(dt / 2, false);
  reflect(model.mesh.v_before, model.mesh.v);
  for (Lattice& lattice : model.lattices) reflect(lattice.velocity_before, lattice.velocity);
  initial_energy_ = 0;
  const Ledger now = ledger();
  initial_energy_ = now.kinetic() + now.internal();
  damping_power_ = 2 * alpha * now.kinetic();
}

void Simulation::start_loaded() {
  start();
  initial_energy_ = 0;
  if (turns_finitely(model)) {
    supports.work = ledger().internal();  // the ledger asks for the sum alone
    return;
  }
  reckon_proportional(loads, model);
  supports.reckon_proportional(model);
}

void Simulation::forces_and_kick(double kick_dt, bool arrived) {
  const Vec3 g = gravity(loads, model.time);
  const de::Kick kick = make_kick(alpha, kick_dt, g);
  de::KickSums sums;
  {
    const auto timing = timers.time(Phase::coupling);
    for (Lattice& lattice : model.lattices) coupling::follow(lattice, model.mesh);  // (21)
  }
  if (!contacts.empty()) {
    const auto timing = timers.time(Phase::contact);
    contacts.find(model, arrived ? dt : 0, arrived && !subcycling.lattices() ? dt : 0);
  }
  double power = 0;
  {
    const auto timing = timers.time(Phase::elements);
    power = elements_forces();  // f_I^int of (1)
  }
  {
    const auto timing = timers.time(Phase::lattice);
    for (Lattice& lattice : model.lattices) {  // (19)–(23), (3)–(5), (13); then (15)(17)(18), (24)(26)(27)
      const de::Kick own = kick.of(lattice);
      if (subcycling.lattices())
        clear(lattice.listed_force);
      else
        sums += weighted(arrived ? de::advance(lattice, own, dt) : de::bond_forces_and_kick(lattice, own),
                         lattice);
    }
  }
  complete_node_forces();
  sums += short_steps(kick, g);
  {
    const auto timing = timers.time(Phase::nodes);
    sums += kick_nodes(model.mesh, kick);  // (16)(25)
    sums += kick_touched(kick);
    for (Lattice& lattice : model.lattices)  // ghosts' spins; loaded and supported particles
      sums += weighted(de::kick_listed(lattice, kick.of(lattice)), lattice);
    supports.apply(model, dt, g, arrived);
  }
  account(sums, kick_dt, arrived);
  account_damping(power, arrived);
}

/// Those of fine elements wait until all others are known.
double Simulation::elements_forces() {
  if (subcycling.empty()) return fe::internal_forces(model.mesh);
  clear(model.mesh.f);
  return fe::add_internal_forces(model.mesh, subcycling.others(), 1);
}

void Simulation::complete_node_forces() {
  const auto timing = timers.time(Phase::nodes);
  if (!subcycling.lattices()) reactions.add(model);  // (14)
  add_loads(loads, model, model.time);               // f^res of (1)(2)
  contacts.add_to_nodes(model.mesh);
}

/// What is fine, once all other forces are known; kicks the particles in it.
de::KickSums Simulation::short_steps(const de::Kick& kick, Vec3 g) {
  de::KickSums sums;
  if (subcycling.empty()) return sums;
  subcycling.add_mean_forces(model, reactions, g, dt, timers);
  if (!subcycling.lattices()) return sums;
  const auto timing = timers.time(Phase::lattice);
  for (std::size_t l = 0; l < model.lattices.size(); ++l)
    sums += weighted(subcycling.kick(l, model.lattices[l], kick, dt), model.lattices[l]);
  return sums;
}

/// Trapezoidal rule on Σ α m v². Hourglass control is reckoned with v^{n−½}, so that its work over the step
/// from n − 1 is ½ Δt (v^{n−3/2} + v^{n−½})·C v^{n−½}, which from the powers at both is known to second
/// order.
void Simulation::account_damping(double power, bool arrived) {
  const double damping_power = 2 * alpha * kinetic_;
  if (arrived)
    damping_work_ += dt * (0.5 * (damping_power_ + damping_power) + 0.25 * hourglass_power_ + 0.75 * power);
  damping_power_ = damping_power, hourglass_power_ = power;
}

de::KickSums Simulation::kick_touched(const de::Kick& kick) {
  de::KickSums sums;
  for (std::size_t l = 0; l < model.lattices.size(); ++l) {
    const de::Kick own = kick.of(model.lattices[l]);
    const auto change = contacts.kick_particles(static_cast<std::int32_t>(l), model.lattices[l], own.per_mass,
                                                own.per_inertia);
    sums.across += change.across, sums.after += change.after;
  }
  return sums;
}

void Simulation::account(const de::KickSums& sums, double kick_dt, bool arrived) {
  // With A = Σ m v⁻·v⁻, B = Σ m v⁻·v⁺, C = Σ m v⁺·v⁺:  v^n = ½ (v⁻ + v⁺),  Δt f = m ((1 + β) v⁺ − (1 − β) v⁻)
  const double A = after_, B = sums.across, C = sums.after, b = beta(alpha, kick_dt);
  const double force_before = ((1 + b) * B - (1 - b) * A) / kick_dt;  // f^n·v⁻
  const double kinetic = (A + 2 * B + C) / 8;
  if (arrived) frequency_squared_ = A > 0 ? std::max(0.0, (force_after_ - force_before) / (dt * A)) : 0;
  force_after_ = ((1 + b) * C - (1 - b) * B) / kick_dt;  // f^n·v⁺
  kinetic_ = kinetic, after_ = C;
}

void Simulation::keep_velocities() {
  const auto timing = timers.time(Phase::observe);
  copy(model.mesh.v, model.mesh.v_before);
  for (Lattice& lattice : model.lattices) copy(lattice.velocity, lattice.velocity_before);
}

void list_acted_on(Simulation& sim) {
  std::vector<std::vector<std::size_t>> sites(sim.model.lattices.size());
  for (const HeldComponent& h : sim.supports.held)
    if (h.lattice >= 0) sites[h.lattice].push_back(h.place);
  for (const Load& load : sim.loads)
    for (const ParticleForce& p : load.particles) sites[p.lattice].push_back(p.site);
  for (std::size_t l = 0; l < sites.size(); ++l) list_sites(sim.model.lattices[l], sites[l]);
  for (Load& load : sim.loads)
    for (ParticleForce& p : load.particles) p.slot = listed_slot(sim.model.lattices[p.lattice], p.site);
  for (HeldComponent& h : sim.supports.held) {
    const auto bit = static_cast<std::uint8_t>(1 << h.component);
    if (h.lattice < 0) {
      sim.model.mesh.held[h.place] |= bit;
      continue;
    }
    Lattice& lattice = sim.model.lattices[h.lattice];
    h.slot = listed_slot(lattice, h.place);
    lattice.listed_held[h.slot] |= bit;
  }
}

}  // namespace geist
