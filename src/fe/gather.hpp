// Bringing the corners of a block's elements together: from arrays by node to Corners<Pack>, and forces back.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "core/pack.hpp"
#include "fe/modes.hpp"
#include "model/mesh.hpp"

namespace geist::fe {

/// Corners a and a + 1 in ξ: the node of the second is the node after that of the first, where there are
/// rows.
inline constexpr int edges_along_row[4][2] = {{0, 1}, {3, 2}, {4, 5}, {7, 6}};

/// {0, a[0], …, a[6]}.
GEIST_INLINE Pack moved_up(Pack a) { return __builtin_shufflevector(a, Pack{}, 8, 0, 1, 2, 3, 4, 5, 6); }

/// All ones in lanes l < n.
GEIST_INLINE PackInt lanes_below(int n) {
  const PackInt lane{0, 1, 2, 3, 4, 5, 6, 7};
  return lane < n;
}

/// Packs of values at the corners, wherever they lie: component i of corner a at component[i] + offset[a].
struct CornerValues {
  const double* component[3];
  const std::int32_t* offset;

  GEIST_INLINE Corners<Pack> all() const {
    Corners<Pack> x;
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) x[a][i] = load(component[i] + offset[a]);
    return x;
  }
};

/// A vector field by node, component by component.
struct NodeField {
  const std::array<std::int32_t, 8>* elements;
  const double* component[3];
  NodeField(const Mesh& mesh, const Field<3>& f)
      : elements(mesh.elements.data()), component{f[0], f[1], f[2]} {}

  /// At the corners of a block's elements: in place if they are a row, otherwise brought to `room`.
  GEIST_INLINE CornerValues at(const HexBlock& block, Corners<Pack>& room) const {
    if (block.in_row == lanes)
      return {{component[0], component[1], component[2]}, elements[block.first].data()};
    if (block.in_row)
      bring_around_end(block, room);
    else
      bring(block, room);
    const double* const p = reinterpret_cast<const double*>(&room);
    return {{p, p + lanes, p + 2 * lanes}, in_room};
  }

 private:
  static constexpr std::int32_t in_room[8] = {0, 24, 48, 72, 96, 120, 144, 168};

  GEIST_INLINE void bring_around_end(const HexBlock& block, Corners<Pack>& x) const {
    const PackInt before = lanes_below(block.in_row);
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) {
        const double* const p = component[i] + elements[block.first][a];
        x[a][i] = before ? load(p) : load(p + 1);
      }
  }

  /// The last element fills the lanes left over.
  __attribute__((noinline)) void bring(const HexBlock& block, Corners<Pack>& x) const {
    const std::int32_t* node[lanes];
    for (int l = 0; l < lanes; ++l)
      node[l] = elements[block.first + std::min<int>(l, block.count - 1)].data();
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) {
        const double* const p = component[i];
        x[a][i] = Pack{p[node[0][a]], p[node[1][a]], p[node[2][a]], p[node[3][a]],
                       p[node[4][a]], p[node[5][a]], p[node[6][a]], p[node[7][a]]};
      }
  }
};

/// Forces by node, to which those of elements are added.
struct NodeForces {
  const std::array<std::int32_t, 8>* elements;
  double* component[3];
  NodeForces(const Mesh& mesh, Field<3>& f) : elements(mesh.elements.data()), component{f[0], f[1], f[2]} {}

  /// += factor · f.
  GEIST_INLINE void add(const HexBlock& block, double factor, const Corners<Pack>& f) const {
    if (block.in_row == lanes)
      add_row(block, factor, f);
    else if (block.in_row)
      add_around_end(block, factor, f);
    else
      add_each(block, factor, f);
  }

 private:
  static GEIST_INLINE void add(double* p, double factor, double f) { *p = fma(factor, f, *p); }
  static GEIST_INLINE void add(double* p, double factor, Pack f) { store(p, fma(factor, f, load(p))); }

  GEIST_INLINE void add_row(const HexBlock& block, double factor, const Corners<Pack>& f) const {
    for (const auto [a, b] : edges_along_row)
      for (int i = 0; i < 3; ++i) {
        double* const p = component[i] + elements[block.first][a];
        add(p, factor, f[a][i] + moved_up(f[b][i]));
        add(p + 8, factor, f[b][i][7]);
      }
  }

  /// As a row; lanes after the end go one place further.
  GEIST_INLINE void add_around_end(const HexBlock& block, double factor, const Corners<Pack>& f) const {
    const PackInt before = lanes_below(block.in_row);
    const Pack none = broadcast(0);
    for (const auto [a, b] : edges_along_row)
      for (int i = 0; i < 3; ++i) {
        double* const p = component[i] + elements[block.first][a];
        const Pack s = before ? f[a][i] : none, t = before ? none : f[a][i];
        const Pack v = before ? f[b][i] : none, w = before ? none : f[b][i];
        add(p, factor, (s + moved_up(v)) + moved_up(t + moved_up(w)));
        add(p + 8, factor, (v[7] + t[7]) + w[6]);
        add(p + 9, factor, w[7]);
      }
  }

  __attribute__((noinline)) void add_each(const HexBlock& block, double factor,
                                          const Corners<Pack>& f) const {
    for (int l = 0; l < block.count; ++l)
      for (int a = 0; a < 8; ++a)
        for (int i = 0; i < 3; ++i) add(component[i] + elements[block.first + l][a], factor, f[a][i][l]);
  }
};

}  // namespace geist::fe
