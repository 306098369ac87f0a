// Measuring a subject: rounds in which the machine's limits, the whole step and the bare kernels take turns,
// so that all of them see the same machine; of each the best counts.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "limits.hpp"
#include "solver/timers.hpp"
#include "subjects.hpp"

namespace geist::bench {

struct Row {
  std::string subject, what, size;
  int threads = 0;
  double seconds = 0;  ///< the best
  double median = 0;   ///< over the best: how noisy the machine was
  double items = 0;
  Work work;
  double bandwidth = 0;  ///< of a triad on as many bytes, bytes/s

  double rate() const { return items / seconds; }
  double bytes_rate() const { return work.bytes * rate(); }
  double flops_rate() const { return work.flops * rate(); }
  /// The time that the work would take at the machine's limits, over the time it took.
  double share_of_roofline(const Limits& limits) const;
};

/// Seconds of each phase of a plain step, in the fastest sample.
struct PhaseRow {
  std::string subject, size;
  int threads = 0;
  std::array<double, phase_names.size()> seconds{};
};

struct Measured {
  std::vector<Row> rows;  ///< the whole program first
  PhaseRow phases;
  double others = 0;  ///< processors that others kept busy meanwhile
  int rounds = 0, quiet_rounds = 0;
};

inline constexpr const char* whole_program = "whole program";
inline constexpr const char* observed_step = "observed step and ledger";
inline constexpr int steps_between_ledgers = 100;  ///< RunPlan::check_every

/// How long to go on: until so many rounds saw a quiet machine, or, after that number of rounds at least, the
/// patience is at an end.
struct Effort {
  int rounds = 12;
  double patience = 0;  ///< seconds
};

/// Measure with the threads in use; the limits are improved on the way.
Measured measure(Subject& subject, Effort effort, Limits& limits);

}  // namespace geist::bench
