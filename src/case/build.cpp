#include "case/build.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <stdexcept>

#include "case/boundary.hpp"
#include "case/contact_laws.hpp"
#include "case/diagnostic.hpp"
#include "coupling/cut.hpp"
#include "coupling/interfaces.hpp"
#include "de/assembly.hpp"
#include "fe/elements.hpp"
#include "geometry/block.hpp"
#include "geometry/bounds.hpp"
#include "geometry/packing.hpp"
#include "geometry/separate.hpp"
#include "solver/fine_part.hpp"

namespace geist {
namespace {

void add_region(Mesh& mesh, const Case& input, const RegionSpec& spec, const HexahedraSpec& hexahedra) {
  HexRegion region;
  region.name = spec.name;
  region.material = input.materials.at(spec.material);
  const bool viscous = hexahedra.formulation == "one-point" && hexahedra.hourglass == "viscous";
  if (viscous && (input.analysis.type != "dynamic" || input.analysis.start == "static"))
    throw std::invalid_argument(fmt::format(
        "viscous hourglass control resists motion only, so a {} never comes to rest; use hourglass = "
        "\"stiffness\"",
        input.analysis.type == "dynamic" ? "static start" : input.analysis.type + " analysis"));
  region.formulation = viscous ? "one-point-viscous" : hexahedra.formulation;
  region.hourglass_coefficient = hexahedra.hourglass_coefficient;
  append(mesh, region, mesh_of(hexahedra.body, hexahedra.gradings), hexahedra.minus);
}

/// A lattice with its particles, on a grid that has room for ghosts.
Lattice make_lattice(const Case& input, const RegionSpec& spec, const LatticeSpec& packing) {
  Lattice lattice;
  lattice.name = spec.name;
  lattice.material = input.materials.at(spec.material);
  pack(lattice, packing.boxes, packing.minus, packing.radius);
  if (lattice.count(site::particle) == 0) throw std::invalid_argument("no particle is left");
  const double pitch = 2 * packing.radius;
  lattice.mass = lattice.material.density * pitch * pitch * pitch;  // of the cell, not of the sphere
  const double cube = lattice.mass * pitch * pitch / 6,
               sphere = 0.4 * lattice.mass * packing.radius * packing.radius;
  lattice.inertia = packing.rotary_inertia == "cube" ? cube : sphere;
  return lattice;
}

/// Call make() and turn what is invalid about the geometry into an error at the region's place in the file.
template <class F>
void at_region(const Case& input, const RegionSpec& spec, F make) {
  try {
    make();
  } catch (const std::invalid_argument& e) {
    throw error_at(input, spec.source, fmt::format("region '{}': {}", spec.name, e.what()));
  }
}

/// Elements, or sites of the box around a lattice.
double places(const RegionSpec& spec) {
  if (const auto* hexahedra = std::get_if<HexahedraSpec>(&spec.shape)) return element_count(hexahedra->body);
  const auto& lattice = std::get<LatticeSpec>(spec.shape);
  const Box box = bounds(lattice.boxes);
  const Vec3 edge = box.high - box.low, n = edge * (1 / (2 * lattice.radius));
  return n.x * n.y * n.z;
}

/// The system grants more memory than there is and ends who uses it; so look first.
void check_memory(const Case& input) {
  constexpr double gibi = 1024.0 * 1024 * 1024;
  const bool solves = input.analysis.type == "static" || input.analysis.start == "static";
  const double rotation = input.analysis.kinematics == "finite" ? 72 : 0;
  const bool mixed = std::any_of(input.regions.begin(), input.regions.end(), [](const RegionSpec& spec) {
    return std::holds_alternative<HexahedraSpec>(spec.shape);
  });
  const double short_steps = mixed && input.analysis.subcycling ? 18 * 8 + rotation : 0;
  const double element = solves ? 1300 : 1000,
               particle = (solves ? 550 : 250) + rotation + short_steps;  // bytes at most, measured
  const double there =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  double needed = 0;
  for (const RegionSpec& spec : input.regions) {
    const bool hexahedra = std::holds_alternative<HexahedraSpec>(spec.shape);
    needed += places(spec) * (hexahedra ? element : particle);
    if (needed > there)
      throw error_at(
          input, spec.source,
          fmt::format("region '{}' has {:.3g} {}: the case needs about {:.3g} GiB of memory, and this "
                      "machine has {:.3g}",
                      spec.name, places(spec), hexahedra ? "hexahedra" : "sites", needed / gibi,
                      there / gibi));
  }
}

/// Blocks of a pair that is named in [[contact]] share no nodes.
void separate_contacts(Mesh& mesh, const Case& input) {
  const coupling::LoosePairs named = named_pairs(input);
  for (std::size_t a = 0; a < mesh.regions.size(); ++a)
    for (std::size_t b = a + 1; b < mesh.regions.size(); ++b)
      if (named.contains(mesh.regions[a].name, mesh.regions[b].name))
        separate(mesh, mesh.regions[a], mesh.regions[b]);
}

void make_regions(Model& model, const Case& input) {
  for (const RegionSpec& spec : input.regions)
    at_region(input, spec, [&] {
      if (const auto* hexahedra = std::get_if<HexahedraSpec>(&spec.shape))
        add_region(model.mesh, input, spec, *hexahedra);
      else
        model.lattices.push_back(make_lattice(input, spec, std::get<LatticeSpec>(spec.shape)));
    });
  separate_contacts(model.mesh, input);
  finish(model.mesh);
}

const RegionSpec& spec_of(const Case& input, const std::string& name) {
  for (const RegionSpec& spec : input.regions)
    if (spec.name == name) return spec;
  throw std::logic_error("no region " + name);
}

/// Named pairs, but for lattices that lie flush on their hexahedra and so are bonded to them.
coupling::LoosePairs loose_pairs(const Model& model, const Case& input, const Locator& locator) {
  const coupling::LoosePairs named = named_pairs(input);
  coupling::LoosePairs loose;
  for (const RegionSpec& a : input.regions)
    for (const RegionSpec& b : input.regions)
      if (a.shape.index() == b.shape.index() && named.contains(a.name, b.name)) loose.add(a.name, b.name);
  for (const Lattice& lattice : model.lattices)
    for (const HexRegion& region : model.mesh.regions)
      if (named.contains(lattice.name, region.name) && !coupling::flush(lattice, region, locator))
        loose.add(lattice.name, region.name);
  return loose;
}

GhostRotation ghost_rotation(const std::string& word) {
  if (word == "continuum") return GhostRotation::continuum;
  return word == "none" ? GhostRotation::none : GhostRotation::own;
}

void assemble(Lattice& lattice) {
  de::assemble(lattice);
  if (lattice.dilates() && lattice.kinematics == Kinematics::finite)
    throw std::invalid_argument(fmt::format(
        "poisson = {} gives cells an energy of dilatation, which does not know finite rotations yet; set "
        "kinematics = \"small\" in [analysis], or poisson to at most 0.25",
        lattice.material.poisson));
}

/// Ghosts, bonds, state and lists of all lattices.
void couple(Model& model, const Case& input) {
  const Locator locator(model.mesh);
  const bool coupled = input.coupling == "ghost-particles";
  const coupling::LoosePairs loose = loose_pairs(model, input, locator);
  for (Lattice& lattice : model.lattices) {
    if (!coupled) continue;
    std::vector<bool> without_ghosts;
    for (const HexRegion& region : model.mesh.regions)
      without_ghosts.push_back(loose.contains(lattice.name, region.name));
    const bool cells = input.method == "consistent";
    lattice.ghost_rotation = ghost_rotation(input.rotation);
    coupling::place_ghosts(lattice, model.mesh, locator, without_ghosts,
                           cells ? coupling::Reach::cells : coupling::Reach::bonds);
  }
  if (const auto clash = coupling::find_clash(model, locator, coupled, loose))
    throw error_at(input, spec_of(input, clash->first).source, clash->message);
  for (Lattice& lattice : model.lattices) {
    trim(lattice);
    connect(lattice);
    if (input.method == "consistent")
      at_region(input, spec_of(input, lattice.name), [&] { assemble(lattice); });
    finish(lattice);
  }
  if (input.method == "consistent" && coupled)
    fe::set_cuts(model.mesh, coupling::cut_hexahedra(model, locator));
  fe::lump_masses(model.mesh);
}

void set_kinematics(Model& model, const Case& input) {
  const Kinematics kinematics =
      input.analysis.kinematics == "finite" ? Kinematics::finite : Kinematics::small;
  model.mesh.kinematics = kinematics;
  for (Lattice& lattice : model.lattices) lattice.kinematics = kinematics;
}

/// Ghosts that do not spin by themselves: their rotation is not for the kick.
void hold_ghost_spins(Model& model) {
  for (Lattice& lattice : model.lattices)
    if (lattice.ghost_rotation != GhostRotation::own)
      for (const std::int32_t slot : lattice.ghost_slot) lattice.listed_held[slot] = 0b111111;
}

double choose_time_step(const Case& input, const std::vector<TimeStepBound>& bounds) {
  const TimeStepBound& least = critical(bounds);
  if (!input.analysis.time_step) return rounded_down(input.analysis.safety * least.bound);
  if (*input.analysis.time_step > least.bound)
    throw error_at(input, input.analysis.source,
                   fmt::format("time_step = {:.6g} is more than the safe bound {:.6g} of region '{}' ({})",
                               *input.analysis.time_step, least.bound, least.region, least.limit));
  return *input.analysis.time_step;
}

void subcycle(Built& built, const TimeStepLimits& limits, double safety) {
  Simulation& sim = built.simulation;
  const Division division = best_division(sim.model, limits, safety);
  if (division.fine.empty()) return;
  sim.dt = division.dt;
  sim.subcycling = Subcycling(sim.model, division.fine);
  built.expected_gain = division.gain;
}

}  // namespace

Built build(const Case& input) {
  Built built;
  Simulation& sim = built.simulation;
  check_memory(input);
  make_regions(sim.model, input);
  set_kinematics(sim.model, input);
  couple(sim.model, input);
  const Selector selector(sim.model);
  sim.supports = make_supports(input, selector);
  sim.loads = make_loads(input, selector);
  list_acted_on(sim);
  hold_ghost_spins(sim.model);
  set_initial_motion(sim.model, input, selector);
  built.probes = make_probes(input, selector, sim);
  sim.reactions = coupling::Reactions(sim.model);
  sim.contacts = contact::Contacts(sim.model, make_contact_laws(sim.model, input));
  const TimeStepLimits limits = time_step_limits(sim.model, sim.contacts);
  built.bounds = limits.bounds;
  sim.dt = choose_time_step(input, built.bounds);
  if (input.analysis.subcycling && !input.analysis.time_step) subcycle(built, limits, input.analysis.safety);
  sim.alpha = input.analysis.damping;
  return built;
}

RunPlan plan_of(const Case& input) {
  RunPlan plan;
  plan.quasi_static = input.analysis.type == "quasi-static";
  plan.is_static = input.analysis.type == "static";
  plan.static_start = input.analysis.start == "static";
  plan.max_iterations = input.analysis.max_iterations;
  plan.tolerance = input.analysis.tolerance;
  plan.end_time = input.analysis.duration;
  plan.max_steps = input.analysis.max_steps;
  plan.history_every = input.output.history_every.value_or(0);
  plan.fields_every = input.output.fields_every.value_or(0), plan.fields_at = input.output.fields_at;
  plan.balance_tolerance = input.analysis.balance_tolerance;
  return plan;
}

}  // namespace geist
