#include "measure.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "clock.hpp"
#include "core/parallel.hpp"
#include "machine.hpp"
#include "solver/run.hpp"

namespace geist::bench {
namespace {

constexpr double sample_seconds = 0.03;  ///< short, to fit between what others do

/// In a quiet round others keep no more processors busy than that, and multiply-adds run at least at this
/// share of their best rate: on virtual machines two processors may share a core for a while, which shows in
/// no count.
constexpr double busy_at_most = 0.2, undisturbed_at_least = 0.9;

/// Repeats a function for one sample's time.
class Sampler {
 public:
  explicit Sampler(std::function<void()> run) : run_(std::move(run)) {
    run_();  // warm
    const double begin = now();
    run_();
    repeats_ = std::clamp(static_cast<int>(std::ceil(sample_seconds / (now() - begin))), 1, 10'000);
  }
  void sample() {
    const double begin = now();
    for (int i = 0; i < repeats_; ++i) run_();
    seconds_.push_back((now() - begin) / repeats_);
  }
  double best() const { return *std::min_element(seconds_.begin(), seconds_.end()); }
  double median() const {
    std::vector<double> sorted = seconds_;
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    return sorted[sorted.size() / 2];
  }
  int repeats() const { return repeats_; }

 private:
  std::function<void()> run_;
  int repeats_ = 1;
  std::vector<double> seconds_;
};

/// The seconds of each phase so far.
auto phase_seconds(const Timers& timers) {
  std::array<double, phase_names.size()> seconds;
  for (std::size_t i = 0; i < seconds.size(); ++i) seconds[i] = timers.seconds(static_cast<Phase>(i));
  return seconds;
}

/// Keeps the phases of the fastest sample of plain steps.
class PhaseKeeper {
 public:
  PhaseKeeper(const Timers& timers, PhaseRow& row) : timers_(timers), row_(row) {}
  void sample(Sampler& steps) {
    const auto before = phase_seconds(timers_);
    const double begin = now();
    steps.sample();
    const double taken = now() - begin;
    if (taken > best_) return;
    best_ = taken;
    const auto after = phase_seconds(timers_);
    for (std::size_t i = 0; i < after.size(); ++i) row_.seconds[i] = (after[i] - before[i]) / steps.repeats();
  }

 private:
  const Timers& timers_;
  PhaseRow& row_;
  double best_ = 1e9;
};

Row make_row(const Subject& s, const std::string& what, double best, double median, Work work,
             double bandwidth) {
  return {s.name, what, s.size(), threads(), best, median / best, s.items, work, bandwidth};
}

/// n − 1 plain steps and an observed one with its ledger, by step.
double mixed(double plain, double observed) {
  constexpr int n = steps_between_ledgers;
  return ((n - 1) * plain + observed) / n;
}

}  // namespace

double Row::share_of_roofline(const Limits& limits) const {
  return std::max(work.bytes / bandwidth, work.flops / limits.fma) * rate();
}

Measured measure(Subject& subject, Effort effort, Limits& limits) {
  static_assert(RunPlan{}.check_every == steps_between_ledgers);
  Simulation& sim = subject.simulation();
  Measured result;
  result.phases = {subject.name, subject.size(), threads(), {}};
  LimitProbe probe;
  Triad triad(subject.working_set);
  Sampler plain([&] { sim.step(false); });
  Sampler observed([&] { sim.step(true), sim.ledger(); });
  std::vector<Sampler> kernels;
  for (const Kernel& k : subject.kernels) kernels.emplace_back(k.run);
  PhaseKeeper keeper(sim.timers, result.phases);
  double bandwidth = 0;
  const Others others;
  const double end = now() + effort.patience;
  while (result.quiet_rounds < effort.rounds && (result.rounds < effort.rounds || now() < end)) {
    const Others in_this_round;
    const double fma = probe.measure(limits);
    bandwidth = std::max(bandwidth, triad.bandwidth());
    keeper.sample(plain);
    for (Sampler& k : kernels) k.sample();
    observed.sample();
    const double slowest = std::min(fma, fma_rate());
    ++result.rounds;
    if (in_this_round.busy() < busy_at_most && slowest > undisturbed_at_least * limits.fma)
      ++result.quiet_rounds;
  }
  result.others = others.busy();
  result.rows.push_back(make_row(subject, whole_program, mixed(plain.best(), observed.best()),
                                 mixed(plain.median(), observed.median()), subject.step, bandwidth));
  for (std::size_t k = 0; k < kernels.size(); ++k)
    result.rows.push_back(make_row(subject, subject.kernels[k].name, kernels[k].best(), kernels[k].median(),
                                   subject.kernels[k].work, bandwidth));
  result.rows.push_back(make_row(subject, observed_step, observed.best(), observed.median(), {}, bandwidth));
  return result;
}

}  // namespace geist::bench
