#include "solver/relaxation.hpp"

#include <algorithm>
#include <cmath>

namespace geist {

void Relaxation::update(Simulation& sim) {
  omega2_ = sim.frequency_squared();
  sim.alpha = std::min(2 * std::sqrt(omega2_), 1.0 / sim.dt);
}

}  // namespace geist
