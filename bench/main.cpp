// geist_bench: how fast the whole program and its kernels are, beside what the machine could do, in one run.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>

#include "core/parallel.hpp"
#include "machine.hpp"
#include "report.hpp"

namespace {

using namespace geist::bench;

struct Options {
  bool quick = false;
  Effort effort{0, 0};
  int threads = 0;
  std::vector<int> edges;
  std::vector<std::string> subjects{
      "lattice",          "lattice+finite",       "lattice+consistent", "lattice+consistent+finite",
      "one-point",        "assumed-strain",       "selective-reduced",  "full",
      "one-point+finite", "assumed-strain+finite"};
  std::string out;
};

void add_options(CLI::App& app, Options& o) {
  app.add_flag("--quick", o.quick, "a short run: small cubes and few rounds");
  app.add_option("--rounds", o.effort.rounds,
                 "rounds of measurement, of which the best counts (12; quick: 3)");
  app.add_option("--patience", o.effort.patience,
                 "go on for so many seconds in search of as many quiet rounds");
  app.add_option("--threads", o.threads, "compare one thread with this many (default: all processors)");
  app.add_option("--edges", o.edges, "particles or elements along an edge (40 100; quick: 40)");
  app.add_option("--subjects", o.subjects,
                 "lattice, one-point, assumed-strain, selective-reduced, full; each also with "
                 "+contact, +finite, +consistent");
  app.add_option("--out", o.out, "write FILE.csv and FILE.json")->type_name("FILE");
}

void complete(Options& o) {
  if (o.effort.rounds <= 0) o.effort.rounds = o.quick ? 3 : 12;
  if (o.edges.empty()) o.edges = o.quick ? std::vector<int>{40} : std::vector<int>{40, 100};
  if (o.threads <= 0) o.threads = static_cast<int>(geist::allowed_processors().size());
}

Results run(const Options& o) {
  Results results;
  results.machine = describe_machine();
  results.machine.emplace_back("load", fmt::format("{:.1f} at the start", load_average()));
  print_header(results);
  for (const std::string& name : o.subjects)
    for (const int edge : o.edges) {
      use_threads(o.threads);
      const auto subject = make_subject(name, edge);
      for (const int threads : std::set{1, o.threads}) {
        use_threads(threads);
        results.measured.push_back(measure(*subject, o.effort, results.limits[threads]));
        print_rows(results.measured.back(), results.limits[threads]);
      }
      fmt::print("    built in {:.2f} s, {:.0f} bytes an item in a step\n", subject->build_seconds,
                 static_cast<double>(subject->working_set) / subject->items);
    }
  results.machine.back().second += fmt::format(", {:.1f} at the end", load_average());
  print_limits(results);
  return results;
}

}  // namespace

int main(int argc, char** argv) try {
  Options options;
  CLI::App app("How fast Geist is, beside what the machine could do");
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  complete(options);
  const Results results = run(options);
  if (!options.out.empty()) write_results(results, options.out);
  return 0;
} catch (const std::exception& e) {
  fmt::print(stderr, "geist_bench: {}\n", e.what());
  return 1;
}
