#include "model/mesh.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "core/disjoint_sets.hpp"

namespace geist {
namespace {

/// HexBlock::in_row.
int lanes_in_row(const Mesh& mesh, const HexBlock& block) {
  if (block.count < lanes) return 0;
  const auto* const element = &mesh.elements[static_cast<std::size_t>(block.first)];
  const auto& [a, b, c, d, e, f, g, h] = *element;
  if (b != a + 1 || c != d + 1 || f != e + 1 || g != h + 1) return 0;
  int in_row = 1;
  while (in_row < lanes && element[in_row][0] == a + in_row) ++in_row;
  for (int l = 1; l < lanes; ++l)
    for (int k = 0; k < 8; ++k)
      if (element[l][k] != element[0][k] + l + (l < in_row ? 0 : 1)) return 0;
  return in_row;
}

void make_blocks(Mesh& mesh) {
  mesh.blocks.clear();
  for (HexRegion& region : mesh.regions) {
    region.first_block = mesh.blocks.size();
    for (std::size_t i = 0; i < region.count; i += lanes) {
      HexBlock block{static_cast<std::int32_t>(region.first + i),
                     static_cast<std::int8_t>(std::min<std::size_t>(lanes, region.count - i)), 0};
      block.in_row = static_cast<std::int8_t>(lanes_in_row(mesh, block));
      mesh.blocks.push_back(block);
    }
  }
}

/// Slab after slab (32 at most) the least colour that none of its nodes has seen.
std::vector<int> colours_of(const Mesh& mesh, const std::vector<std::int32_t>& blocks,
                            const std::vector<std::size_t>& limits) {
  std::vector<std::uint32_t> seen(mesh.nodes(), 0);  // bit c: a slab of colour c has the node
  std::vector<int> colours;
  for (std::size_t s = 0; s + 1 < limits.size(); ++s) {
    std::uint32_t taken = 0;
    const auto visit_slab = [&](const auto& visit) {
      for (std::size_t i = limits[s]; i < limits[s + 1]; ++i)
        visit_nodes(mesh, mesh.blocks[blocks[i]], visit);
    };
    visit_slab([&](std::int32_t node) { taken |= seen[node]; });
    colours.push_back(std::countr_one(taken));
    const std::uint32_t own = std::uint32_t{1} << colours.back();
    visit_slab([&](std::int32_t node) { seen[node] |= own; });
  }
  return colours;
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

std::vector<std::int32_t> bodies_of(const Mesh& mesh) {
  DisjointSets sets(mesh.nodes());
  for (const auto& element : mesh.elements)
    for (const std::int32_t node : element) sets.join(element[0], node);
  std::vector<std::int32_t> body(mesh.nodes());
  for (std::size_t i = 0; i < body.size(); ++i) body[i] = static_cast<std::int32_t>(sets.of(i));
  return body;
}

Sweep make_sweep(const Mesh& mesh, const std::vector<std::int32_t>& blocks) {
  constexpr std::size_t most_slabs = 32, least_blocks = 8;
  const std::size_t n = blocks.size(), slabs = std::min(most_slabs, (n + least_blocks - 1) / least_blocks);
  std::vector<std::size_t> limits;
  for (std::size_t s = 0; s <= slabs; ++s) limits.push_back(s * n / std::max<std::size_t>(slabs, 1));
  const std::vector<int> colours = colours_of(mesh, blocks, limits);
  Sweep sweep{.blocks = {}, .slab_begin = {0}, .colour_begin = {0}};
  for (int c = 0; std::count(colours.begin(), colours.end(), c); ++c) {
    for (std::size_t s = 0; s < slabs; ++s) {
      if (colours[s] != c) continue;
      sweep.blocks.insert(sweep.blocks.end(), blocks.begin() + static_cast<std::ptrdiff_t>(limits[s]),
                          blocks.begin() + static_cast<std::ptrdiff_t>(limits[s + 1]));
      sweep.slab_begin.push_back(sweep.blocks.size());
    }
    sweep.colour_begin.push_back(sweep.slabs());
  }
  return sweep;
}

void finish(Mesh& mesh) {
  make_blocks(mesh);
  std::vector<std::int32_t> all(mesh.blocks.size());
  std::iota(all.begin(), all.end(), 0);
  mesh.sweep = make_sweep(mesh, all);
  const std::size_t n = mesh.nodes();
  mesh.X = Field<3>(n), mesh.u = Field<3>(n), mesh.v = Field<3>(n), mesh.v_before = Field<3>(n);
  mesh.f = Field<3>(n);
  for (std::size_t i = 0; i < n; ++i) mesh.X.set(i, mesh.points[i]);
  mesh.mass.assign(n, 0.0);
  mesh.held.assign(n, 0);
}

}  // namespace geist
