#include "model/hash.hpp"

#include <bit>

namespace geist {
namespace {

class Fnv {
 public:
  void add(double x) {
    auto bits = std::bit_cast<std::uint64_t>(x);
    for (int byte = 0; byte < 8; ++byte, bits >>= 8) state_ = (state_ ^ (bits & 0xFF)) * 0x100000001B3ull;
  }
  std::string hex() const {
    std::string text;
    for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[state_ >> shift & 0xF];
    return text;
  }

 private:
  std::uint64_t state_ = 0xCBF29CE484222325ull;
};

}  // namespace

std::string state_hash(const Model& model) {
  Fnv fnv;
  for (std::size_t i = 0; i < model.mesh.nodes(); ++i)
    for (int c = 0; c < 3; ++c) fnv.add(model.mesh.u[c][i]), fnv.add(model.mesh.v[c][i]);
  for (const Lattice& lattice : model.lattices)
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      if (lattice.word[s]) {
        for (int c = 0; c < 6; ++c) fnv.add(lattice.motion[c][s]), fnv.add(lattice.velocity[c][s]);
        for (int c = 0; lattice.rotation.size() > 0 && c < 9; ++c) fnv.add(lattice.rotation[c][s]);
      }
  return fnv.hex();
}

}  // namespace geist
