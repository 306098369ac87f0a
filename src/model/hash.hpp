// A fingerprint of a model's state, to see at a glance whether two runs ended with the same bits.
#pragma once
#include <cstdint>
#include <string>

#include "model/model.hpp"

namespace geist {

/// FNV-1a over the bits of displacements, rotations and velocities of all nodes, particles and ghosts, as 16
/// hex digits.
std::string state_hash(const Model& model);

}  // namespace geist
