// Bringing the corners of a block's elements together: from arrays by node to Corners<Pack>, and forces back.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "core/pack.hpp"
#include "fe/modes.hpp"
#include "model/mesh.hpp"

namespace geist::fe {

/// Corner nodes by element, for the element in lane l of a block.
struct CornerNodes {
  const std::array<std::int32_t, 8>* elements;
  explicit CornerNodes(const Mesh& mesh) : elements(mesh.elements.data()) {}

  GEIST_INLINE const std::int32_t* of(const HexBlock& block, int l = 0) const {
    return elements[block.first + l].data();
  }
};

/// A vector field by node, component by component.
struct NodeField {
  CornerNodes nodes;
  const double* component[3];
  NodeField(const Mesh& mesh, const Field<3>& f) : nodes(mesh), component{f[0], f[1], f[2]} {}

  GEIST_INLINE Corners<Pack> at(const HexBlock& block) const {
    Corners<Pack> x;
    if (block.run)
      load_run(nodes.of(block), x);
    else
      gather(block, x);
    return x;
  }

 private:
  GEIST_INLINE void load_run(const std::int32_t* node, Corners<Pack>& x) const {
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) x[a][i] = load(component[i] + node[a]);
  }

  /// The last element fills the lanes left over.
  GEIST_INLINE void gather(const HexBlock& block, Corners<Pack>& x) const {
    for (int l = 0; l < lanes; ++l) {
      const std::int32_t* const node = nodes.of(block, std::min<int>(l, block.count - 1));
      for (int a = 0; a < 8; ++a)
        for (int i = 0; i < 3; ++i) x[a][i][l] = component[i][node[a]];
    }
  }
};

/// Forces by node, to which those of elements are added.
struct NodeForces {
  CornerNodes nodes;
  double* component[3];
  NodeForces(const Mesh& mesh, Field<3>& f) : nodes(mesh), component{f[0], f[1], f[2]} {}

  /// += factor · f, corner after corner.
  GEIST_INLINE void add(const HexBlock& block, double factor, const Corners<Pack>& f) const {
    if (block.run)
      add_run(nodes.of(block), factor, f);
    else
      scatter(block, factor, f);
  }

 private:
  GEIST_INLINE void add_run(const std::int32_t* node, double factor, const Corners<Pack>& f) const {
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) {
        double* const p = component[i] + node[a];
        store(p, fma(factor, f[a][i], load(p)));
      }
  }

  GEIST_INLINE void scatter(const HexBlock& block, double factor, const Corners<Pack>& f) const {
    for (int l = 0; l < block.count; ++l) {
      const std::int32_t* const node = nodes.of(block, l);
      for (int a = 0; a < 8; ++a)
        for (int i = 0; i < 3; ++i) {
          double& p = component[i][node[a]];
          p = fma(factor, f[a][i][l], p);
        }
    }
  }
};

}  // namespace geist::fe
