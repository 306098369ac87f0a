// The command line: geist run, check, schema, reference.
#include <fmt/format.h>
#include <signal.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "case/build.hpp"
#include "case/diagnostic.hpp"
#include "case/read.hpp"
#include "case/reference.hpp"
#include "output/console.hpp"
#include "session/describe.hpp"
#include "session/execute.hpp"

namespace {

volatile std::sig_atomic_t stop_signal = 0;

extern "C" void on_signal(int signal) { stop_signal = signal; }

/// End at the next step's end; a second signal ends the program at once.
void catch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);  // a file-size limit is an error of the write, not our end
}

struct Options {
  std::string file, directory;
  std::vector<std::string> set;
  bool force = false, quiet = false;
  int threads = 0;
};

int run_case(const Options& o) {
  const geist::Case input = geist::read_case(o.file, o.set);
  geist::ExecuteOptions options;
  options.directory = o.directory.empty() ? geist::default_directory(o.file).string() : o.directory;
  options.force = o.force, options.threads = o.threads, options.quiet = o.quiet;
  options.version = GEIST_VERSION;
  options.stop = &stop_signal;
  catch_signals();
  const int code = geist::execute(input, options);
  return code == geist::exit_interrupted && stop_signal ? 128 + stop_signal : code;
}

int check_case(const Options& o) {
  const geist::Case input = geist::read_case(o.file, o.set);
  geist::output::print(stdout, geist::describe(input, geist::build(input)));
  return geist::exit_completed;
}

void add_case_options(CLI::App* command, Options& o) {
  command->add_option("CASE", o.file, "case file (TOML)")->required();
  command->add_option("--set", o.set, "change one key of the case: PATH=VALUE, the value in TOML")
      ->type_name("PATH=VALUE")
      ->take_all()
      ->allow_extra_args();
}

/// Parse the command line and do what it says; the exit code.
int main_with(int argc, char** argv) {
  CLI::App app{
      "Geist: impact on and fracture of brittle solids by finite and discrete elements, coupled by ghost "
      "particles"};
  app.footer(
      "Examples:\n"
      "  geist run examples/beam/case.toml\n"
      "  geist run examples/beam/case.toml --out results/fine --set regions.middle.radius=0.125\n"
      "  geist run examples/beam/case.toml --set \"regions.left.divisions=[14,4,2]\" --threads 2 --force\n"
      "  geist check examples/beam/case.toml\n"
      "\nExit codes: 0 completed, 1 failed, 2 bad input, 3 not converged, 128 + n stopped by signal n.");
  app.set_version_flag("--version", "geist " GEIST_VERSION);
  app.require_subcommand(1);
  Options o;
  CLI::App* const run = app.add_subcommand("run", "run a case and write its results");
  add_case_options(run, o);
  run->add_option("--out", o.directory, "directory of the results (default: results/<case>)")
      ->type_name("DIR");
  run->add_flag("--force", o.force, "overwrite results that are there");
  run->add_option("--threads", o.threads, "number of threads (default: as many as pay off)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  run->add_flag("--quiet", o.quiet, "print nothing but errors");
  CLI::App* const check =
      app.add_subcommand("check", "validate a case and print what was understood, without running");
  add_case_options(check, o);
  CLI::App* const schema = app.add_subcommand("schema", "print the JSON Schema of case files, for editors");
  CLI::App* const reference = app.add_subcommand("reference", "print the reference of all keys, in Markdown");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? geist::exit_completed : geist::exit_bad_input;
  }
  if (*schema) return geist::output::print(stdout, geist::case_schema_json()), geist::exit_completed;
  if (*reference)
    return geist::output::print(stdout, geist::case_reference_markdown()), geist::exit_completed;
  return *run ? run_case(o) : *check ? check_case(o) : geist::exit_bad_input;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return main_with(argc, argv);
  } catch (const geist::CaseError& e) {
    geist::output::print(stderr, std::string(e.what()) + "\n");
    return geist::exit_bad_input;
  } catch (const std::bad_alloc&) {
    geist::output::print(stderr, "geist: error: not enough memory for this case\n");
    return geist::exit_bad_input;
  } catch (const std::exception& e) {
    geist::output::print(stderr, fmt::format("geist: error: {}\n", e.what()));
    return geist::exit_bad_input;
  }
}
