// A case that uses every key of the key table.
#pragma once

namespace geist {

inline const char* const everything = R"(title = "Everything: \"quotes\", \t tabs and µ"
method = "consistent"
[units]
length = "mm"
mass = "t"
time = "s"

[materials]
steel = { density = 7.8e-9, young = 210000, poisson = 0.3 }
stone = { density = 2.5e-9, young = 5e4, poisson = 0.25 }

[regions.zebra]
type = "hexahedra"
material = "steel"
corners = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, 2], [2, 0, 2], [2.5, 2.5, 2.5], [0, 2, 2]]
divisions = [4, 3, 2]
minus = [{ box = [[0, 0, 0], [1, 1, 1]] }]
formulation = "one-point"
hourglass = "viscous"
hourglass_coefficient = 0.1

[regions.ant]
type = "lattice"
material = "stone"
boxes = [[[5, 0, 0], [6, 1, 1]], [[6, 0, 0], [7, 2, 1]]]
minus = [
  { box = [[5, 0, 0], [5.5, 1, 1]] },
  { cylinder = { from = [5, 0.5, 0], to = [5, 0.5, 2], radius = 0.25 } },
  { ball = { centre = [6, 1, 1], radius = 0.5 } },
]
radius = 0.125
rotary_inertia = "cube"

[regions.mole]
type = "hexahedra"
material = "steel"
box = [[10, 0, 0], [11, 2, 3]]
divisions = [1, 2, 3]

[regions.newt]
type = "hexahedra"
material = "steel"
ball = { centre = [20, 0, 0], radius = 2 }
divisions = [4, 3]
[regions.newt.grading]
x = { towards = "middle", ratio = 2 }
y = { towards = "ends", ratio = 1.5 }
z = { towards = "high", ratio = 3 }
radius = { towards = "low", ratio = 2 }

[regions.worm]
type = "hexahedra"
material = "steel"
cylinder = { from = [30, 0, 0], to = [30, 0, 8], radius = 1 }
divisions = [2, 1, 5]

[coupling]
type = "none"
rotation = "none"

[[contact]]
between = "all"

[[contact]]
between = ["zebra", "ant"]
law = "hertz"
stiffness_factor = 0.5
restitution = 0.9
friction = 0.3

[curves.ramp]
points = [[0, 0], [1e-3, 1], [2e-3, 1.5]]

[[supports]]
where = { x = 0, y = [0, 1], z = [-1, 5], region = "zebra" }
fix = ["z", "rx"]
displacement = { x = 0.1, ry = 0.5 }
velocity = { y = -2.5, rz = 3 }
curve = "ramp"

[[loads]]
where = { x = 2 }
total_force = [0, 0, -1]
curve = "ramp"

[[loads]]
where = { x = 11 }
traction = [1, 2, 3]

[[loads]]
gravity = [0, 0, -9810]

[[initial]]
where = { region = "ant" }
velocity = [1, 2, 3]
spin = [4, 5, 6]
about = [7, 8, 9]

[[initial]]
velocity = [0, 0, 1]

[analysis]
type = "dynamic"
start = "undeformed"
kinematics = "small"
duration = 0.01
max_steps = 1000
safety = 0.8
time_step = 1e-7
subcycling = true
damping = 5
balance_tolerance = 0.1

[probes.z-force]
where = { x = 0 }
quantity = "reaction"
component = "z"

[probes.a_speed]
where = { region = "ant" }
quantity = "velocity"
component = "magnitude"
reduce = "max"
expected = 2.5
expected_from = "closed form"

[probes.push]
where = { region = "ant" }
quantity = "contact-force"
component = "x"

[output]
fields = { every = 1e-3, at = [2e-4, 5e-4] }
history = { every = 1e-4 }
compress = false
precision = "single"
)";

}  // namespace geist
