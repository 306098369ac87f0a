// Supports, loads, initial motion and probes of a case, on the nodes and particles of its model.
#pragma once
#include "case/select.hpp"
#include "solver/simulation.hpp"

namespace geist {

/// All throw CaseError for selections that hold nothing, or nothing of the kind that is needed.
Supports make_supports(const Case& input, const Selector& selector);
std::vector<Load> make_loads(const Case& input, const Selector& selector);

/// Motion at time 0.
void set_initial_motion(Model& model, const Case& input, const Selector& selector);

std::vector<Probe> make_probes(const Case& input, const Selector& selector, const Simulation& sim);

}  // namespace geist
