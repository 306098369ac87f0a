// What the verification tests of contact share: a case from its text to its end, and what was seen on the
// way.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "case/build.hpp"
#include "solver/run.hpp"

namespace geist::verification {

/// A run of a case, and its ledger, probes and what else was asked for at every row of its history.
struct Recording {
  Built built;
  Outcome outcome;
  std::vector<std::string> warnings;
  std::vector<double> time;
  std::vector<Ledger> ledger;
  std::vector<std::vector<double>> probe;  ///< by probe in file order, by row
  std::vector<double> watched;             ///< what `watch` said, by row

  const Simulation& simulation() const { return built.simulation; }
  const Model& model() const { return built.simulation.model; }
  const std::vector<double>& of(const std::string& probe_name) const;

  /// Largest |balance| of all rows / the largest kinetic energy + internal energy.
  double worst_balance() const;
  /// Largest |Σ m v − its first value|.
  double worst_momentum() const;
};

using Watch = std::function<double(const Simulation&)>;

/// Run the case's text by the published method, with small displacements. `every`: of history; 0: a thousand
/// rows.
Recording run_text(const std::string& text, double every = 0, const Watch& watch = {}, int threads = 1);

/// Velocity, spin and present position of the only particle of lattice l.
struct Particle {
  Vec3 x, v, spin;
  double mass, inertia, radius;
};
Particle only_particle(const Model& model, std::size_t l = 0);

/// The largest of them.
double peak(const std::vector<double>& values);

}  // namespace geist::verification
