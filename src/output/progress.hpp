// Progress of a run: a live line on a terminal, plain lines elsewhere, nothing if asked.
#pragma once
#include <cstdio>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace geist::output {

/// How a run is going; what is unknown or does not apply is left as NaN.
struct ProgressReport {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  long step = 0;
  bool iterating = false;     ///< steps are iterations of a static analysis: there is no time
  double time = 0;            ///< in the case's unit
  double fraction = unknown;  ///< done, 0 to 1; dynamic runs
  double residual = unknown, tolerance = unknown;  ///< share of the load; static and quasi-static runs
  double balance = unknown;                        ///< share of the energies; dynamic runs
};

/// When a decaying residual will reach its tolerance, from its trend over the latter half of the run.
class DecayEstimate {
 public:
  void add(double seconds, double residual);
  /// Seconds from the last sample on; NaN while there is no trend downwards.
  double seconds_left(double tolerance) const;

 private:
  std::vector<std::pair<double, double>> samples_;  ///< seconds, log of the residual
};

class Progress {
 public:
  enum class Style { live, lines, quiet };
  using Clock = double (*)();  ///< seconds

  /// Live on a terminal, lines elsewhere, quiet if asked.
  static Style style_for(std::FILE* out, bool quiet);
  /// Seconds of a clock that never goes back.
  static double wall_clock();

  Progress(std::FILE* out, Style style, std::string time_unit, Clock clock = wall_clock);
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Whether it is time for another report: five times a second live; as lines every ten seconds and at each
  /// tenth of the run. Cheap enough to ask at every step, so that a report is only made up when it is.
  bool due(double fraction = ProgressReport::unknown) const;
  void show(const ProgressReport& report);
  /// A line of text that stays, above the live line.
  void say(std::string_view text);
  /// Remove the live line, for what comes after the run.
  void finish();

 private:
  double seconds_left(const ProgressReport& report, double now);
  std::string line(const ProgressReport& report, double now);

  std::FILE* out_;
  Style style_;
  std::string time_unit_;
  Clock clock_;
  double start_, last_;  ///< seconds: of the run, of the last report
  long last_step_ = 0;
  int tenths_ = 0;         ///< of the run, reported
  double rate_ = 0;        ///< steps per second, smoothed
  std::size_t shown_ = 0;  ///< length of the live line
  DecayEstimate decay_;
};

}  // namespace geist::output
