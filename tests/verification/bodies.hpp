// Small coupled bodies with corners in their interfaces, of every formulation but the viscous one, by the
// published method; tests of the consistent one set it.
#pragma once

namespace geist::verification {

/// A lattice in the corner of an L of hexahedra: it meets them at x = 1 and y = 1.
inline constexpr const char* box_in_an_L = R"(
method = "published"
units = { length = "mm", mass = "g", time = "ms" }
[materials.polymer]
density = 0.001
young = 1000
poisson = 0.2
[materials.stiff]
density = 0.002
young = 1500
poisson = 0.3
[regions.foot]
type = "hexahedra"
material = "polymer"
box = [[0, 0, 0], [2, 1, 1]]
divisions = [4, 2, 2]
formulation = "selective-reduced"
[regions.wall]
type = "hexahedra"
material = "stiff"
box = [[0, 1, 0], [1, 2, 1]]
divisions = [2, 2, 2]
formulation = "full"
[regions.corner]
type = "lattice"
material = "polymer"
box = [[1, 1, 0], [2, 2, 1]]
radius = 0.125
[[supports]]
where = { x = 0 }
fix = ["x", "y", "z"]
[[loads]]
where = { x = 2 }
total_force = [0.3, -1, 2]
[[initial]]
velocity = [1, -2, 0.5]
spin = [0.4, 2, -1]
[analysis]
type = "dynamic"
duration = 1
)";

/// An L of particles around a block of distorted hexahedra: every ghost lies in that block.
inline constexpr const char* L_around_a_box = R"(
method = "published"
units = { length = "mm", mass = "g", time = "ms" }
[materials.polymer]
density = 0.001
young = 1000
poisson = 0.15
[regions.block]
type = "hexahedra"
material = "polymer"
corners = [[-0.3, -0.2, 0], [1, 0.1, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0.1, 1, 1]]
divisions = [2, 2, 2]
formulation = "one-point"
[regions.around]
type = "lattice"
material = "polymer"
boxes = [[[1, 0.2, 0], [1.6, 1.6, 1]], [[0.2, 1, 0], [1.6, 1.6, 1]]]
radius = 0.1
rotary_inertia = "cube"
[[supports]]
where = { x = 1.6 }
fix = ["x", "y", "z", "rx", "ry", "rz"]
[[loads]]
where = { z = 1 }
traction = [0.5, 1, -1]
[[initial]]
where = { region = "block" }
velocity = [3, 0, -1]
[analysis]
type = "dynamic"
duration = 1
)";

/// Hexahedra of every formulation in a row that spins, bends and turns far; enough of each to share out.
inline constexpr const char* spinning_row = R"(
units = { length = "mm", mass = "g", time = "ms" }
[materials.m]
density = 0.001
young = 1000
poisson = 0.3
[regions.full]
type = "hexahedra"
material = "m"
corners = [[-1, 0.1, 0], [0, 0, 0], [0, 1, 0], [-1.1, 1, 0], [-1, 0, 1], [0, 0, 1], [0, 1, 1], [-1, 1, 1.2]]
divisions = [8, 6, 6]
formulation = "full"
[regions.selective]
type = "hexahedra"
material = "m"
box = [[0, 0, 0], [1, 1, 1]]
divisions = [8, 6, 6]
formulation = "selective-reduced"
[regions.assumed]
type = "hexahedra"
material = "m"
box = [[1, 0, 0], [2, 1, 1]]
divisions = [8, 6, 6]
formulation = "assumed-strain"
[regions.one]
type = "hexahedra"
material = "m"
box = [[2, 0, 0], [3, 1, 1]]
divisions = [8, 6, 6]
formulation = "one-point"
[regions.viscous]
type = "hexahedra"
material = "m"
box = [[3, 0, 0], [4, 1, 1]]
divisions = [8, 6, 6]
formulation = "one-point"
hourglass = "viscous"
[[initial]]
velocity = [1, -2, 3]
spin = [10, 20, -60]
[[initial]]
where = { x = [3, 4] }
velocity = [0, 0, 60]
[analysis]
type = "dynamic"
kinematics = "finite"
duration = 1
)";

}  // namespace geist::verification
