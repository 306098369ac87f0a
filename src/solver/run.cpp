#include "solver/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fe/elements.hpp"

namespace geist {
namespace {

/// Steps at which something is due: the first at or after each multiple of `every`, and at or after each of
/// `at`.
class Schedule {
 public:
  Schedule(double every, double dt, std::vector<double> at = {})
      : every_(every), dt_(dt), at_(std::move(at)) {}
  bool due(long step) const {
    const double late = 1 + 1e-12, now = static_cast<double>(step) * dt_ * late,
                 before = static_cast<double>(step - 1) * dt_ * late;
    if (std::any_of(at_.begin(), at_.end(), [=](double t) { return before < t && t <= now; })) return true;
    return every_ > 0 && std::floor(now / every_) > std::floor(before / every_);
  }

 private:
  double every_, dt_;
  std::vector<double> at_;
};

/// An observed step takes two to three times a plain one.
constexpr double fewest_steps_to_a_row = 20;

double history_interval(const RunPlan& plan, double dt) {
  if (plan.history_every > 0) return plan.history_every;
  if (plan.quasi_static) return static_cast<double>(plan.check_every) * dt;
  return std::max(plan.end_time / 1000, fewest_steps_to_a_row * dt);
}

/// From when on no load and no support changes any more: an equilibrium before that is not the one asked for.
double steady_from(const Simulation& sim) {
  double end = 0;
  for (const Load& load : sim.loads) end = std::max(end, load.curve.end());
  for (const Motion& motion : sim.supports.motions) end = std::max(end, motion.curve.end());
  return end;
}

/// Region, number and position of the first element with a node, or else the first site, that meets a
/// condition.
template <class Node, class Site>
std::string first_place(const Model& model, Node node_is_it, Site site_is_it) {
  const Mesh& mesh = model.mesh;
  for (const HexRegion& region : mesh.regions)
    for (std::size_t e = region.first; e < region.first + region.count; ++e)
      for (const std::int32_t i : mesh.elements[e])
        if (const Vec3 p = mesh.points[i]; node_is_it(i))
          return fmt::format("region '{}', element {}, node {} at ({:.6g}, {:.6g}, {:.6g})", region.name,
                             e - region.first, i, p.x, p.y, p.z);
  for (const Lattice& lattice : model.lattices)
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      if (lattice.word[s] != 0 && site_is_it(lattice, s)) {
        const auto [i, j, k] = lattice.grid.ijk(s);
        const Vec3 p = lattice.grid.centre(s);
        return fmt::format("region '{}', site ({}, {}, {}) at ({:.6g}, {:.6g}, {:.6g})", lattice.name, i, j,
                           k, p.x, p.y, p.z);
      }
  return {};
}

std::string describe(const Model& model, const contact::DeepContact& deep) {
  std::string place = fmt::format("node {}", deep.place.index);
  if (deep.place.lattice >= 0) {
    const auto [i, j, k] = model.lattices[deep.place.lattice].grid.ijk(deep.place.index);
    place = fmt::format("site ({}, {}, {})", i, j, k);
  }
  const Vec3 p = deep.position;
  return fmt::format(
      "step {}, time {:.6g}: region '{}', {} at ({:.6g}, {:.6g}, {:.6g}) is {:.3g} deep in region '{}'; "
      "their "
      "contact law is made for {:.3g} at most: raise stiffness_factor, or refine",
      model.step, model.time, region_name(model, deep.region), place, p.x, p.y, p.z, deep.overlap,
      region_name(model, deep.other), deep.allowed);
}

/// The element that is turned inside out, in words; empty if none is.
std::string inverted(const Mesh& mesh) {
  const auto e = fe::first_inverted(mesh);
  if (!e) return {};
  Vec3 x;
  for (const std::int32_t i : mesh.elements[*e]) x += 0.125 * (mesh.points[i] + mesh.u.vector(i));
  const HexRegion& region = mesh.regions[region_of(mesh, static_cast<std::int32_t>(*e))];
  return fmt::format(
      "region '{}', element {} at ({:.6g}, {:.6g}, {:.6g}) is turned inside out: it is strained too far for "
      "its elastic law",
      region.name, *e - region.first, x.x, x.y, x.z);
}

/// Why the energy is not a number any more.
std::string what_is_wrong(const Model& model) {
  if (const std::string element = inverted(model.mesh); !element.empty()) return element;
  const std::string place = first_not_finite(model);
  return (place.empty() ? "the energy" : place) + " is not a number any more";
}

/// One run under way.
class Runner {
 public:
  Runner(Simulation& sim, const RunPlan& plan, const std::vector<Observer*>& observers)
      : sim_(sim),
        plan_(plan),
        observers_(observers),
        history_(history_interval(plan, sim.dt), sim.dt),
        fields_(plan.fields_every, sim.dt, plan.fields_at),
        steady_from_(steady_from(sim)) {}

