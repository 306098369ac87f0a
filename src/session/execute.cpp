#include "session/execute.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "case/build.hpp"
#include "core/parallel.hpp"
#include "model/hash.hpp"
#include "output/console.hpp"
#include "output/fields.hpp"
#include "output/file.hpp"
#include "output/history.hpp"
#include "output/progress.hpp"
#include "output/summary.hpp"
#include "session/describe.hpp"
#include "solver/run.hpp"

namespace geist {
namespace {

namespace fs = std::filesystem;

/// Make the directory ready: refuse results that are there, or remove them if `force`.
void prepare_directory(const fs::path& directory, bool force) {
  if (output::holds_results(directory)) {
    if (!force)
      throw std::runtime_error(
          fmt::format("{} holds results already; give --force to overwrite them, or --out for "
                      "another place",
                      directory.string()));
    output::remove_results(directory);
  }
  output::make_directory(directory);
}

output::Dimension dimension_of(const Probe& probe) {
  switch (probe.quantity) {
    case Probe::Quantity::displacement:
      return output::dimension::length;
    case Probe::Quantity::velocity:
      return output::dimension::velocity;
    case Probe::Quantity::rotation:
      return output::dimension::angle;
    case Probe::Quantity::reaction:
    case Probe::Quantity::contact_force:
      return output::dimension::force;
  }
  return output::dimension::none;
}

/// Names and, given a simulation, values of the probes.
std::vector<output::ProbeValue> probe_values(const Case& input, const std::vector<Probe>& probes,
                                             const Simulation* sim) {
  std::vector<output::ProbeValue> values;
  for (std::size_t i = 0; i < probes.size(); ++i)
    values.push_back({probes[i].name, dimension_of(probes[i]), sim ? probes[i].value(*sim) : std::nan(""),
                      input.probes[i].expected.value_or(std::nan("")), input.probes[i].expected_from});
  return values;
}

output::Precision precision_of(const Case& input) {
  return input.output.precision == "single" ? output::Precision::single : output::Precision::full;
}

/// Adds the time until its end to a sum, seconds.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum), begin_(output::Progress::wall_clock()) {}
  Stopwatch(const Stopwatch&) = delete;
  ~Stopwatch() { sum_ += output::Progress::wall_clock() - begin_; }

 private:
  double& sum_;
  double begin_;
};

/// Writes history and fields, and shows progress.
class Recorder : public Observer {
 public:
  Recorder(const Case& input, const ExecuteOptions& options, const std::vector<Probe>& probes)
      : input_(input),
        probes_(probes),
        history_(options.directory / output::history_name, probe_values(input, probes, nullptr)),
        fields_(options.directory, units_of(input), input.output.compress, precision_of(input)),
        progress_(stderr, output::Progress::style_for(stderr, options.quiet), input.units.time) {}

  void history(const Simulation& sim, const Observation& now) override {
    const Stopwatch timing(seconds_);
    std::vector<double> values;
    for (const Probe& p : probes_) values.push_back(p.value(sim));
    history_.write({sim.model.step, sim.model.time, std::move(values), now.ledger, now.residual});
  }

  void fields(const Simulation& sim, const Observation&) override {
    const Stopwatch timing(seconds_);
    fields_.write(sim);
  }

  void progress(const Simulation& sim, const Observation& now) override {
    if (now.iterations > 0) return iteration(now);
    const bool dynamic = input_.analysis.type == "dynamic";
    const double fraction =
        dynamic ? sim.model.time / input_.analysis.duration : output::ProgressReport::unknown;
    if (!progress_.due(fraction)) return;
    output::ProgressReport report{.step = sim.model.step, .time = sim.model.time, .fraction = fraction};
    if (dynamic)
      report.balance = now.ledger.balance() / output::total_energy(now.ledger);
    else
      report.residual = now.residual, report.tolerance = input_.analysis.tolerance;
    progress_.show(report);
  }

