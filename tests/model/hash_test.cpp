// The fingerprint of a state: a known function of the bits, and of every bit.
#include "model/hash.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <set>

namespace geist {
namespace {

/// One hexahedron, and a row of three sites: a particle, a ghost and an empty one.
Model small_model() {
  Model model;
  for (int i = 0; i < 8; ++i) model.mesh.points.push_back({1.0 * i, 0, 0});
  model.mesh.elements.push_back({0, 1, 2, 3, 4, 5, 6, 7});
  model.mesh.regions.emplace_back().count = 1;
  finish(model.mesh);
  Lattice lattice;
  lattice.grid = {3, 1, 1, {}, 1};
  lattice.word.assign(lattice.grid.size(), 0);
  lattice.word[0] = site::particle | site::free, lattice.word[1] = site::ghost;
  connect(lattice), finish(lattice);
  model.lattices.push_back(std::move(lattice));
  return model;
}

void flip(double& x, int bit) {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  bits ^= std::uint64_t{1} << bit;
  std::memcpy(&x, &bits, sizeof bits);
}

TEST(StateHash, IsFnv1aOfTheBytes) {
  EXPECT_EQ(state_hash(Model{}), "cbf29ce484222325");  // FNV's offset basis: nothing hashed
  const Model model = small_model();
  std::uint64_t hash = 0xcbf29ce484222325u;
  const int numbers = 8 * 6 + 2 * 12;  // all zero: exclusive or does nothing
  for (int byte = 0; byte < 8 * numbers; ++byte) hash *= 0x100000001b3u;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  EXPECT_EQ(state_hash(model), text);
}

TEST(StateHash, ChangesWithEveryBitOfTheState) {
  Model model = small_model();
  std::set<std::string> seen{state_hash(model)};
  std::size_t changes = 0;
  const auto flip_all = [&](double& x) {
    for (int bit = 0; bit < 64; ++bit, ++changes) {
      flip(x, bit);
      EXPECT_TRUE(seen.insert(state_hash(model)).second);
      flip(x, bit);
    }
  };
  for (int c = 0; c < 3; ++c) flip_all(model.mesh.u[c][5]), flip_all(model.mesh.v[c][7]);
  Lattice& lattice = model.lattices[0];
  for (int c = 0; c < 6; ++c)
    for (const std::size_t s : {0, 1}) flip_all(lattice.motion[c][s]), flip_all(lattice.velocity[c][s]);
  EXPECT_EQ(seen.size(), changes + 1);
  EXPECT_TRUE(seen.contains(state_hash(model)));
}

TEST(StateHash, KnowsNothingOfEmptySites) {
  Model model = small_model();
  const std::string before = state_hash(model);
  model.lattices[0].motion[0][2] = 1, model.lattices[0].velocity[4][6] = 2;
  EXPECT_EQ(state_hash(model), before);
}

}  // namespace
}  // namespace geist
