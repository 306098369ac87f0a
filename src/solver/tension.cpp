#include "solver/tension.hpp"

#include <stdexcept>

#include "de/assembly.hpp"
#include "geometry/packing.hpp"
#include "solver/equilibrium.hpp"

namespace geist {
namespace {

constexpr int length = 12, width = 4;  ///< particles

Lattice bar_of(const Lattice& like) {
  Lattice bar;
  bar.material = like.material, bar.mass = like.mass, bar.inertia = like.inertia;
  const double pitch = like.grid.pitch;
  pack(bar, {{{0, 0, 0}, {length * pitch, width * pitch, width * pitch}}}, {}, pitch / 2);
  trim(bar);
  connect(bar);
  if (like.consistent()) de::assemble(bar);
  finish(bar);
  return bar;
}

/// Unit force on either end, spread evenly.
Load pull(const Lattice& bar) {
  Load load;
  for (int k = 0; k < width; ++k)
    for (int j = 0; j < width; ++j)
      for (const int i : {0, length - 1})
        load.particles.push_back(
            {0, bar.grid.index(i, j, k), -1, {(i ? 1.0 : -1.0) / (width * width), 0, 0}});
  return load;
}

/// As much as keeps it in place: three components at one corner, two and one at others.
Supports hold(const Grid& grid) {
  Supports supports;
  supports.motions.push_back({});
  const auto fix = [&](std::size_t s, std::int32_t c) { supports.held.push_back({0, s, -1, c, 0}); };
  const std::size_t a = grid.index(0, 0, 0), b = grid.index(length - 1, 0, 0),
                    c = grid.index(0, width - 1, 0);
  fix(a, 0), fix(a, 1), fix(a, 2), fix(b, 1), fix(b, 2), fix(c, 2);
  return supports;
}

Tension measure(const Lattice& bar) {
  const int first = length / 3, last = length - 1 - first;
  const auto mean = [&](int component, bool at_end, auto place) {
    double sum = 0;
    int n = 0;
    for (int i = first; i <= last; ++i)
      for (int j = 0; j < width; ++j)
        for (int k = 0; k < width; ++k)
          if (place(i, j) == (at_end ? 1 : -1)) sum += bar.motion[component][bar.grid.index(i, j, k)], ++n;
    return sum / n;
  };
  const auto along = [&](int i, int) { return i == last ? 1 : i == first ? -1 : 0; };
  const auto across = [&](int, int j) { return j == width - 1 ? 1 : j == 0 ? -1 : 0; };
  const double pitch = bar.grid.pitch, area = width * width * pitch * pitch;
  const double stretch = (mean(0, true, along) - mean(0, false, along)) / ((last - first) * pitch);
  const double shrink = (mean(1, true, across) - mean(1, false, across)) / ((width - 1) * pitch);
  return {1 / (area * stretch), -shrink / stretch};
}

}  // namespace

std::optional<Tension> tension_test(const Lattice& like) {
  Simulation sim;
  try {
    sim.model.lattices.push_back(bar_of(like));
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
  sim.loads.push_back(pull(sim.model.lattices[0]));
  sim.supports = hold(sim.model.lattices[0].grid);
  list_acted_on(sim);
  if (find_equilibrium(sim, {}).end != Equilibrium::End::found) return std::nullopt;
  return measure(sim.model.lattices[0]);
}

}  // namespace geist
