// Free bodies: what no support holds in place, so that it has no state of rest.
#pragma once
#include <string>

#include "model/model.hpp"

namespace geist {

/// The first piece of the model, in words, that can move as a rigid body; empty if there is none. Pieces are
/// joined by elements, bonds and ghosts.
std::string find_free_body(const Model& model);

}  // namespace geist
