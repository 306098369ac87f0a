#include "model/lattice.hpp"

#include <algorithm>

namespace geist {

std::size_t Lattice::count(std::uint32_t flag) const {
  return std::count_if(word.begin(), word.end(), [flag](std::uint32_t w) { return w & flag; });
}

void finish(Lattice& lattice) {
  const std::size_t n = lattice.grid.size(), guard = lattice.grid.guard();
  lattice.motion = Field<6>(n, guard);
  lattice.velocity = Field<6>(n, guard);
  lattice.velocity_before = Field<6>(n, guard);
  if (lattice.kinematics == Kinematics::finite) lattice.rotation = Field<9>(n, guard);
}

void connect(Lattice& lattice) {
  const Grid& grid = lattice.grid;
  const auto flags_at = [&](int i, int j, int k) {
    return grid.contains(i, j, k) ? lattice.word[grid.index(i, j, k)] & ~site::bonds : 0u;
  };
  for (std::size_t s = 0; s < grid.size(); ++s) {
    const auto [i, j, k] = grid.ijk(s);
    const std::uint32_t here = lattice.word[s] & ~site::bonds;
    std::uint32_t bonds = 0;
    for (int d = 0; d < 18; ++d) {
      const auto [a, b, c] = directions[d];
      const std::uint32_t there = i < grid.nx ? flags_at(i + a, j + b, k + c) : 0u;
      const bool occupied = here && there, some_particle = (here | there) & site::particle;
      if (occupied && some_particle) bonds |= 1u << d;
    }
    lattice.word[s] = here | bonds;
  }
}

void list_sites(Lattice& lattice, const std::vector<std::size_t>& particles) {
  const Grid& grid = lattice.grid;
  for (std::size_t s : particles) lattice.word[s] &= ~site::free;
  lattice.listed.clear();
  lattice.listed_begin.assign(grid.rows() + 1, 0);
  for (std::size_t s = 0; s < grid.size(); ++s)
    if (lattice.word[s] & (site::particle | site::ghost) && !lattice.is(s, site::free)) {
      lattice.listed.push_back(s);
      ++lattice.listed_begin[s / grid.stride() + 1];
    }
  for (std::size_t r = 0; r < grid.rows(); ++r) lattice.listed_begin[r + 1] += lattice.listed_begin[r];
  lattice.listed_force = Field<6>(lattice.listed.size());
  lattice.listed_held.assign(lattice.listed.size(), 0);
  lattice.ghost_slot.clear();
  for (const Ghost& ghost : lattice.ghosts) {
    lattice.ghost_slot.push_back(listed_slot(lattice, ghost.site));
    lattice.listed_held[lattice.ghost_slot.back()] = 0b000111;  // follows its hexahedron
  }
}

std::int32_t listed_slot(const Lattice& lattice, std::size_t s) {
  const auto it = std::lower_bound(lattice.listed.begin(), lattice.listed.end(), s);
  return static_cast<std::int32_t>(it - lattice.listed.begin());
}

}  // namespace geist
