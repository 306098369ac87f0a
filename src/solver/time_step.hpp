// The largest time step that is surely stable.
//
// Central differences are stable for Δt ≤ 2/ω_max. ω_max is bounded from above by energies:
//  - elements: E_e(u) ≤ ½ ω_e² Σ m_eI u_I², with ω_e the element's own largest frequency and m_eI its corner
//  masses;
//  - bonds: E(u, θ) ≤ ½ ω_L² (Σ m_d u² + I_d θ²) over particles and ghosts, with ω_L that of the endless
//  lattice,
//    since a bond that is missing only takes energy away;
//  - ghosts follow nodes, |Σ N_I u_I|² ≤ Σ N_I |u_I|², so they charge node I with the mass Σ_g N_I m_d.
//  - contacts: a spring across the gap charges either side with 2 k (Contacts::node_charges), c_I and c_d.
// Hence ω_max² ≤ max( ω_L² + c_d, max over I of (Σ_e ω_e² m_eI + ω_L² Σ_g N_I m_d + c_I) / m_I ), over the
// nodes that are not held.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "contact/contacts.hpp"
#include "model/model.hpp"

namespace geist {

/// A region's bound and what sets it.
struct TimeStepBound {
  std::string region;
  double bound;       ///< largest surely stable Δt of the region, time
  std::string limit;  ///< e.g. "smallest element at (…)", "node at (…) under the ghosts of 'middle'", "bonds,
                      ///< r = 0.1"
};

/// One bound for each region, mesh regions first.
std::vector<TimeStepBound> time_step_bounds(const Model& model, const contact::Contacts& contacts);

/// By node: ω² of the sum above, over its regions the largest, 0 where a support holds it; what ghosts and
/// contacts have in that, Σ ω² m / m_I; and whether elements with viscous control act on it.
struct NodeLimits {
  std::vector<double> frequency_squared, of_ghosts, of_contacts;
  std::vector<std::uint8_t> viscous;
};

/// The bounds, what those of hexahedra are made of, and whether particles may touch anything.
struct TimeStepLimits {
  std::vector<TimeStepBound> bounds;
  NodeLimits nodes;
  bool particles_may_touch = false;
};
TimeStepLimits time_step_limits(const Model& model, const contact::Contacts& contacts);

/// The smallest of them.
const TimeStepBound& critical(const std::vector<TimeStepBound>& bounds);

/// x rounded down to five significant digits, so that the step does not depend on a library's last bit.
double rounded_down(double x);

}  // namespace geist
