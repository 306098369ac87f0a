// Summary: summary.json, what a run was and what came out of it. A number that does not exist is null.
#pragma once
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "output/columns.hpp"
#include "output/units.hpp"

namespace geist::output {

struct Counts {
  std::size_t nodes = 0, hexahedra = 0, particles = 0, ghosts = 0;
  std::size_t bonds = 0;               ///< each once, those to ghosts included
  std::size_t degrees_of_freedom = 0;  ///< 3 for each node, 6 for each particle; ghosts ride on nodes
};
Counts count(const Model& model);

/// Wall time of a part of the run, seconds.
struct Phase {
  std::string name;
  double seconds = 0;
};

struct TimeStep {
  double value = 0, bound = 0;
  std::string limited_by;  ///< region and reason, in words
  int substeps = 1;        ///< short steps in each for what is subcycled
  std::size_t fine_hexahedra = 0, fine_particles = 0;
};

struct Convergence {
  double residual = 0, tolerance = 0;
  bool converged = false;
};

/// Of a static run, or of the equilibrium that a dynamic one starts from.
struct EquilibriumFound {
  long iterations = 0;
  Convergence convergence;
};

struct RunSummary {
  std::string title;
  std::string status;   ///< "completed", "not converged", "interrupted" or "failed"
  std::string message;  ///< a sentence where the status needs one
  std::vector<std::string> warnings;
  UnitSystem units{"m", "kg", "s"};
  std::vector<ProbeValue> probes;
  Ledger ledger;
  Counts counts;
  TimeStep time_step;
  long steps = 0;
  double time = 0;  ///< reached, in the case's unit
  std::optional<Convergence> quasi_static;
  std::optional<EquilibriumFound> equilibrium;
  std::vector<Phase> phases;
  double particle_steps_per_second = 0, element_steps_per_second = 0;
  int threads = 1;
  std::string state_hash;  ///< of the final state's bits, the same for any number of threads
  std::map<std::string, std::string> versions;
  nlohmann::ordered_json complete_case;  ///< as run, defaults filled in

  double wall_seconds() const;
};

/// Versions of what this part of the program was built with: compiler and libraries.
std::map<std::string, std::string> library_versions();

nlohmann::ordered_json to_json(const RunSummary& summary);

/// Write the summary, whole or not at all. Throws std::runtime_error naming the file and the reason.
void write_summary(const std::filesystem::path& path, const RunSummary& summary);

}  // namespace geist::output
