#include "verification/contact_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "case/read.hpp"
#include "core/parallel.hpp"
#include "verification/support.hpp"

namespace geist::verification {
namespace {

class Recorder : public Observer {
 public:
  Recorder(Recording& recording, const Watch& watch) : recording_(recording), watch_(watch) {
    recording_.probe.resize(recording_.built.probes.size());
  }
  void history(const Simulation& sim, const Observation& now) override {
    recording_.time.push_back(sim.model.time), recording_.ledger.push_back(now.ledger);
    for (std::size_t i = 0; i < recording_.probe.size(); ++i)
      recording_.probe[i].push_back(recording_.built.probes[i].value(sim));
    if (watch_) recording_.watched.push_back(watch_(sim));
  }
  void warning(const Simulation&, const std::string& message) override {
    recording_.warnings.push_back(message);
  }

 private:
  Recording& recording_;
  const Watch& watch_;
};

}  // namespace

const std::vector<double>& Recording::of(const std::string& name) const {
  for (std::size_t i = 0; i < probe.size(); ++i)
    if (built.probes[i].name == name) return probe[i];
  throw std::logic_error("no such probe");
}

double Recording::worst_balance() const {
  double worst = 0, most = 0;
  for (const Ledger& l : ledger)
    worst = std::max(worst, std::abs(l.balance())), most = std::max(most, l.kinetic() + l.internal());
  return worst / most;
}

double Recording::worst_momentum() const {
  double worst = 0;
  for (const Ledger& l : ledger) worst = std::max(worst, norm(l.linear - ledger[0].linear));
  return worst;
}

Recording run_text(const std::string& text, double every, const Watch& watch, int threads) {
  const Case input = read_case_text(text, "contact.toml", {"method=published"});
  Recording recording{build(input), {}, {}, {}, {}, {}, {}};
  RunPlan plan = plan_of(input);
  plan.history_every = every;
  Recorder recorder(recording, watch);
  set_threads(threads);
  recording.outcome = run(recording.built.simulation, plan, {&recorder});
  set_threads(1);
  EXPECT_EQ(recording.outcome.status, Status::completed) << recording.outcome.message;
  return recording;
}

Particle only_particle(const Model& model, std::size_t l) {
  const Lattice& lattice = model.lattices.at(l);
  if (lattice.count(site::particle) != 1) throw std::logic_error("not one particle");
  std::size_t s = 0;
  while (!lattice.is(s, site::particle)) ++s;
  const auto velocity = [&](int first) {
    return 0.5 * (lattice.velocity_before.vector(s, first) + lattice.velocity.vector(s, first));
  };
  return {lattice.grid.centre(s) + lattice.motion.vector(s),
          velocity(0),
          velocity(3),
          lattice.mass,
          lattice.inertia,
          lattice.radius()};
}

double peak(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

}  // namespace geist::verification
