#include "output/summary.hpp"

#include <fmt/core.h>
#include <zlib.h>

#include <cmath>

#include "de/bonds.hpp"
#include "output/field_list.hpp"
#include "output/file.hpp"
#include "output/history.hpp"

namespace geist::output {
namespace {

using Json = nlohmann::ordered_json;

Json units_json(const RunSummary& summary) {
  const UnitSystem& units = summary.units;
  Json json{{"length", units.length().name},
            {"mass", units.mass().name},
            {"time", units.time().name},
            {"force", units.label(dimension::force)},
            {"stress", units.label(dimension::stress)},
            {"energy", units.label(dimension::energy)}};
  for (const auto& [name, dimension] : history_columns(summary.probes))
    json["history"][name] = units.label(dimension);
  for (const FieldInfo& field : fields())
    if (field.shown) json["fields"][std::string(field.name)] = units.label(field.dimension);
  return json;
}

Json probes_json(const RunSummary& summary) {
  Json json = Json::object();
  for (const ProbeValue& probe : summary.probes) json[probe.name] = probe.value;
  return json;
}

/// Probes that have a value to compare with.
Json expected_json(const RunSummary& summary) {
  Json json = Json::object();
  for (const ProbeValue& probe : summary.probes)
    if (!std::isnan(probe.expected))
      json[probe.name] = {{"value", probe.expected}, {"from", probe.expected_from}};
  return json;
}

Json ledger_json(const Ledger& ledger) {
  Json json;
  for (const LedgerEntry& entry : ledger_entries()) json[std::string(entry.name)] = entry.value(ledger);
  return json;
}

Json counts_json(const Counts& counts) {
  return {{"nodes", counts.nodes},         {"hexahedra", counts.hexahedra},
          {"particles", counts.particles}, {"ghosts", counts.ghosts},
          {"bonds", counts.bonds},         {"degrees_of_freedom", counts.degrees_of_freedom}};
}

Json quasi_static_json(const std::optional<Convergence>& c) {
  if (!c) return nullptr;
  return {{"residual", c->residual}, {"tolerance", c->tolerance}, {"converged", c->converged}};
}

Json equilibrium_json(const std::optional<EquilibriumFound>& found) {
  if (!found) return nullptr;
  Json json{{"iterations", found->iterations}};
  json.update(quasi_static_json(found->convergence));
  return json;
}

Json wall_json(const RunSummary& summary) {
  Json json{{"total", summary.wall_seconds()}, {"phases", Json::object()}};
  for (const Phase& phase : summary.phases) json["phases"][phase.name] = phase.seconds;
  return json;
}

}  // namespace

Counts count(const Model& model) {
  Counts n{.nodes = model.mesh.nodes(), .hexahedra = model.mesh.elements.size()};
  for (const Lattice& lattice : model.lattices) {
    n.particles += lattice.count(site::particle);
    n.ghosts += lattice.count(site::ghost);
    n.bonds += de::bond_count(lattice);
  }
  n.degrees_of_freedom = 3 * n.nodes + 6 * n.particles;
  return n;
}

double RunSummary::wall_seconds() const {
  double total = 0;
  for (const Phase& phase : phases) total += phase.seconds;
  return total;
}

std::map<std::string, std::string> library_versions() {
#ifdef __clang__
  const std::string compiler = "clang ";
#else
  const std::string compiler = "g++ ";
#endif
  return {{"compiler", compiler + __VERSION__},
          {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
          {"nlohmann_json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                        NLOHMANN_JSON_VERSION_PATCH)},
          {"zlib", zlibVersion()}};
}

nlohmann::ordered_json to_json(const RunSummary& s) {
  return {{"title", s.title},
          {"status", s.status},
          {"message", s.message},
          {"warnings", s.warnings},
          {"probes", probes_json(s)},
          {"expected", expected_json(s)},
          {"units", units_json(s)},
          {"ledger", ledger_json(s.ledger)},
          {"quasi_static", quasi_static_json(s.quasi_static)},
          {"static", equilibrium_json(s.equilibrium)},
          {"counts", counts_json(s.counts)},
          {"steps", s.steps},
          {"time", s.time},
          {"time_step",
           {{"value", s.time_step.value},
            {"bound", s.time_step.bound},
            {"limited_by", s.time_step.limited_by},
            {"substeps", s.time_step.substeps},
            {"fine_hexahedra", s.time_step.fine_hexahedra},
            {"fine_particles", s.time_step.fine_particles}}},
          {"wall_seconds", wall_json(s)},
          {"particle_steps_per_second", s.particle_steps_per_second},
          {"element_steps_per_second", s.element_steps_per_second},
          {"threads", s.threads},
          {"state_hash", s.state_hash},
          {"versions", s.versions},
          {"case", s.complete_case}};
}

void write_summary(const std::filesystem::path& path, const RunSummary& summary) {
  // Text that is not UTF-8 is shown as well as can be rather than losing the summary.
  write_whole(path, to_json(summary).dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace geist::output
