// The good case, and the table's parts put together.
#include "case/malformed.hpp"

#include <stdexcept>

namespace geist {

const char* const good_case = R"(title = "A block"
units = { length = "mm", mass = "g", time = "ms" }

[materials.polymer]
density = 0.001
young = 1000
poisson = 0.2

[regions.left]
type = "hexahedra"
material = "polymer"
box = [[0, 0, 0], [2, 2, 2]]
divisions = [4, 4, 4]

[regions.middle]
type = "lattice"
material = "polymer"
box = [[2, 0, 0], [4, 2, 2]]
radius = 0.25

[curves.ramp]
points = [[0, 0], [1, 1]]

[[supports]]
where = { x = 0 }
fix = ["x", "y", "z"]

[[loads]]
where = { x = 4 }
total_force = [0, 0, -1]
curve = "ramp"

[analysis]
type = "quasi-static"
tolerance = 1e-6

[probes.tip]
where = { x = 4 }
quantity = "displacement"
component = "z"

[output]
history = { every = 0.1 }
)";

std::vector<Malformed> malformed_cases() {
  std::vector<Malformed> all;
  for (const auto& part : {malformed_syntax(), malformed_keys(), malformed_values(), malformed_contacts(),
                           malformed_rules(), malformed_sets()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::string malformed_text(const Malformed& malformed) {
  const std::string replace = malformed.replace;
  if (replace.empty()) return malformed.by;
  std::string text = good_case;
  if (replace == "--set") return text;
  const std::size_t at = text.find(replace);
  if (at == std::string::npos) throw std::logic_error("the good case has no " + replace);
  return text.replace(at, replace.size(), malformed.by);
}

std::vector<std::string> malformed_options(const Malformed& malformed) {
  if (std::string(malformed.replace) != "--set") return {};
  return {malformed.by};
}

}  // namespace geist
