// From a validated case to a simulation that can run.
#pragma once
#include <vector>

#include "case/case.hpp"
#include "solver/probes.hpp"
#include "solver/run.hpp"
#include "solver/simulation.hpp"
#include "solver/time_step.hpp"

namespace geist {

/// A simulation with what is asked of it.
struct Built {
  Simulation simulation;
  std::vector<Probe> probes;          ///< in file order
  std::vector<TimeStepBound> bounds;  ///< one for each region
  double expected_gain = 1;           ///< of subcycling, in time
};

/// Make regions, ghosts, supports, loads, initial motion and probes, and choose the time step.
/// Throws CaseError for what only the geometry shows: regions that clash, empty selections, a time step that
/// is too long.
Built build(const Case& input);

/// How it is to be run; nothing stops it before its end.
RunPlan plan_of(const Case& input);

}  // namespace geist
