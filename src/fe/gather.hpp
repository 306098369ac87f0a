// Bringing the corners of a block's elements together: from arrays by node to Corners<Pack>, and forces back.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "core/pack.hpp"
#include "fe/modes.hpp"
#include "model/mesh.hpp"

namespace geist::fe {

/// Corners a and a + 1 in ξ: the node of the second is the node after that of the first, where there are
/// rows.
inline constexpr int edges_along_row[4][2] = {{0, 1}, {3, 2}, {4, 5}, {7, 6}};

/// {0, a[0], …, a[6]}.
template <int... l>
GEIST_INLINE Pack moved_up(Pack a, std::integer_sequence<int, l...>) {
  return __builtin_shufflevector(a, Pack{}, (l == 0 ? lanes : l - 1)...);
}
GEIST_INLINE Pack moved_up(Pack a) { return moved_up(a, std::make_integer_sequence<int, lanes>()); }

/// All ones in lanes l < n.
GEIST_INLINE PackInt lanes_below(int n) {
  PackInt lane;
  for (int l = 0; l < lanes; ++l) lane[l] = l;
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
  static constexpr std::int32_t in_room[8] = {0,          3 * lanes,  6 * lanes,  9 * lanes,
                                              12 * lanes, 15 * lanes, 18 * lanes, 21 * lanes};

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
      for (int i = 0; i < 3; ++i)
        for (int l = 0; l < lanes; ++l) x[a][i][l] = component[i][node[l][a]];
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
        add(p + lanes, factor, f[b][i][lanes - 1]);
      }
  }

  /// As a row; lanes after the end go one place further.
  GEIST_INLINE void add_around_end(const HexBlock& block, double factor, const Corners<Pack>& f) const {
    const PackInt before = lanes_below(block.in_row);
    const Pack none = broadcast(0);
    for (const auto [a, b] : edges_along_row)
      for (int i = 0; i < 3; ++i) {
        double* const p = component[i] + elements[block.first][a];
        const Pack last = before ? none : f[b][i], after = (before ? none : f[a][i]) + moved_up(last);
        const Pack in_row = (before ? f[a][i] : none) + moved_up(before ? f[b][i] : none);
        add(p, factor, in_row + moved_up(after));
        add(p + lanes, factor, after[lanes - 1]);
        add(p + lanes + 1, factor, last[lanes - 1]);
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
