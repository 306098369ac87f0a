// Mesh: blocks of eight elements and the order in which they may add to the nodes.
#include "model/mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace geist {
namespace {

/// Elements between nodes at random, in regions of the given numbers of elements.
Mesh random_mesh(const std::vector<std::size_t>& counts, int nodes = 40) {
  std::mt19937 random(8);
  Mesh mesh;
  for (int i = 0; i < nodes; ++i) mesh.points.push_back({1.0 * i, 2.0 * i, -0.5 * i});
  std::vector<std::int32_t> order(nodes);
  for (int i = 0; i < nodes; ++i) order[i] = i;
  for (const std::size_t count : counts) {
    HexRegion region;
    region.first = mesh.elements.size(), region.count = count;
    mesh.regions.push_back(region);
    for (std::size_t e = 0; e < count; ++e) {
      std::shuffle(order.begin(), order.end(), random);
      std::array<std::int32_t, 8> element;
      std::copy_n(order.begin(), 8, element.begin());
      mesh.elements.push_back(element);
    }
  }
  finish(mesh);
  return mesh;
}

const std::vector<std::size_t> region_sizes{5, 8, 17, 1};

/// n × n × n cells, x fastest.
Mesh cube_mesh(int n) {
  Mesh mesh;
  const auto node = [n](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  mesh.points.resize(static_cast<std::size_t>((n + 1) * (n + 1) * (n + 1)));
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        mesh.elements.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
                                 node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
                                 node(i, j + 1, k + 1)});
  HexRegion region;
  region.count = mesh.elements.size();
  mesh.regions.push_back(region);
  finish(mesh);
  return mesh;
}

TEST(Mesh, RegionsBeginNewBlocks) {
  const Mesh mesh = random_mesh(region_sizes);
  std::size_t next_block = 0;
  for (const HexRegion& region : mesh.regions) {
    EXPECT_EQ(region.first_block, next_block);
    EXPECT_EQ(region.blocks(), (region.count + 7) / 8);
    std::size_t next = region.first;
    for (; next < region.first + region.count; ++next_block) {
      const HexBlock& block = mesh.blocks[next_block];
      EXPECT_EQ(block.first, static_cast<std::int32_t>(next));
      EXPECT_EQ(block.count, std::min<std::size_t>(8, region.first + region.count - next));
      EXPECT_EQ(block.in_row, 0);
      next += block.count;
    }
  }
  EXPECT_EQ(mesh.blocks.size(), next_block);
}

TEST(Mesh, BlocksAreRowsOrGoAroundTheirEnds) {
  const Mesh mesh = cube_mesh(12);  // rows of a block and a half; a layer is eighteen blocks
  const int expected[3] = {8, 4, 8};
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) EXPECT_EQ(mesh.blocks[b].in_row, expected[b % 3]) << b;
  Mesh other = cube_mesh(24);  // a layer ends with a whole block
  std::swap(other.elements[30][4], other.elements[30][5]);
  finish(other);
  for (std::size_t b = 0; b < other.blocks.size(); ++b)
    EXPECT_EQ(other.blocks[b].in_row, b == 3 ? 0 : 8) << b;
  const Mesh odd = cube_mesh(9);  // in the eleventh block a layer ends, whose last row of nodes lies between
  EXPECT_EQ(odd.blocks[1].in_row, 1);
  EXPECT_EQ(odd.blocks[2].in_row, 2);
  EXPECT_EQ(odd.blocks[10].in_row, 0);
}

/// Every block is swept once, and slabs that add at the same time share no node.
void expect_fair(const Mesh& mesh, const Sweep& sweep, std::vector<std::int32_t> blocks) {
  std::vector<std::int32_t> swept = sweep.blocks;
  std::sort(swept.begin(), swept.end());
  EXPECT_EQ(swept, blocks);
  ASSERT_EQ(sweep.slab_begin.back(), sweep.blocks.size());
  ASSERT_EQ(sweep.colour_begin.back(), sweep.slabs());
  for (std::size_t c = 0; c < sweep.colours(); ++c) {
    std::vector<std::size_t> slab_of(mesh.nodes(), sweep.slabs());
    for (std::size_t s = sweep.colour_begin[c]; s < sweep.colour_begin[c + 1]; ++s)
      for (std::size_t i = sweep.slab_begin[s]; i < sweep.slab_begin[s + 1]; ++i) {
        const HexBlock& block = mesh.blocks[sweep.blocks[i]];
        for (int l = 0; l < block.count; ++l)
          for (const std::int32_t node : mesh.elements[block.first + l]) {
            EXPECT_TRUE(slab_of[node] == sweep.slabs() || slab_of[node] == s);
            slab_of[node] = s;
          }
      }
  }
}

TEST(Mesh, SlabsOfOneColourShareNoNode) {
  std::vector<std::int32_t> all;
  const auto number = [&all](const Mesh& mesh) {
    all.resize(mesh.blocks.size());
    for (std::size_t b = 0; b < all.size(); ++b) all[b] = static_cast<std::int32_t>(b);
  };
  for (const Mesh& mesh : {random_mesh({300, 700, 1}, 2000), cube_mesh(12), cube_mesh(24)}) {
    number(mesh);
    expect_fair(mesh, mesh.sweep, all);
    std::vector<std::int32_t> some;
    for (const std::int32_t b : all)
      if (b % 7 < 3) some.push_back(b);
    expect_fair(mesh, make_sweep(mesh, some), some);
  }
}

TEST(Mesh, ABlockOfManyLayersHasTwoColours) {
  EXPECT_GT(random_mesh({700}, 2000).sweep.colours(), 10u);
  const Mesh mesh = cube_mesh(40);
  EXPECT_EQ(mesh.sweep.colours(), 2u);
  EXPECT_EQ(mesh.sweep.slabs(), 32u);
}

TEST(Mesh, StateIsZeroAndPositionsAreKeptByComponent) {
  const Mesh mesh = random_mesh({3});
  for (std::size_t i = 0; i < mesh.nodes(); ++i) {
    EXPECT_EQ(mesh.X.vector(i), mesh.points[i]);
    for (const Field<3>* f : {&mesh.u, &mesh.v, &mesh.v_before, &mesh.f}) EXPECT_EQ(f->vector(i), Vec3{});
    EXPECT_EQ(mesh.held[i], 0);
    EXPECT_EQ(mesh.mass[i], 0);
  }
}

TEST(Mesh, MayBeEmpty) {
  const Mesh mesh = random_mesh({}, 0);
  EXPECT_EQ(mesh.nodes(), 0u);
  EXPECT_TRUE(mesh.blocks.empty());
  EXPECT_EQ(mesh.sweep.slabs(), 0u);
  EXPECT_EQ(mesh.sweep.colours(), 0u);
}

}  // namespace
}  // namespace geist
