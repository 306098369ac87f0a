// What the program understood of a case, in words.
#pragma once
#include <cstddef>
#include <string>

#include "case/build.hpp"
#include "output/units.hpp"

namespace geist {

/// Sizes, masses, materials with the lattice's recovered E and ν, the time step and what limits it, memory,
/// and how many steps there will be.
std::string describe(const Case& input, const Built& built);

output::UnitSystem units_of(const Case& input);

/// Hexahedra that take short steps.
std::size_t fine_hexahedra(const Simulation& sim);

/// Bytes that the arrays of the model and of its short steps take.
double memory_of(const Simulation& sim);

/// Threads that pay off for a model of this size on this machine: a step much shorter than the wake-up of
/// threads (which other programs on the machine lengthen a hundredfold) is better done by one.
int worthwhile_threads(const Model& model);

}  // namespace geist
