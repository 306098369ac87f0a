#include "session/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "de/bonds.hpp"
#include "fe/elements.hpp"
#include "geometry/bounds.hpp"
#include "output/console.hpp"
#include "session/waves.hpp"
#include "solver/tension.hpp"

namespace geist {
namespace {

using output::with_commas;

std::string hex_region(const HexRegion& region, double mass, const output::UnitSystem& units) {
  return fmt::format("  {:<12} {} hexahedra, {}; mass {:.6g} {}\n", region.name,
                     with_commas(static_cast<long long>(region.count)), region.formulation, mass,
                     units.mass().name);
}

/// What the lattice's bonds make of its material: without end, and in a bar.
std::string recovered(const Lattice& lattice, const output::UnitSystem& units) {
  const std::string stress = units.label(output::dimension::stress);
  const de::Recovered endless = de::recovered_constants(lattice);
  const auto bar = tension_test(lattice);
  return fmt::format(
      "  {:<12} E = {:.6g} {}, nu = {:.6g}; endless lattice: {:.6g}, {:.6g}{}\n", "", lattice.material.young,
      stress, lattice.material.poisson, endless.young, endless.poisson,
      bar ? fmt::format("; a bar of 12 x 4 x 4 particles, pulled: {:.6g}, {:.4g}", bar->young, bar->poisson)
          : "");
}

std::string lattice_region(const Lattice& lattice, const output::UnitSystem& units) {
  const std::size_t particles = lattice.count(site::particle);
  return fmt::format("  {:<12} {} particles of radius {:.6g} {}, {} bonds, {} ghosts; mass {:.6g} {}\n",
                     lattice.name, with_commas(static_cast<long long>(particles)), lattice.radius(),
                     units.length().name, with_commas(static_cast<long long>(de::bond_count(lattice))),
                     with_commas(static_cast<long long>(lattice.ghosts.size())),
                     lattice.mass * static_cast<double>(particles), units.mass().name) +
         recovered(lattice, units);
}

std::string regions(const Built& built, const output::UnitSystem& units) {
  const Model& model = built.simulation.model;
  std::string text = "Regions\n";
  const std::vector<double> masses = fe::region_masses(model.mesh);
  for (std::size_t r = 0; r < masses.size(); ++r) text += hex_region(model.mesh.regions[r], masses[r], units);
  for (const Lattice& lattice : model.lattices) text += lattice_region(lattice, units);
  const output::Counts n = output::count(model);
  text += fmt::format("  in all       {} nodes, {} degrees of freedom, {}\n",
                      with_commas(static_cast<long long>(n.nodes)),
                      with_commas(static_cast<long long>(n.degrees_of_freedom)),
                      output::human_bytes(memory_of(built.simulation)));
  return text;
}

std::string contact_pair(const contact::Contacts& contacts, std::int32_t number, const Model& model,
                         const output::UnitSystem& units) {
  const contact::Law& law = contacts.laws().law(number);
  const auto [a, b] = contacts.laws().regions_of(number);
  const contact::NormalStiffness stiffness = contacts.stiffness(number);
  const bool particles = b >= static_cast<std::int32_t>(model.mesh.regions.size());
  std::string text = fmt::format("  {:<12} {}", region_name(model, a) + " - " + region_name(model, b),
                                 stiffness.hertz ? "hertz" : "penalty");
  if (law.restitution < 1) text += fmt::format(", restitution {:.6g}", law.restitution);
  text += law.friction > 0 ? fmt::format(", friction {:.6g}", law.friction) : ", no friction";
  return text + fmt::format("; {:.4g} {}/{}{}\n", stiffness.k, units.label(output::dimension::force),
                            units.length().name,
                            stiffness.hertz ? "^1.5 for a particle"
                            : particles     ? " for a particle"
                                            : "^3 (force per area and overlap)");
}

std::string contacts(const Simulation& sim, const output::UnitSystem& units) {
  constexpr std::int32_t most = 20;
  const std::int32_t laws = sim.contacts.laws().count();
  std::string text = "Contact\n";
  for (std::int32_t number = 0; number < std::min(most, laws); ++number)
    text += contact_pair(sim.contacts, number, sim.model, units);
  if (laws > most) text += fmt::format("  and {} more pairs\n", laws - most);
  return text + fmt::format("  in all       {} nodes and particles that may touch, {} facets\n",
                            with_commas(static_cast<long long>(sim.contacts.contactors())),
                            with_commas(static_cast<long long>(sim.contacts.facets())));
}

/// What subcycling does.
std::string short_steps(const Built& built, const output::UnitSystem& units) {
  const Simulation& sim = built.simulation;
  if (sim.subcycling.empty()) return "";
  return fmt::format(
      "  {:<12} {} short steps of {:.6g} {} for {}{} of {} hexahedra; expected to be {:.2f} times as fast\n",
      "subcycling", sim.subcycling.ratio(), sim.dt / sim.subcycling.ratio(), units.time().name,
      sim.subcycling.lattices() ? "all particles and " : "",
      with_commas(static_cast<long long>(fine_hexahedra(sim))),
      with_commas(static_cast<long long>(sim.model.mesh.elements.size())), built.expected_gain);
}

std::string time_step(const Case& input, const Built& built, const output::UnitSystem& units) {
  const TimeStepBound& least = critical(built.bounds);
  std::string text = "Time step\n";
  for (const TimeStepBound& b : built.bounds)
    text += std::isinf(b.bound)
                ? fmt::format("  {:<12} held everywhere\n", b.region)
                : fmt::format("  {:<12} stable up to {:.6g} {} ({}){}\n", b.region, b.bound,
                              units.time().name, b.limit, b.region == least.region ? "  <- limits" : "");
  text +=
      fmt::format("  {:<12} {:.6g} {}{}\n", "used", built.simulation.dt, units.time().name,
                  input.analysis.time_step ? " (as given)"
                                           : fmt::format(" (safety factor {:.3g})", input.analysis.safety));
  return text + short_steps(built, units);
}

/// Steps of dynamic relaxation if the body bends like a cantilever of the box around it: its lowest frequency
/// is ω = 3.516 √(E/12ρ) h/L², and the residual falls by e in 1/ω.
double relaxation_steps(const Case& input, const Built& built) {
  double c = std::numeric_limits<double>::infinity();
  for (const RegionSpec& region : input.regions) {
    const Material& m = input.materials.at(region.material);
    c = std::min(c, std::sqrt(m.young / m.density));
  }
  const Box box = bounds(built.simulation.model);
  const Vec3 edge = box.high - box.low;
  const auto [h, L] = std::minmax({edge.x, edge.y, edge.z});
  const double omega = 3.516 / std::sqrt(12.0) * c * h / (L * L);
  return std::log(1 / input.analysis.tolerance) / (omega * built.simulation.dt);
}

std::string analysis(const Case& input, const Built& built, const output::UnitSystem& units) {
  const AnalysisSpec& a = input.analysis;
  const auto count = [](double steps) { return with_commas(static_cast<long long>(std::ceil(steps))); };
  const double dt = built.simulation.dt;
  if (a.type == "static")
    return fmt::format("Analysis\n  static, until the residual is below {:.3g} of the load\n", a.tolerance);
  if (a.type == "dynamic")
    return fmt::format("Analysis\n  dynamic      {}{} steps to {:.6g} {}\n",
                       a.start == "static" ? "from equilibrium, " : "", count(a.duration / dt), a.duration,
                       units.time().name);
  const double most = a.duration > 0 ? a.duration / dt : static_cast<double>(a.max_steps);
  return fmt::format(
      "Analysis\n  quasi-static by adaptive dynamic relaxation until the residual is below {:.3g} of the "
      "load\n"
      "               roughly {:.2g} steps if it bends like a cantilever of its size, at most {}\n",
      a.tolerance, relaxation_steps(input, built), count(most));
}

}  // namespace

output::UnitSystem units_of(const Case& input) {
  return {input.units.length, input.units.mass, input.units.time};
}

std::string describe(const Case& input, const Built& built) {
  const output::UnitSystem units = units_of(input);
  std::string text = fmt::format("{}\n", input.title);
  text += fmt::format("Units\n  {}, {}, {}; hence {}, {}, {}\n", input.units.length, input.units.mass,
                      input.units.time, units.label(output::dimension::force),
                      units.label(output::dimension::stress), units.label(output::dimension::energy));
  text += regions(built, units);
  const Model& model = built.simulation.model;
  const bool coupled =
      input.coupling == "ghost-particles" && !model.lattices.empty() && !model.mesh.elements.empty();
  text += fmt::format("Method\n  {}, {} displacements{}\n", input.method, input.analysis.kinematics,
                      coupled ? fmt::format("; ghost particles, rotation {}", input.rotation) : "");
  if (!input.contact.empty()) text += contacts(built.simulation, units);
  if (input.analysis.type != "static") text += describe_waves(input, model);
  return text + time_step(input, built, units) + analysis(input, built, units);
}

std::size_t fine_hexahedra(const Simulation& sim) {
  std::size_t n = 0;
  for (const std::int32_t b : sim.subcycling.fine().blocks) n += sim.model.mesh.blocks[b].count;
  return n;
}

double memory_of(const Simulation& sim) {
  const Mesh& mesh = sim.model.mesh;
  double bytes = static_cast<double>(mesh.nodes()) * (3 * 8 * 6 + 8 + 1);
  bytes += static_cast<double>(mesh.elements.size()) * (8 * 4) +
           static_cast<double>(mesh.blocks.size()) * (sizeof(HexBlock) + 4);
  const int short_steps = sim.subcycling.lattices() ? 1 : 0;
  for (const Lattice& l : sim.model.lattices)
    bytes += static_cast<double>(l.grid.size()) * (18 * 8 * (1 + short_steps) + 4) +
             static_cast<double>(l.rotation.size()) * 9 * 8 * (1 + short_steps) +
             static_cast<double>(l.class_of.size()) * 4 +
             static_cast<double>(l.pressure.size()) * (4 * 8 + 1) +
             static_cast<double>(l.listed.size()) * (6 * 8 * (1 + 2 * short_steps) + 9) +
             static_cast<double>(l.ghosts.size()) * (sizeof(Ghost) + 8 * sizeof(GhostNode));
  return bytes;
}

int worthwhile_threads(const Model& model) {
  constexpr double particle = 20e-9, hexahedron = 40e-9,
                   share = 80e-6;  // seconds; of a step for each thread
  double step = hexahedron * static_cast<double>(model.mesh.elements.size());
  for (const Lattice& l : model.lattices) step += particle * static_cast<double>(l.grid.size());
  const int processors = static_cast<int>(allowed_processors().size());
  return std::clamp(static_cast<int>(step / share), 1, processors);
}

}  // namespace geist
