#include "machine.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <sstream>

#include "clock.hpp"
#include "core/parallel.hpp"

namespace geist::bench {
namespace {

std::string first_line(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

/// The value of a line "name : value".
std::string value_in(const std::string& path, const std::string& name) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const auto colon = line.find(':');
    if (colon == std::string::npos || line.compare(0, name.size(), name) != 0) continue;
    const auto begin = line.find_first_not_of(" \t", colon + 1);
    return begin == std::string::npos ? "" : line.substr(begin);
  }
  return "unknown";
}

/// "L1d 32K, L2 1024K, …" of one processor.
std::string caches() {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    const std::string at = fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}/", i);
    const std::string level = first_line(at + "level"), type = first_line(at + "type");
    if (level.empty() || type == "Instruction") continue;
    text += fmt::format("{}L{} {}", text.empty() ? "" : ", ", level, first_line(at + "size"));
    const std::string shared = first_line(at + "shared_cpu_list");
    if (shared.find_first_of(",-") != std::string::npos) text += " (shared)";
  }
  return text.empty() ? "unknown" : text;
}

std::string today() {
  const std::time_t t = std::time(nullptr);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&t));
  return text;
}

std::string instruction_set() {
#if defined(__AVX512F__)
  return "AVX-512";
#elif defined(__FMA__)
  return "AVX2 with FMA";
#else
  return "baseline";
#endif
}

std::string compiler() {
#if defined(__clang__)
  return "clang++ " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

/// Seconds that all processors together were busy, by anyone, since the start of the machine.
double all_busy_seconds() {
  std::istringstream line(first_line("/proc/stat"));
  std::string name;
  double user = 0, nice = 0, system = 0, idle = 0, waiting = 0, irq = 0, soft = 0, stolen = 0;
  line >> name >> user >> nice >> system >> idle >> waiting >> irq >> soft >> stolen;
  return (user + nice + system + irq + soft + stolen) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double own_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](timeval t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

cpu_set_t allowed_at_start() {
  cpu_set_t set;
  CPU_ZERO(&set);
  sched_getaffinity(0, sizeof set, &set);
  return set;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> describe_machine() {
  return {{"geist", GEIST_VERSION},
          {"date", today()},
          {"processor",
           fmt::format("{}, family {}, model {}", value_in("/proc/cpuinfo", "model name"),
                       value_in("/proc/cpuinfo", "cpu family"), value_in("/proc/cpuinfo", "model\t"))},
          {"cores", fmt::format("{}", sysconf(_SC_NPROCESSORS_ONLN))},
          {"caches", caches()},
          {"memory", value_in("/proc/meminfo", "MemTotal")},
          {"compiler", compiler()},
          {"instructions", instruction_set() + ", -march=" GEIST_ARCH}};
}

double load_average() {
  double load[1] = {0};
  return getloadavg(load, 1) == 1 ? load[0] : 0;
}

Others::Others() : begin_(now()), all_(all_busy_seconds()), own_(own_seconds()) {}

double Others::busy() const {
  const double busy = (all_busy_seconds() - all_) - (own_seconds() - own_);
  return std::max(0.0, busy / std::max(1e-9, now() - begin_));
}

void use_threads(int n) {
  static const cpu_set_t allowed = allowed_at_start();
  sched_setaffinity(0, sizeof allowed, &allowed);
  set_threads(n);
}

}  // namespace geist::bench
