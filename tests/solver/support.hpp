// What the tests of the solver share: a bar of one material, ν = 0, so that bars and columns are
// one-dimensional. By the published method, with small displacements.
#pragma once
#include <string>

#include <fmt/format.h>

#include "case/build.hpp"
#include "case/read.hpp"
#include "core/parallel.hpp"
#include "solver/run.hpp"

namespace geist::testing {

inline constexpr double young = 100, density = 2, length = 4, area = 1;

/// 4 × 1 × 1 along z, standing on z = 0: hexahedra, with `rest` of the case file.
inline std::string column(const std::string& rest, const std::string& formulation = "full") {
  return fmt::format(R"(
method = "published"
units = {{ length = "m", mass = "kg", time = "s" }}
[materials.stuff]
density = {}
young = {}
poisson = 0
[regions.column]
type = "hexahedra"
material = "stuff"
box = [[0, 0, 0], [1, 1, 4]]
divisions = [1, 1, 8]
formulation = "{}"
{})",
                     density, young, formulation, rest);
}

/// The same with particles above z = 2.
inline std::string coupled_column(const std::string& rest) {
  return fmt::format(R"(
method = "published"
units = {{ length = "m", mass = "kg", time = "s" }}
[materials.stuff]
density = {}
young = {}
poisson = 0
[regions.foot]
type = "hexahedra"
material = "stuff"
box = [[0, 0, 0], [1, 1, 2]]
divisions = [2, 2, 4]
[regions.head]
type = "lattice"
material = "stuff"
box = [[0, 0, 2], [1, 1, 4]]
radius = 0.125
{})",
                     density, young, rest);
}

inline constexpr const char* standing = "[[supports]]\nwhere = { z = 0 }\nfix = [\"x\", \"y\", \"z\"]\n";
inline constexpr const char* tip_probe =
    "[probes.tip]\nwhere = { z = 4 }\nquantity = \"displacement\"\ncomponent = \"z\"\n";

inline std::string dynamic(double duration) {
  return fmt::format("[analysis]\ntype = \"dynamic\"\nduration = {}\n", duration);
}
inline std::string quasi_static(double tolerance = 1e-8) {
  return fmt::format("[analysis]\ntype = \"quasi-static\"\ntolerance = {}\n", tolerance);
}

/// The case of that text, on one thread: these bodies are small.
inline Built build_text(const std::string& text) {
  set_threads(1);
  return build(read_case_text(text, "case.toml"));
}

/// A plan for as long as the text says.
inline RunPlan dynamic_plan(double duration) {
  RunPlan plan;
  plan.end_time = duration;
  return plan;
}
inline RunPlan quasi_static_plan(double tolerance = 1e-8) {
  RunPlan plan;
  plan.quasi_static = true, plan.tolerance = tolerance, plan.max_steps = 200'000;
  return plan;
}

}  // namespace geist::testing
