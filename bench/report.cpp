#include "report.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "reference.hpp"

namespace geist::bench {
namespace {

std::string optional_text(const char* format, std::optional<double> value) {
  return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

std::optional<double> ratio_to_bare(const Row& row, const Limits& limits) {
  const auto bare = bare_kernels(row, limits);
  return bare ? std::optional(row.rate() / *bare) : std::nullopt;
}

std::string csv_line(const Row& r, const Limits& limits, double others) {
  return fmt::format(
      "{},{},{},{},{:.4g},{:.4g},{:.3f},{:.0f},{:.0f},{:.2f},{:.2f},{:.3f},{:.2f},{:.3f},{:.3f},{},{},{:.2f}"
      "\n",
      r.subject, r.what, r.size, r.threads, r.rate(), r.seconds, r.median, r.work.bytes, r.work.flops,
      1e-9 * r.bytes_rate(), 1e-9 * r.bandwidth, r.bytes_rate() / r.bandwidth, 1e-9 * r.flops_rate(),
      r.flops_rate() / limits.fma, r.share_of_roofline(limits),
      optional_text("{:.3g}", bare_kernels(r, limits)), optional_text("{:.2f}", ratio_to_bare(r, limits)),
      others);
}

nlohmann::ordered_json limits_json(const std::map<int, Limits>& all) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& [threads, l] : all)
    list.push_back({{"threads", threads},
                    {"fma_gflops", 1e-9 * l.fma},
                    {"cache_gbytes", 1e-9 * l.cache},
                    {"memory_gbytes", 1e-9 * l.memory},
                    {"fork_join_us", 1e6 * l.fork_join}});
  return list;
}

nlohmann::ordered_json row_json(const Row& r, const Limits& limits) {
  nlohmann::ordered_json j{{"what", r.what},
                           {"per_second", r.rate()},
                           {"seconds", r.seconds},
                           {"median_over_best", r.median},
                           {"bytes", r.work.bytes},
                           {"flops", r.work.flops},
                           {"share_of_bandwidth", r.bytes_rate() / r.bandwidth},
                           {"share_of_fma", r.flops_rate() / limits.fma}};
  if (const auto bare = bare_kernels(r, limits)) j["bare_kernels"] = *bare, j["ratio"] = r.rate() / *bare;
  return j;
}

nlohmann::ordered_json measured_json(const Measured& m, const Limits& limits) {
  const Row& whole = m.rows.front();
  nlohmann::ordered_json j{
      {"subject", whole.subject},      {"size", whole.size},
      {"threads", whole.threads},      {"triad_of_same_size_gbytes", 1e-9 * whole.bandwidth},
      {"others_busy", m.others},       {"rounds", m.rounds},
      {"quiet_rounds", m.quiet_rounds}};
  for (const Row& r : m.rows) j["rows"].push_back(row_json(r, limits));
  for (std::size_t i = 0; i < phase_names.size(); ++i)
    j["phase_seconds"][phase_names[i]] = m.phases.seconds[i];
  return j;
}

std::ofstream open(const std::string& path) {
  std::ofstream file(path);
  if (!file) throw std::runtime_error("cannot write " + path);
  return file;
}

}  // namespace

void print_header(const Results& results) {
  for (const auto& [name, value] : results.machine) fmt::print("{:13} {}\n", name, value);
  fmt::print(
      "\nrate: million particle- or element-steps per second; B, flop: per particle or element and step;\n"
      "%: of a triad on as many bytes, and of the multiply-add rate; bare: bare kernels' figures scaled to "
      "this\n"
      "machine; noise: median over best; others: processors that others kept busy\n\n"
      "{:18} {:25} {:>12} {:>3} {:>8} {:>5} {:>6} {:>6} {:>4} {:>7} {:>4} {:>7} {:>6} {:>6} {:>6}\n",
      "subject", "what", "size", "thr", "rate", "B", "flop", "GB/s", "%", "GFLOP/s", "%", "bare", "ratio",
      "noise", "others");
}

void print_rows(const Measured& measured, const Limits& limits) {
  for (const Row& r : measured.rows) {
    const auto bare = bare_kernels(r, limits);
    fmt::print(
        "{:18} {:25} {:>12} {:>3} {:>8.2f} {:>5.0f} {:>6.0f} {:>6.1f} {:>4.0f} {:>7.1f} {:>4.0f} {:>7} {:>6} "
        "{:>6.2f} {:>6.1f}\n",
        r.subject, r.what, r.size, r.threads, 1e-6 * r.rate(), r.work.bytes, r.work.flops,
        1e-9 * r.bytes_rate(), 100 * r.bytes_rate() / r.bandwidth, 1e-9 * r.flops_rate(),
        100 * r.flops_rate() / limits.fma, bare ? fmt::format("{:.1f}", 1e-6 * *bare) : "-",
        optional_text("{:.2f}", ratio_to_bare(r, limits)), r.median, measured.others);
  }
  double total = 0;
  for (const double s : measured.phases.seconds) total += s;
  fmt::print("    plain step:");
  for (std::size_t i = 0; i < phase_names.size(); ++i)
    if (measured.phases.seconds[i] > 1e-4 * total)
      fmt::print(" {} {:.1f} %;", phase_names[i], 100 * measured.phases.seconds[i] / total);
  fmt::print(" {:.3f} ms; {} of {} rounds quiet\n", 1e3 * total, measured.quiet_rounds, measured.rounds);
  std::fflush(stdout);
}

void print_limits(const Results& results) {
  fmt::print("\nlimits of the machine, the best of the same run\n");
  for (const auto& [threads, l] : results.limits)
    fmt::print(
        "{} thread(s): {:.1f} GFLOP/s multiply-add, triad {:.1f} GB/s in L2, {:.1f} GB/s from memory; "
        "fork and join {:.1f} us\n",
        threads, 1e-9 * l.fma, 1e-9 * l.cache, 1e-9 * l.memory, 1e6 * l.fork_join);
}

void write_results(const Results& results, const std::string& stem) {
  nlohmann::ordered_json json;
  std::ofstream csv = open(stem + ".csv");
  for (const auto& [name, value] : results.machine)
    csv << "# " << name << ": " << value << '\n', json["machine"][name] = value;
  for (const auto& [threads, l] : results.limits)
    csv << fmt::format(
        "# limits {} threads: {:.1f} GFLOP/s, {:.1f} GB/s in L2, {:.1f} GB/s from memory, fork-join {:.1f} "
        "us\n",
        threads, 1e-9 * l.fma, 1e-9 * l.cache, 1e-9 * l.memory, 1e6 * l.fork_join);
  csv << "subject,what,size,threads,items_per_second,seconds,median_over_best,bytes,flops,gbytes_per_second,"
         "triad_gbytes_per_second,share_of_bandwidth,gflops,share_of_fma,share_of_roofline,bare_kernels,"
         "ratio,"
         "others_busy\n";
  json["limits"] = limits_json(results.limits);
  for (const Measured& m : results.measured) {
    const Limits& limits = results.limits.at(m.rows.front().threads);
    for (const Row& r : m.rows) csv << csv_line(r, limits, m.others);
    json["measured"].push_back(measured_json(m, limits));
  }
  open(stem + ".json") << json.dump(1) << '\n';
}

}  // namespace geist::bench
