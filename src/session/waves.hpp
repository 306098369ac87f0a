// How fine the waves are that a model carries, and what its interfaces reflect.
#pragma once
#include <string>

#include "case/case.hpp"
#include "model/model.hpp"

namespace geist {

/// By region the shortest wave that is carried within 1 % of its speed, and by interface what it reflects of
/// a plane wave at normal incidence (coupling/reflection.hpp).
std::string describe_waves(const Case& input, const Model& model);

}  // namespace geist
