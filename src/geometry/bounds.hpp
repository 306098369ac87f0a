// The box around everything.
#pragma once
#include "geometry/shapes.hpp"
#include "model/model.hpp"

namespace geist {

/// Smallest box that holds all nodes and all particles' cells in the reference configuration.
Box bounds(const Model& model);

}  // namespace geist
