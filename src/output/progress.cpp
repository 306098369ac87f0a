#include "output/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "output/console.hpp"

namespace geist::output {
namespace {

/// Columns of the terminal.
std::size_t columns(std::FILE* out) {
  winsize size{};
  const bool known = ioctl(fileno(out), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

/// Tenths of the run that are done; what is unknown counts as none.
int tenths(double fraction) { return std::isnan(fraction) ? 0 : static_cast<int>(10 * fraction + 1e-9); }

}  // namespace

void DecayEstimate::add(double seconds, double residual) {
  if (!(residual > 0) || !std::isfinite(residual)) return;
  samples_.emplace_back(seconds, std::log(residual));
  if (samples_.size() < 128) return;
  // Keep every second one: old samples thin out, recent ones stay dense.
  for (std::size_t i = 0; i < 64; ++i) samples_[i] = samples_[2 * i + 1];
  samples_.resize(64);
}

double DecayEstimate::seconds_left(double tolerance) const {
  if (samples_.size() < 6) return ProgressReport::unknown;
  const double half = 0.5 * (samples_.front().first + samples_.back().first);
  double n = 0, t = 0, r = 0, tt = 0, tr = 0;  // sums for a straight line through (seconds, log residual)
  for (const auto& [seconds, log_residual] : samples_)
    if (const double x = seconds - half; x >= 0)
      n += 1, t += x, r += log_residual, tt += x * x, tr += x * log_residual;
  const double slope = (n * tr - t * r) / (n * tt - t * t);
  if (!(slope < 0)) return ProgressReport::unknown;
  const double now = r / n + slope * (samples_.back().first - half - t / n);
  return std::max(0.0, (std::log(tolerance) - now) / slope);
}

Progress::Style Progress::style_for(std::FILE* out, bool quiet) {
  return quiet ? Style::quiet : isatty(fileno(out)) ? Style::live : Style::lines;
}

double Progress::wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Progress::Progress(std::FILE* out, Style style, std::string time_unit, Clock clock)
    : out_(out),
      style_(style),
      time_unit_(std::move(time_unit)),
      clock_(clock),
      start_(clock()),
      last_(start_) {}

bool Progress::due(double fraction) const {
  if (style_ == Style::quiet) return false;
  const double since = clock_() - last_;
  return style_ == Style::live ? since >= 0.2 : since >= 10 || tenths(fraction) > tenths_;
}

void Progress::show(const ProgressReport& report) {
  if (style_ == Style::quiet) return;
  const double now = clock_();
  if (now > last_) {
    const double recent = static_cast<double>(report.step - last_step_) / (now - last_);
    rate_ = rate_ > 0 ? 0.7 * rate_ + 0.3 * recent : recent;
  }
  const std::string text = line(report, now);
  last_ = now, last_step_ = report.step, tenths_ = tenths(report.fraction);
  if (style_ == Style::lines) return print(out_, text + '\n');
  const std::string visible = text.substr(0, columns(out_) - 1);
  print(out_, fmt::format("\r{:<{}}", visible, shown_));
  shown_ = visible.size();
}

void Progress::say(std::string_view text) {
  finish();
  if (style_ != Style::quiet) print(out_, fmt::format("{}\n", text));
}

void Progress::finish() {
  if (shown_ > 0) print(out_, fmt::format("\r{:{}}\r", "", shown_));
  shown_ = 0;
}

double Progress::seconds_left(const ProgressReport& report, double now) {
  if (report.fraction > 0) return (now - start_) * (1 - report.fraction) / report.fraction;
  decay_.add(now, report.residual);
  return report.tolerance > 0 ? decay_.seconds_left(report.tolerance) : ProgressReport::unknown;
}

std::string Progress::line(const ProgressReport& report, double now) {
  std::string text = fmt::format("{} {}", report.iterating ? "iteration" : "step", with_commas(report.step));
  if (!report.iterating) text += fmt::format(" | {:.6g} {}", report.time, time_unit_);
  if (!std::isnan(report.fraction)) text += fmt::format(" | {:.0f} %", std::floor(100 * report.fraction));
  if (!std::isnan(report.residual)) text += fmt::format(" | residual {:.2e}", report.residual);
  if (!std::isnan(report.balance)) text += fmt::format(" | balance {:+.1e}", report.balance);
  if (rate_ > 0)
    text += fmt::format(" | {} {}/s", with_commas(std::llround(rate_)),
                        report.iterating ? "iterations" : "steps");
  const double left = seconds_left(report, now);
  if (left < 59.5)
    text += fmt::format(" | {:.0f} s left", std::max(0.0, left));
  else if (std::isfinite(left))
    text += fmt::format(" | {} left", human_seconds(left));
  return text;
}

}  // namespace geist::output
