#include "solver/subcycling.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "fe/elements.hpp"

namespace geist {
namespace {

/// T_0(δ) … T_m(δ), and ω = 2 T_m'(δ) / T_m(δ), of damping ν.
struct Chebyshev {
  double delta, omega;
  std::vector<double> T;

  explicit Chebyshev(int m) : delta(1 + 0.1 / (m * m)), T{1, delta} {
    std::vector<double> slope{0, 1};
    for (int k = 1; k < m; ++k) {
      T.push_back(2 * delta * T[k] - T[k - 1]);
      slope.push_back(2 * T[k] + 2 * delta * slope[k] - slope[k - 1]);
    }
    omega = 2 * slope[m] / T[m];
  }
};

}  // namespace

std::vector<Substep> substeps(int m) {
  if (m == 1) return {{0, 0.5, 1}};
  const Chebyshev c(m);
  std::vector<Substep> steps{{0, 1 / (c.omega * c.delta), 0}};
  for (int k = 1; k < m; ++k)
    steps.push_back({c.T[k - 1] / c.T[k + 1], 2 * c.T[k] / (c.omega * c.T[k + 1]), 0});
  // z_m − z_0 = Σ_k γ_k (1 + κ_{k+1} (1 + κ_{k+2} (…))) Δt² a_k = ½ Δt² ã
  double onwards = 0;
  for (int k = m; k-- > 0;) {
    onwards = 1 + (k + 1 < m ? steps[k + 1].keep * onwards : 0);
    steps[k].share = 2 * steps[k].gain * onwards;
  }
  return steps;
}

double stable_phase(int m) {
  if (m == 1) return 2;
  const Chebyshev c(m);
  return std::sqrt(2 * c.delta * c.omega);  // T_m(δ − φ²/ω) = ±T_m(δ) at the end of −δ … δ
}

double stable_remainder(int m) {
  return m == 1 ? 0
                : 2 - 2 / Chebyshev(m).T.back();  // from 2 (1 + 1/T_m(δ)), where resonances would be, to 4
}

Subcycling::Subcycling(const Model& model, const FinePart& part) {
  if (part.empty()) return;
  const Mesh& mesh = model.mesh;
  steps_ = substeps(part.m);
  fine_ = make_sweep(mesh, part.blocks), others_ = make_sweep(mesh, part.others);
  for (const std::int32_t b : part.blocks)
    visit_nodes(mesh, mesh.blocks[b], [this](std::int32_t i) { nodes_.push_back(i); });
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  for (const std::int32_t i : nodes_) still_.push_back(part.is_fine[i] ? mesh.held[i] : 0b111);
  for (Field<3>* field : {&u_, &rest_, &increment_, &mean_}) *field = Field<3>(nodes_.size());
  if (part.lattices)
    for (const Lattice& lattice : model.lattices) lattices_.emplace_back(lattice);
}

void Subcycling::add_mean_forces(Model& model, const coupling::Reactions& reactions, Vec3 gravity, double dt,
                                 Timers& timers) {
  begin(model, timers);
  for (const Substep& step : steps_) {  // each as Simulation::step, but for what is fine alone
    if (&step != steps_.data()) drift_lattices(model, timers);
    {
      const auto timing = timers.time(Phase::elements);
      fe::add_internal_forces(model.mesh, fine_, 1);
    }
    {
      const auto timing = timers.time(Phase::lattice);
      kick_lattices(model, step, gravity, dt);
    }
    const auto timing = timers.time(Phase::nodes);
    if (lattices()) reactions.add(model);
    kick_and_drift(model.mesh, step, gravity, dt);
  }
  end(model, timers);
}

/// f(place in nodes_, node)
template <class F>
void Subcycling::for_nodes(F f) const {
  constexpr std::size_t grain = 500;
  for_each(
      nodes_.size(), [f, node = nodes_.data()](std::size_t n) { f(n, static_cast<std::size_t>(node[n])); },
      grain);
}

void Subcycling::begin(Model& model, Timers& timers) {
  const auto timing = timers.time(Phase::nodes);
  Mesh& mesh = model.mesh;
  for_nodes([this, &mesh](std::size_t n, std::size_t i) {
    u_.set(n, mesh.u.vector(i)), rest_.set(n, mesh.f.vector(i)), mean_.set(n, mesh.f.vector(i));
    mesh.f.set(i, {});
  });
  for (std::size_t l = 0; l < lattices_.size(); ++l) lattices_[l].begin(model.lattices[l]);
}

/// And their ghosts with the nodes, which have drifted already.
void Subcycling::drift_lattices(Model& model, Timers& timers) {
  for (std::size_t l = 0; l < lattices_.size(); ++l) {
    {
      const auto timing = timers.time(Phase::drift);
      lattices_[l].drift(model.lattices[l]);
    }
    const auto timing = timers.time(Phase::coupling);
    coupling::follow(model.lattices[l], model.mesh);
  }
}

void Subcycling::kick_lattices(Model& model, const Substep& step, Vec3 gravity, double dt) {
  const double gain = step.gain * dt * dt;
  const de::Kick kick{step.keep, gain, gain, gain * gravity};
  for (std::size_t l = 0; l < lattices_.size(); ++l) {
    Lattice& lattice = model.lattices[l];
    lattices_[l].step(lattice, kick.of(lattice), step.share);
  }
}

/// Takes the forces of what is fine from mesh.f, which is zero again then.
void Subcycling::kick_and_drift(Mesh& mesh, const Substep& step, Vec3 gravity, double dt) {
  for_nodes([=, this, &mesh, gain = step.gain * dt * dt](std::size_t n, std::size_t i) {
    const double per_mass = gain / mesh.mass[i];
    for (int c = 0; c < 3; ++c) {
      const double f = mesh.f[c][i];
      mesh.f[c][i] = 0;
      mean_[c][n] = fma(step.share, f, mean_[c][n]);
      if (still_[n] >> c & 1) continue;
      const double push = fma(per_mass, f + rest_[c][n], gain * gravity[c]);
      increment_[c][n] = fma(step.keep, increment_[c][n], push);
      mesh.u[c][i] += increment_[c][n];
    }
  });
}

void Subcycling::end(Model& model, Timers& timers) {
  const auto timing = timers.time(Phase::nodes);
  Mesh& mesh = model.mesh;
  for_nodes([this, &mesh](std::size_t n, std::size_t i) {
    mesh.u.set(i, u_.vector(n)), mesh.f.set(i, mean_.vector(n));
  });
  for (std::size_t l = 0; l < lattices_.size(); ++l) lattices_[l].end(model.lattices[l]);
}

de::KickSums Subcycling::kick(std::size_t l, Lattice& lattice, const de::Kick& kick, double dt) const {
  const double gain = kick.per_mass * 2 / (dt * dt);  // gravity is in Σ w_k
  return lattices_[l].kick(lattice, {kick.keep, gain, gain, {}});
}

}  // namespace geist
