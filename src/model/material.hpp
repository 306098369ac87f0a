// Material: isotropic linear elasticity.
#pragma once
#include <string>

namespace geist {

/// Isotropic elastic material in the case's units: density (mass/length³), Young's modulus (stress),
/// Poisson's ratio.
struct Material {
  std::string name;
  double density = 0, young = 0, poisson = 0;

  double lambda() const { return young * poisson / ((1 + poisson) * (1 - 2 * poisson)); }
  double mu() const { return young / (2 * (1 + poisson)); }
};

}  // namespace geist
