// Bringing the corners of eight elements together: from arrays by node to Corners<Pack>, and forces back to
// their slots.
#pragma once
#include <array>
#include <cstdint>
#include <cstring>

#include "core/pack.hpp"
#include "fe/modes.hpp"
#include "model/mesh.hpp"

namespace geist::fe {

/// {p[i[0]], …, p[i[7]]}.
GEIST_INLINE Pack gather(const double* p, const std::array<std::int32_t, lanes>& i) {
  Pack a;
  for (int l = 0; l < lanes; ++l) a[l] = p[i[l]];
  return a;
}

/// A vector field by node, component by component.
struct NodeField {
  const double* component[3];
  explicit NodeField(const Field<3>& f) : component{f[0], f[1], f[2]} {}

  GEIST_INLINE Corners<Pack> at(const HexBlock& block) const {
    Corners<Pack> x;
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) x[a][i] = gather(component[i], block.node[a]);
    return x;
  }
};

/// Write the forces of block b to corner_force (layout: model/mesh.hpp).
GEIST_INLINE void store_forces(const Corners<Pack>& f, double* corner_force, std::size_t b) {
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) store(corner_force + corner_slot(b, a, 0) + lanes * i, f[a][i]);
}

}  // namespace geist::fe
