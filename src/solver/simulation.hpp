// Simulation: a model with its loads, supports and damping, stepped in time by central differences (15)–(27).
#pragma once
#include <string>
#include <vector>

#include "contact/contacts.hpp"
#include "coupling/ghosts.hpp"
#include "de/bonds.hpp"
#include "model/model.hpp"
#include "solver/ledger.hpp"
#include "solver/loads.hpp"
#include "solver/subcycling.hpp"
#include "solver/supports.hpp"
#include "solver/timers.hpp"

namespace geist {

/// State u^n and v^{n+1/2} between calls of step(). The velocity at t^n is ½ (v_before + v) after an observed
/// step.
class Simulation {
 public:
  /// Everything is at rest at model's motion and velocity (v^0) when start() is called.
  Model model;
  std::vector<Load> loads;
  Supports supports;
  coupling::Reactions reactions;
  contact::Contacts contacts;
  Subcycling subcycling;
  double dt = 0;     ///< time step
  double alpha = 0;  ///< damping: f = −α m v on everything that moves freely, 1/time
  Timers timers;

  /// Forces at t^0 and the first half kick. Like an observed step.
  void start();

  /// start() where the model has been brought to equilibrium: its energy and the work of loads and supports
  /// are those of all of them growing in proportion from nothing, ½ f·u. Everything is at rest. With finite
  /// rotations the path is not straight: what loads and supports do along equilibria is what is stored.
  void start_loaded();

  /// One step. If `observe`, the velocity at t^n is kept for ledger(), residual() and the writers.
  void step(bool observe);

  /// Energies and momenta at t^n; after start() or an observed step only.
  Ledger ledger();

  /// ‖force out of balance‖ / max(‖loads‖, ‖reactions‖) at t^n, damping and inertia left out; observed steps
  /// only.
  double residual() const;

  /// Rayleigh quotient ω² of the velocity from the change of the forces over the last step; 0 if there is
  /// none.
  double frequency_squared() const { return frequency_squared_; }

  /// Kinetic energy of what moves freely at t^n; not a number as soon as anything is not.
  double kinetic_energy() const { return kinetic_; }

 private:
  void forces_and_kick(double kick_dt, bool arrived);
  double elements_forces();
  void complete_node_forces();
  de::KickSums short_steps(const de::Kick& kick, Vec3 gravity);
  de::KickSums kick_touched(const de::Kick& kick);
  void keep_velocities();
  void account(const de::KickSums& sums, double kick_dt, bool arrived);
  void account_damping(double hourglass_power, bool arrived);

  double damping_work_ = 0;  ///< of α and of viscous hourglass control
  double damping_power_ = 0, hourglass_power_ = 0;
  double kinetic_ = 0, after_ = 0, force_after_ = 0, frequency_squared_ = 0;
  double initial_energy_ = 0;
};

/// Have the lattices hand over the force on every particle that a load or a support acts on, and mark what is
/// held.
void list_acted_on(Simulation& sim);

}  // namespace geist
