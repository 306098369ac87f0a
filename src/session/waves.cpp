#include "session/waves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "coupling/reflection.hpp"
#include "geometry/shapes.hpp"
#include "session/describe.hpp"

namespace geist {
namespace {

/// Longest edge of a region's elements.
double longest_edge(const Mesh& mesh, const HexRegion& region) {
  constexpr std::array<std::array<int, 2>, 12> edges{
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  double longest = 0;
  for (std::size_t e = region.first; e < region.first + region.count; ++e)
    for (const auto& [a, b] : edges)
      longest = std::max(longest, norm(mesh.points[mesh.elements[e][b]] - mesh.points[mesh.elements[e][a]]));
  return longest;
}

/// Largest extent, along an axis towards a particle, of the hexahedra of a region that a lattice's ghosts
/// ride on; 0 if none does.
double depth_at_interface(const Mesh& mesh, const Lattice& lattice, std::int32_t region) {
  double deepest = 0;
  for (const Ghost& ghost : lattice.ghosts) {
    if (region_of(mesh, ghost.element) != region) continue;
    Box box = nowhere();
    for (const std::int32_t node : mesh.elements[ghost.element]) widen(box, mesh.points[node]);
    for (int d = 0; d < 18; ++d) {
      const auto step = directions[d];
      if (std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]) != 1 ||
          !(lattice.word[ghost.site] >> d & 1) ||
          !lattice.is(ghost.site + lattice.grid.offset(d), site::particle))
        continue;
      for (int c = 0; c < 3; ++c)
        if (step[c] != 0) deepest = std::max(deepest, box.high[c] - box.low[c]);
    }
  }
  return deepest;
}

}  // namespace

std::string describe_waves(const Case& input, const Model& model) {
  const output::UnitSystem units = units_of(input);
  std::string text = "Waves (at normal incidence)\n";
  const auto carries = [&](const std::string& name, double spacing) {
    text += fmt::format("  {:<12} carried within 1 % of their speed down to {:.4g} {}\n", name,
                        coupling::finest_wavelength(spacing), units.length().name);
  };
  for (const HexRegion& region : model.mesh.regions) carries(region.name, longest_edge(model.mesh, region));
  for (const Lattice& lattice : model.lattices) carries(lattice.name, lattice.grid.pitch);
  for (const Lattice& lattice : model.lattices)
    for (std::size_t r = 0; r < model.mesh.regions.size(); ++r) {
      const double h = depth_at_interface(model.mesh, lattice, static_cast<std::int32_t>(r));
      if (h <= lattice.radius()) continue;
      const auto share = [&](double waves_of) {
        return 100 * coupling::reflected({model.mesh.regions[r].material, h},
                                         {lattice.material, lattice.grid.pitch}, waves_of * h,
                                         input.method == "consistent");
      };
      text += fmt::format(
          "  {:<12} reflected: {:.2g} % of 10 elements' length ({:.4g} {}), {:.2g} % of 20, {:.2g} % of 40\n",
          model.mesh.regions[r].name + " - " + lattice.name, share(10), 10 * h, units.length().name,
          share(20), share(40));
    }
  return text;
}

}  // namespace geist
