// Which part of a model takes shorter steps than the rest, how many, and how long the step of the rest is
// then.
#pragma once
#include <cstdint>
#include <vector>

#include "model/model.hpp"
#include "solver/time_step.hpp"

namespace geist {

/// What takes m short steps in each of the model's, and what that needs to know of the mesh.
struct FinePart {
  int m = 1;
  bool lattices = false;              ///< all of them, or none
  std::vector<std::uint8_t> is_fine;  ///< by node
  std::vector<std::int32_t> blocks;   ///< with an element that has a fine node, in ascending order
  std::vector<std::int32_t> others;   ///< the other blocks

  bool empty() const { return blocks.empty() && !lattices; }
};

/// The model's time step, and what must take shorter ones.
struct Division {
  double dt = 0;
  FinePart fine;
  double gain = 1;  ///< expected: time of a run with one step for all over that with these two
};

/// What must take short steps, and the fewest, for the rest to take dt; nothing if that cannot be. Every
/// limit is kept with a factor of `safety`. Fine is what vibrates with more than 2 safety/dt, and all nodes
/// that share an element or a ghost with that; the whole body where contacts, or ghosts of lattices that are
/// not fine, act on it, which must be weak then (stable_remainder). Particles that may touch are never fine.
FinePart fine_part(const Model& model, const TimeStepLimits& limits, double dt, double safety);

/// The division with the largest gain, or none (and dt = 0) if that is below 5 %. Gains are reckoned with the
/// times that one core needs for elements, nodes and particles.
Division best_division(const Model& model, const TimeStepLimits& limits, double safety);

}  // namespace geist
