// Run: step a simulation to its end, watched by observers.
#pragma once
#include <csignal>
#include <optional>
#include <string>
#include <vector>

#include "solver/equilibrium.hpp"
#include "solver/relaxation.hpp"
#include "solver/simulation.hpp"

namespace geist {

/// What is known at an observed step.
struct Observation {
  Ledger ledger;
  double residual = 0;  ///< static and quasi-static runs; else not a number
  long iterations = 0;  ///< of static runs so far
};

/// Watches a run. Called between steps; may read everything and changes nothing.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void history(const Simulation&, const Observation&) {}  ///< a row of history is due
  virtual void fields(const Simulation&, const Observation&) {}   ///< a picture of the fields is due
  /// Something that the run survives and its user should know.
  virtual void warning(const Simulation&, const std::string&) {}
  virtual void progress(const Simulation&, const Observation&) {}  ///< whenever the ledger was made
};

struct RunPlan {
  bool quasi_static = false;
  bool is_static = false;        ///< equilibrium and nothing else: what follows about time does not count
  bool static_start = false;     ///< dynamic: begin at equilibrium under the loads of time 0
  double tolerance = 1e-6;       ///< static, quasi-static: residual / load to stop at
  long max_iterations = 10'000;  ///< static: give up then
  double end_time = 0;           ///< dynamic: the end; quasi-static: give up then, 0: never
  long max_steps = 10'000'000;   ///< give up then
  double history_every = 0;  ///< in time; 0: a thousand rows of a dynamic run, but at most one in 20 steps;
                             ///< every check of a quasi-static one
  double fields_every = 0;   ///< in time; 0: the beginning and the end
  std::vector<double> fields_at;    ///< in time, beside the above
  long check_every = 100;           ///< steps between ledgers, whether a row is due or not
  double balance_tolerance = 0.05;  ///< |balance| / largest sum of energies so far, to stop at
  const volatile std::sig_atomic_t* stop = nullptr;  ///< becomes non-zero when the run shall end
};

enum class Status { completed, not_converged, interrupted, failed };

struct Outcome {
  Status status = Status::completed;
  std::string message;                          ///< for people; empty if completed
  Observation last;                             ///< at the final state
  std::optional<Equilibrium> equilibrium = {};  ///< of a static run, or of a static start
};

/// Tolerance of the equilibrium that a dynamic run starts from.
inline constexpr double static_start_tolerance = 1e-9;

/// Run to the plan's end. A static run takes loads and supports as they are once no curve changes any more,
/// and reckons them as grown in proportion from nothing; it makes one row of history. The final state is
/// always observed: a last row and last fields are due whatever happened.
Outcome run(Simulation& sim, const RunPlan& plan, const std::vector<Observer*>& observers);

/// Where the first value that is no number stands: region and node, element or site, in words; empty if all
/// are.
std::string first_not_finite(const Model& model);

/// Where the largest velocity is, in the same words.
std::string fastest(const Model& model);

}  // namespace geist