  Outcome run() {
    sim_.start();
    warn();
    observe();
    report_history(), report_fields();
    while (!finished()) advance();
    if (!reported_history_) report_history();
    if (!reported_fields_) report_fields();
    outcome_.last = last_;
    return outcome_;
  }

 private:
  bool reaches_end_time(long step) const {
    return plan_.end_time > 0 && static_cast<double>(step) * sim_.dt >= plan_.end_time * (1 - 1e-12);
  }
  bool ends_at(long step) const {
    return reaches_end_time(step) || step >= plan_.max_steps || (plan_.stop && *plan_.stop);
  }

  void advance() {
    const long step = sim_.model.step + 1;
    const bool history = history_.due(step), fields = fields_.due(step);
    const bool watch = history || fields || suspect_ || step % plan_.check_every == 0 || ends_at(step);
    sim_.step(watch);
    warn();
    reported_history_ = reported_fields_ = false;
    if (!std::isfinite(sim_.kinetic_energy())) {
      if (watch) last_.ledger = sim_.ledger();
      return fail_not_finite();
    }
    if (watch) observe();
    if (history) report_history();
    if (fields) report_fields();
    if (plan_.quasi_static) relaxation_.update(sim_);
  }

  void warn() {
    for (const contact::DeepContact& deep : sim_.contacts.take_deep_contacts())
      for (Observer* o : observers_) o->warning(sim_, describe(sim_.model, deep));
  }

  void observe() {
    last_.ledger = sim_.ledger();
    last_.residual = plan_.quasi_static ? sim_.residual() : std::numeric_limits<double>::quiet_NaN();
    observed_step_ = sim_.model.step;
    for (Observer* o : observers_) o->progress(sim_, last_);
    check_balance();
  }

  /// Where a prescribed velocity jumps, half of the work of the jump is in the ledger a step late: a balance
  /// that is off must be so twice in a row.
  void check_balance() {
    const Ledger& l = last_.ledger;
    if (!std::isfinite(l.balance())) return fail_not_finite();
    largest_ =
        std::max({largest_, l.kinetic() + l.internal() + std::abs(l.dissipated()), std::abs(l.external)});
    const bool was_suspect = suspect_;
    suspect_ =
        sim_.model.step >= plan_.check_every && std::abs(l.balance()) > plan_.balance_tolerance * largest_;
    if (!suspect_ || !was_suspect) return;
    outcome_ = {
        Status::failed,
        fmt::format("step {}, time {:.6g}: the energy balance is off by {:.2g} of the largest energy so far "
                    "(allowed: {:.2g}); the time step may be too long; what moves fastest is {}",
                    sim_.model.step, sim_.model.time, std::abs(l.balance()) / largest_,
                    plan_.balance_tolerance, fastest(sim_.model)),
        {}};
  }

  void fail_not_finite() {
    outcome_ = {
        Status::failed,
        fmt::format("step {}, time {:.6g}: {}", sim_.model.step, sim_.model.time, what_is_wrong(sim_.model)),
        {}};
  }

  /// Whether the run is over; sets the outcome.
  bool finished() {
    if (outcome_.status == Status::failed) return true;
    const bool observed = observed_step_ == sim_.model.step;
    if (plan_.quasi_static && observed && sim_.model.step > 0 && last_.residual <= plan_.tolerance)
      return true;
    if (!ends_at(sim_.model.step) || !observed) return false;  // a signal may come after the step was chosen
    if (plan_.stop && *plan_.stop)
      outcome_ = {Status::interrupted, fmt::format("stopped by a signal at step {}", sim_.model.step), {}};
    else if (plan_.quasi_static)
      outcome_ = {
          Status::not_converged,
          fmt::format("no equilibrium after {} steps: the residual is {:.2g} of the load, wanted {:.2g}",
                      sim_.model.step, last_.residual, plan_.tolerance),
          {}};
    else if (!reaches_end_time(sim_.model.step))
      outcome_ = {
          Status::not_converged,
          fmt::format("stopped after max_steps = {} at time {:.6g}", plan_.max_steps, sim_.model.time),
          {}};
    return true;
  }