  void warning(const Simulation&, const std::string& message) override {
    warnings_.push_back(message);
    progress_.finish();
    output::print(stderr, fmt::format("geist: warning: {}\n", message));
  }

  /// Wait for what is still being written. Throws std::runtime_error.
  void finish() {
    const Stopwatch timing(seconds_);
    progress_.finish();
    fields_.finish();
  }
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// What the run waited for output, seconds.
  double seconds() const { return seconds_; }

 private:
  void iteration(const Observation& now) {
    if (!progress_.due()) return;
    const bool start = input_.analysis.type == "dynamic";
    progress_.show({.step = now.iterations,
                    .iterating = true,
                    .residual = now.residual,
                    .tolerance = start ? static_start_tolerance : input_.analysis.tolerance});
  }

  const Case& input_;
  const std::vector<Probe>& probes_;
  output::History history_;
  output::FieldWriter fields_;
  output::Progress progress_;
  std::vector<std::string> warnings_;
  double seconds_ = 0;
};

std::string status_name(Status status) {
  switch (status) {
    case Status::completed:
      return "completed";
    case Status::not_converged:
      return "not converged";
    case Status::interrupted:
      return "interrupted";
    case Status::failed:
      return "failed";
  }
  return "failed";
}

int exit_code(Status status) {
  switch (status) {
    case Status::completed:
      return exit_completed;
    case Status::not_converged:
      return exit_not_converged;
    case Status::interrupted:
      return exit_interrupted;
    case Status::failed:
      return exit_failed;
  }
  return exit_failed;
}

nlohmann::ordered_json as_json(const std::string& toml_text) {
  std::ostringstream text;
  text << toml::json_formatter(toml::parse(toml_text));
  return nlohmann::ordered_json::parse(text.str());
}

/// Where the wall time went; `output` of it into waiting for files.
std::vector<output::Phase> phases_of(const Timers& timers, double output, double wall) {
  std::vector<output::Phase> phases;
  double known = output;
  for (std::size_t i = 0; i < phase_names.size(); ++i) {
    phases.push_back({phase_names[i], timers.seconds(static_cast<Phase>(i))});
    known += phases.back().seconds;
  }
  phases.push_back({"output", output});
  phases.push_back({"the rest", std::max(0.0, wall - known)});
  return phases;
}

output::RunSummary summarise(const Case& input, const ExecuteOptions& options, const Built& built,
                             const Outcome& outcome, double output, double wall) {
  const Simulation& sim = built.simulation;
  output::RunSummary s;
  s.title = input.title, s.status = status_name(outcome.status), s.message = outcome.message;
  s.units = units_of(input);
  s.probes = probe_values(input, built.probes, &sim);
  s.ledger = outcome.last.ledger;
  s.counts = output::count(sim.model);
  const TimeStepBound& least = critical(built.bounds);
  s.time_step = {sim.dt,
                 least.bound,
                 fmt::format("region '{}': {}", least.region, least.limit),
                 sim.subcycling.ratio(),
                 fine_hexahedra(sim),
                 sim.subcycling.lattices() ? s.counts.particles : 0};
  s.steps = sim.model.step, s.time = sim.model.time;
  if (input.analysis.type == "quasi-static")
    s.quasi_static = output::Convergence{outcome.last.residual, input.analysis.tolerance,
                                         outcome.status == Status::completed};
  if (const auto& found = outcome.equilibrium)
    s.equilibrium = output::EquilibriumFound{
        found->iterations,
        {found->residual, plan_of(input).is_static ? input.analysis.tolerance : static_start_tolerance,
         found->end == Equilibrium::End::found}};
  s.phases = phases_of(sim.timers, output, wall);
  const auto rate = [&](std::size_t n) {
    return static_cast<double>(n) * static_cast<double>(s.steps) / wall;
  };
  s.particle_steps_per_second = rate(s.counts.particles);
  s.element_steps_per_second = rate(s.counts.hexahedra);
  s.threads = threads();
  s.state_hash = state_hash(sim.model);
  s.versions = output::library_versions();
  s.versions["geist"] = options.version;
  s.complete_case = as_json(input.toml);
  return s;
}

/// Iterations and steps, in words.
std::string work_done(const output::RunSummary& s) {
  const std::string steps =
      fmt::format("{} steps to time {:.6g} {}", output::with_commas(s.steps), s.time, s.units.time().name);
  if (!s.equilibrium) return steps;
  const std::string iterations = fmt::format("{} iterations", output::with_commas(s.equilibrium->iterations));
  return s.steps == 0 ? iterations : iterations + ", " + steps;
}

std::string residual(const output::Convergence& c, const char* of) {
  return fmt::format("residual{} {:.3g} of the load (wanted {:.3g})\n", of, c.residual, c.tolerance);
}

void print_end(const output::RunSummary& s, const ExecuteOptions& options) {
  std::string text = fmt::format(
      "\n{}{}{}: {} in {} on {} thread{}\n", s.status, s.message.empty() ? "" : ": ", s.message, work_done(s),
      output::human_seconds(s.wall_seconds()), s.threads, s.threads == 1 ? "" : "s");
  if (s.equilibrium) text += residual(s.equilibrium->convergence, s.steps > 0 ? " at the start" : "");
  if (s.quasi_static) text += residual(*s.quasi_static, "");
  if (!s.probes.empty()) text += "\n" + output::to_text(output::probe_table(s.probes, s.units));
  text += "\n" + output::to_text(output::ledger_table(s.ledger, s.units));
  text += "\n" + output::to_text(output::timing_table(s.phases));
  text += fmt::format(
      "\nresults in {}/: open fields.pvd with ParaView, history.csv with a spreadsheet or pandas\n",
      options.directory.string());
  output::print(stdout, text);
}

/// Run, and wait for all files.
Outcome watched_run(Simulation& sim, const RunPlan& plan, Recorder& recorder) {
  Outcome outcome;
  const auto or_fail = [&](auto act) {
    try {
      act();
    } catch (const std::runtime_error& e) {  // a file could not be written
      outcome.status = Status::failed;
      outcome.message = fmt::format("step {}, time {:.6g}: {}", sim.model.step, sim.model.time, e.what());
    }
  };
  or_fail([&] { outcome = run(sim, plan, {&recorder}); });
  or_fail([&] { recorder.finish(); });
  return outcome;
}

}  // namespace

