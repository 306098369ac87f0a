// Mesh: blocks of eight elements and the lists by which nodes gather from them.
#include "model/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
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

TEST(Mesh, RegionsBeginNewBlocksAndTheLastElementFillsTheirLanes) {
  const Mesh mesh = random_mesh(region_sizes);
  std::size_t next_block = 0;
  for (const HexRegion& region : mesh.regions) {
    EXPECT_EQ(region.first_block, next_block);
    EXPECT_EQ(region.blocks(), (region.count + 7) / 8);
    for (std::size_t place = 0; place < region.blocks() * lanes; ++place) {
      const auto& element = mesh.elements[region.first + std::min(place, region.count - 1)];
      const HexBlock& block = mesh.blocks[next_block + place / lanes];
      for (int a = 0; a < 8; ++a) EXPECT_EQ(block.node[a][place % lanes], element[a]);
    }
    next_block += region.blocks();
  }
  EXPECT_EQ(mesh.blocks.size(), next_block);
  EXPECT_EQ(mesh.corner_force.size(), next_block * 8 * 3 * 8);
}

TEST(Mesh, GatheringAddsEveryCornerOnceAndNothingOfTheSpareLanes) {
  Mesh mesh = random_mesh(region_sizes);
  std::fill(mesh.corner_force.begin(), mesh.corner_force.end(), std::numeric_limits<double>::quiet_NaN());
  std::vector<Vec3> expected(mesh.nodes());
  for (const HexRegion& region : mesh.regions)
    for (std::size_t i = 0; i < region.count; ++i)
      for (int a = 0; a < 8; ++a)
        for (int c = 0; c < 3; ++c) {
          const double force = static_cast<double>(1000 * (region.first + i) + 10 * a + c);  // sums are exact
          // [block][corner][component][lane], as the header has it
          mesh.corner_force[(((region.first_block + i / 8) * 8 + a) * 3 + c) * 8 + i % 8] = force;
          expected[mesh.elements[region.first + i][a]][c] += force;
        }
  for (std::size_t node = 0; node < mesh.nodes(); ++node)
    for (int c = 0; c < 3; ++c) {
      double total = 0;
      for (auto k = mesh.gather_begin[node]; k < mesh.gather_begin[node + 1]; ++k)
        total += mesh.corner_force[mesh.gather[k] + 8 * c];
      EXPECT_EQ(total, expected[node][c]);
    }
}

TEST(Mesh, NodesGatherInOrderOfElements) {
  const Mesh mesh = random_mesh(region_sizes);
  for (std::size_t node = 0; node < mesh.nodes(); ++node)
    for (auto k = mesh.gather_begin[node] + 1; k < mesh.gather_begin[node + 1]; ++k) {
      const auto element_place = [&](std::int32_t slot) {
        return slot / (8 * 3 * lanes) * lanes + slot % lanes;
      };
      EXPECT_LT(element_place(mesh.gather[k - 1]), element_place(mesh.gather[k]));
    }
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
  EXPECT_TRUE(mesh.gather.empty());
}

}  // namespace
}  // namespace geist
