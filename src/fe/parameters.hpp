// The constants that formulations take, from a region's material.
#pragma once
#include "fe/hooke.hpp"
#include "model/mesh.hpp"

namespace geist::fe {

inline Parameters parameters(const HexRegion& region) {
  const Material& m = region.material;
  return {m.lambda(), m.mu(), m.density, region.hourglass_coefficient};
}

}  // namespace geist::fe