int execute(const Case& input, const ExecuteOptions& options) {
  Built built = build(input);
  set_threads(options.threads > 0 ? options.threads : worthwhile_threads(built.simulation.model));
  prepare_directory(options.directory, options.force);
  output::write_whole(options.directory / output::case_name, input.toml);
  if (!options.quiet) output::print(stdout, describe(input, built) + "\n");
  RunPlan plan = plan_of(input);
  plan.stop = options.stop;
  const double begin = output::Progress::wall_clock();
  Recorder recorder(input, options, built.probes);
  const Outcome outcome = watched_run(built.simulation, plan, recorder);
  auto summary =
      summarise(input, options, built, outcome, recorder.seconds(), output::Progress::wall_clock() - begin);
  summary.warnings = recorder.warnings();
  output::write_summary(options.directory / output::summary_name, summary);
  if (!outcome.message.empty())
    output::print(stderr, fmt::format("geist: {}: {}\n", summary.status, outcome.message));
  if (!options.quiet) print_end(summary, options);
  return exit_code(outcome.status);
}

std::filesystem::path default_directory(const std::filesystem::path& case_file) {
  fs::path name = case_file.stem();
  if (name == "case") {
    const fs::path folder = fs::absolute(case_file).parent_path().filename();
    if (!folder.empty()) name = folder;
  }
  return fs::path("results") / name;
}

}  // namespace geist
