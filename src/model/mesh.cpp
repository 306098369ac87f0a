#include "model/mesh.hpp"

#include <algorithm>

namespace geist {
namespace {

void make_blocks(Mesh& mesh) {
  mesh.blocks.clear();
  for (HexRegion& region : mesh.regions) {
    region.first_block = mesh.blocks.size();
    for (std::size_t b = 0; b < region.blocks(); ++b) {
      HexBlock block;
      for (int l = 0; l < lanes; ++l) {
        const std::size_t e = region.first + std::min(b * lanes + l, region.count - 1);
        for (int a = 0; a < 8; ++a) block.node[a][l] = mesh.elements[e][a];
      }
      mesh.blocks.push_back(block);
    }
  }
}

/// Call visit(node, slot) for every corner of every element, in order.
template <class F>
void visit_corners(const Mesh& mesh, F visit) {
  for (const HexRegion& region : mesh.regions)
    for (std::size_t i = 0; i < region.count; ++i)
      for (int a = 0; a < 8; ++a)
        visit(mesh.elements[region.first + i][a],
              corner_slot(region.first_block + i / lanes, a, static_cast<int>(i % lanes)));
}

void make_gather_lists(Mesh& mesh) {
  mesh.gather_begin.assign(mesh.nodes() + 1, 0);
  visit_corners(mesh, [&](int node, std::size_t) { ++mesh.gather_begin[node + 1]; });
  for (std::size_t i = 0; i < mesh.nodes(); ++i) mesh.gather_begin[i + 1] += mesh.gather_begin[i];
  mesh.gather.resize(mesh.gather_begin.back());
  std::vector<std::int32_t> next(mesh.gather_begin.begin(), mesh.gather_begin.end() - 1);
  visit_corners(
      mesh, [&](int node, std::size_t slot) { mesh.gather[next[node]++] = static_cast<std::int32_t>(slot); });
}

}  // namespace

std::int32_t region_of(const Mesh& mesh, std::int32_t element) {
  const auto e = static_cast<std::size_t>(element);
  const auto holds = [e](const HexRegion& r) { return e >= r.first && e < r.first + r.count; };
  return static_cast<std::int32_t>(std::find_if(mesh.regions.begin(), mesh.regions.end(), holds) -
                                   mesh.regions.begin());
}

const HexCut* cut_of(const Mesh& mesh, std::size_t element) {
  const auto e = static_cast<std::int32_t>(element);
  const auto it = std::lower_bound(mesh.cuts.begin(), mesh.cuts.end(), e,
                                   [](const HexCut& cut, std::int32_t i) { return cut.element < i; });
  return it != mesh.cuts.end() && it->element == e ? &*it : nullptr;
}

void finish(Mesh& mesh) {
  make_blocks(mesh);
  make_gather_lists(mesh);
  const std::size_t n = mesh.nodes();
  mesh.X = Field<3>(n), mesh.u = Field<3>(n), mesh.v = Field<3>(n), mesh.v_before = Field<3>(n);
  mesh.f = Field<3>(n);
  for (std::size_t i = 0; i < n; ++i) mesh.X.set(i, mesh.points[i]);
  mesh.mass.assign(n, 0.0);
  mesh.held.assign(n, 0);
  mesh.corner_force.assign(mesh.blocks.size() * 8 * 3 * lanes, 0.0);
}

}  // namespace geist
