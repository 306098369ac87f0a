// The box around everything.
#pragma once
#include <vector>

#include "geometry/shapes.hpp"
#include "model/model.hpp"

namespace geist {

/// Smallest box that holds all nodes and all particles' cells in the reference configuration.
Box bounds(const Model& model);

/// Smallest box that holds all these, of which there is at least one.
Box bounds(const std::vector<Box>& boxes);

}  // namespace geist
