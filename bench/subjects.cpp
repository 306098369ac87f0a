#include "subjects.hpp"

#include <fmt/format.h>

#include "case/read.hpp"
#include "clock.hpp"
#include "de/bonds.hpp"
#include "fe/elements.hpp"
#include "solver/nodes.hpp"

namespace geist::bench {
namespace {

/// What may follow a name: contact is watched for, rotations are finite, the method is consistent.
bool has(const std::string& name, const char* word) { return name.find(word) != std::string::npos; }
bool is_watched(const std::string& name) { return has(name, "+contact"); }
bool turns(const std::string& name) { return has(name, "+finite"); }
bool is_consistent(const std::string& name) { return has(name, "+consistent"); }
std::string material_of(const std::string& name) { return name.substr(0, name.find('+')); }

/// A small block beside the cube, too far to be touched, and contact between all.
std::string watched_text(int edge) {
  return fmt::format(R"([regions.block]
type = "hexahedra"
material = "polymer"
box = [[0, 0, {0}], [4, 4, {1}]]
divisions = [4, 4, 4]
formulation = "one-point"
[[contact]]
between = "all"
)",
                     edge + 4, edge + 8);
}

/// The case: particles of diameter 1, or elements of edge 1. The spin makes everything move from the first
/// step on, so that no number is zero or denormal.
std::string case_text(const std::string& full_name, int edge) {
  const std::string name = material_of(full_name);
  const std::string region = name == "lattice" ? std::string("type = \"lattice\"\nradius = 0.5\n")
                                               : fmt::format(
                                                     "type = \"hexahedra\"\ndivisions = [{0}, {0}, {0}]\n"
                                                     "formulation = \"{1}\"\n",
                                                     edge, name);
  return fmt::format(R"(title = "benchmark"
method = "{4}"
units = {{ length = "mm", mass = "g", time = "ms" }}
[materials.polymer]
density = 0.001
young = 1000
poisson = 0.2
[regions.body]
material = "polymer"
box = [[0, 0, 0], [{0}, {0}, {0}]]
{1}
[[supports]]
where = {{ x = 0 }}
fix = ["x", "y", "z"]
[[loads]]
where = {{ x = {0} }}
total_force = [{2}, 0, 0]
[[initial]]
spin = [0.01, 0.02, 0.03]
[analysis]
type = "dynamic"
kinematics = "{3}"
duration = 1e6
)",
                     edge, region, edge * edge, turns(full_name) ? "finite" : "small",
                     is_consistent(full_name) ? "consistent" : "published") +
         (is_watched(full_name) ? watched_text(edge) : std::string());
}

void add_lattice_kernels(Subject& s) {
  Lattice& lattice = s.simulation().model.lattices.front();
  const LatticeKind kind{is_consistent(s.name), turns(s.name)};
  s.items = static_cast<double>(lattice.count(site::particle));
  s.working_set = lattice.grid.size() * ((kind.finite ? 18 : 12) * sizeof(double) + sizeof(std::uint32_t));
  const Kernel sweep{"drift, bond forces and kick", [&] { de::advance(lattice, de::Kick{}, 0); },
                     drift_bonds_and_kick(kind)};
  const Kernel forces{"bond forces and kick", [&] { de::bond_forces_and_kick(lattice, de::Kick{}); },
                      bonds_and_kick(kind)};
  const Kernel drift{"drift", [&] { de::drift(lattice, 0); }, lattice_drift(kind)};
  s.kernels = {sweep, forces, drift};
  s.step = sweep.work;
}

void add_element_kernels(Subject& s) {
  Mesh& mesh = s.simulation().model.mesh;
  s.items = static_cast<double>(mesh.elements.size());
  s.working_set = mesh.blocks.size() * (sizeof(HexBlock) + sizeof(mesh.elements[0])) +
                  mesh.nodes() * (13 * sizeof(double) + 1);
  s.kernels = {{"internal forces", [&] { fe::internal_forces(mesh); },
                internal_forces(material_of(s.name), turns(s.name))},
               {"kick", [&] { kick_nodes(mesh, de::Kick{}); }, node_kick()},
               {"drift", [&] { drift(mesh, 0); }, node_drift()}};
  for (const Kernel& k : s.kernels) s.step = s.step + k.work;
}

}  // namespace

std::string Subject::size() const { return fmt::format("{0}x{0}x{0}", edge); }

std::unique_ptr<Subject> make_subject(const std::string& name, int edge) {
  auto subject = std::make_unique<Subject>();
  subject->name = name, subject->edge = edge;
  const double begin = now();
  subject->built = build(read_case_text(case_text(name, edge), "benchmark"));
  subject->build_seconds = now() - begin;
  if (material_of(name) == "lattice")
    add_lattice_kernels(*subject);
  else
    add_element_kernels(*subject);
  subject->simulation().start();
  for (int i = 0; i < 5; ++i) subject->simulation().step(false);
  return subject;
}

}  // namespace geist::bench