  void report_history() {
    for (Observer* o : observers_) o->history(sim_, last_);
    reported_history_ = true;
  }
  void report_fields() {
    for (Observer* o : observers_) o->fields(sim_, last_);
    reported_fields_ = true;
  }

  Simulation& sim_;
  const RunPlan& plan_;
  const std::vector<Observer*>& observers_;
  Schedule history_, fields_;
  Relaxation relaxation_;
  Outcome outcome_;
  Observation last_;
  double steady_from_;
  double largest_ = 0;
  long observed_step_ = -1;
  bool reported_history_ = false, reported_fields_ = false;
  bool suspect_ = false;  ///< the balance was off when last looked at
};

Status status_of(Equilibrium::End end) {
  switch (end) {
    case Equilibrium::End::found:
      return Status::completed;
    case Equilibrium::End::not_converged:
      return Status::not_converged;
    case Equilibrium::End::interrupted:
      return Status::interrupted;
    case Equilibrium::End::failed:
      return Status::failed;
  }
  return Status::failed;
}

/// Equilibrium at sim's time, watched.
Outcome equilibrium(Simulation& sim, const RunPlan& plan, double tolerance,
                    const std::vector<Observer*>& observers) {
  EquilibriumPlan search{tolerance, plan.max_iterations, plan.stop, {}};
  search.progress = [&](long iterations, double residual) {
    Observation now;
    now.iterations = iterations, now.residual = residual;
    for (Observer* o : observers) o->progress(sim, now);
  };
  Outcome outcome;
  outcome.equilibrium = find_equilibrium(sim, search);
  outcome.status = status_of(outcome.equilibrium->end), outcome.message = outcome.equilibrium->message;
  return outcome;
}

/// The end of a run that has no steps.
void end_at_start(Simulation& sim, Outcome& outcome, const std::vector<Observer*>& observers) {
  sim.start_loaded();
  outcome.equilibrium->residual = sim.residual();
  outcome.last = {sim.ledger(), outcome.equilibrium->residual, outcome.equilibrium->iterations};
  for (Observer* o : observers) o->history(sim, outcome.last), o->fields(sim, outcome.last);
}

Outcome run_static(Simulation& sim, const RunPlan& plan, const std::vector<Observer*>& observers) {
  sim.model.time = steady_from(sim);
  Outcome outcome = equilibrium(sim, plan, plan.tolerance, observers);
  end_at_start(sim, outcome, observers);
  return outcome;
}

Outcome run_from_equilibrium(Simulation& sim, const RunPlan& plan, const std::vector<Observer*>& observers) {
  Outcome start = equilibrium(sim, plan, static_start_tolerance, observers);
  if (start.status != Status::completed) {
    start.message = "static start: " + start.message;
    end_at_start(sim, start, observers);
    return start;
  }
  Outcome outcome = Runner(sim, plan, observers).run();
  outcome.equilibrium = start.equilibrium;
  return outcome;
}

}  // namespace

Outcome run(Simulation& sim, const RunPlan& plan, const std::vector<Observer*>& observers) {
  if (plan.is_static) return run_static(sim, plan, observers);
  if (plan.static_start) return run_from_equilibrium(sim, plan, observers);
  return Runner(sim, plan, observers).run();
}

std::string first_not_finite(const Model& model) {
  const auto finite = [](Vec3 a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); };
  return first_place(
      model,
      [&](std::int32_t i) { return !finite(model.mesh.u.vector(i)) || !finite(model.mesh.v.vector(i)); },
      [&](const Lattice& lattice, std::size_t s) {
        return !finite(lattice.motion.vector(s)) || !finite(lattice.motion.vector(s, 3)) ||
               !finite(lattice.velocity.vector(s)) || !finite(lattice.velocity.vector(s, 3));
      });
}

std::string fastest(const Model& model) {
  double most = 0;
  for (std::size_t i = 0; i < model.mesh.nodes(); ++i) most = std::max(most, norm(model.mesh.v.vector(i)));
  for (const Lattice& lattice : model.lattices)
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      most = std::max(most, norm(lattice.velocity.vector(s)));
  return first_place(
      model, [&](std::int32_t i) { return norm(model.mesh.v.vector(i)) == most; },
      [&](const Lattice& lattice, std::size_t s) { return norm(lattice.velocity.vector(s)) == most; });
}

}  // namespace geist
