#include "geometry/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "geometry/bounds.hpp"

namespace geist {
namespace {

/// How many pitches `length` is; it must be a whole number.
int whole_pitches(double length, double pitch, const char* what) {
  const double n = std::round(length / pitch);
  if (!is_whole(length, pitch))
    throw std::invalid_argument(
        fmt::format("{} of {} is no whole number of particle diameters ({})", what, length, pitch));
  return static_cast<int>(n);
}

void check_on_grid(const std::vector<Box>& boxes, Vec3 low, double pitch) {
  for (const Box& b : boxes)
    for (int c = 0; c < 3; ++c) {
      if (whole_pitches(b.high[c] - b.low[c], pitch, "an edge") < 1)
        throw std::invalid_argument("a box is thinner than one particle");
      whole_pitches(b.low[c] - low[c], pitch, "the distance between boxes");
    }
}

}  // namespace

bool is_whole(double length, double pitch) {
  const double ratio = length / pitch;
  return std::abs(ratio - std::round(ratio)) <= 1e-6 * std::max(1.0, std::abs(ratio));
}

void pack(Lattice& lattice, const std::vector<Box>& boxes, const std::vector<Shape>& minus, double radius) {
  const double pitch = 2 * radius, slack = 1e-9 * radius;
  const Box all = bounds(boxes);
  check_on_grid(boxes, all.low, pitch);
  Grid& grid = lattice.grid;
  const auto sites = [&](int c) { return whole_pitches(all.high[c] - all.low[c], pitch, "the region") + 2; };
  grid.nx = sites(0), grid.ny = sites(1), grid.nz = sites(2);
  grid.pitch = pitch;
  grid.origin = all.low - Vec3{radius, radius, radius};
  lattice.word.assign(grid.size(), 0);
  const auto inside = [&](Vec3 p) {
    const auto holds = [&](const auto& shape) { return contains(shape, p, slack); };
    return std::any_of(boxes.begin(), boxes.end(), holds) && std::none_of(minus.begin(), minus.end(), holds);
  };
  for (int k = 1; k + 1 < grid.nz; ++k)
    for (int j = 1; j + 1 < grid.ny; ++j)
      for (int i = 1; i + 1 < grid.nx; ++i)
        if (inside(grid.centre(i, j, k))) lattice.word[grid.index(i, j, k)] = site::particle | site::free;
}

void trim(Lattice& lattice) {
  const Grid old = lattice.grid;
  std::array<int, 3> low{old.nx, old.ny, old.nz}, high{-1, -1, -1};
  for (std::size_t s = 0; s < old.size(); ++s)
    if (lattice.word[s]) {
      const auto at = old.ijk(s);
      for (int c = 0; c < 3; ++c) low[c] = std::min(low[c], at[c]), high[c] = std::max(high[c], at[c]);
    }
  Grid& grid = lattice.grid;
  grid.nx = high[0] - low[0] + 1, grid.ny = high[1] - low[1] + 1, grid.nz = high[2] - low[2] + 1;
  grid.origin = old.centre(low[0], low[1], low[2]);
  const auto moved = [&](std::size_t s) {
    const auto [i, j, k] = old.ijk(s);
    return grid.index(i - low[0], j - low[1], k - low[2]);
  };
  std::vector<std::uint32_t> word(grid.size(), 0);
  for (std::size_t s = 0; s < old.size(); ++s)
    if (lattice.word[s]) word[moved(s)] = lattice.word[s];
  lattice.word = std::move(word);
  for (Ghost& ghost : lattice.ghosts) ghost.site = moved(ghost.site);
}

}  // namespace geist
