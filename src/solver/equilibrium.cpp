#include "solver/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/parallel.hpp"
#include "solver/free_bodies.hpp"
#include "solver/point_blocks.hpp"
#include "solver/rigid_blocks.hpp"
#include "solver/static_model.hpp"

namespace geist {
namespace {

/// At least a hundred blocks, and at most about a thousand: their matrix is factorised within a second.
/// Measured: fewer than eight places a block do not pay in iterations, more than a hundred cost time.
std::size_t block_size(const Model& model) {
  std::size_t places = model.mesh.nodes();
  for (const Lattice& lattice : model.lattices) places += lattice.count(site::particle);
  return std::max(std::clamp<std::size_t>(places / 100, 8, 100), places / 1000);
}

/// Finite rotations, measured on cantilevers that bend to sixty degrees: looser linear solutions take more of
/// Newton's steps, each of which sets up the preconditioner anew.
constexpr double linear_tolerance = 1e-3;  ///< of the residual before the step
constexpr double path_tolerance = 1e-4;    ///< of equilibria on the way
constexpr int most_newton = 12;            ///< steps before the load is divided
constexpr int easy_newton = 5;             ///< so few: the next step of the load may be twice as long
constexpr double least_load_step = 1e-4;

/// One search. Vectors have six numbers a place; forces hold reactions (with their sign turned) where
/// components are held.
class Search {
 public:
  Search(Simulation& sim, const EquilibriumPlan& plan)
      : sim_(sim),
        plan_(plan),
        full_load_(norm(sim.loads, sim.model, sim.model.time)),
        model_(sim, block_size(sim.model)),
        prescribed_(model_.prescribed()),
        r_(prescribed_.size()),
        z_(r_.size()),
        p_(r_.size()),
        q_(r_.size()),
        d_(r_.size()) {}

  Equilibrium run() {
    if (std::string refused = model_.refusal(prescribed_); !refused.empty())
      return {Equilibrium::End::failed, std::move(refused), 0, 0};
    StaticModel::State reached = model_.state();
    if (model_.turns())
      follow_load(reached);
    else
      settle(0, 1), reached = model_.state();
    model_.back_to(std::move(reached));
    return found_;
  }

 private:
  /// Loads and prescribed displacements grow in proportion, in steps as long as Newton's method bears.
  void follow_load(StaticModel::State& reached) {
    double factor = 0, step = 1;
    while (factor < 1) {
      const double next = std::min(1.0, factor + step);
      newton_ = 0;
      if (settle(factor, next)) {
        factor = next, reached = model_.state();
        if (newton_ <= easy_newton) step *= 2;
      } else if (found_.end != Equilibrium::End::found) {
        return;
      } else {
        step = (next - factor) / 4;
        if (step < least_load_step) return lose(factor);
        model_.back_to(reached);
      }
    }
    if (found_.end == Equilibrium::End::found && !is_stable()) say_unstable();
  }

  /// Newton's method: from equilibrium at one factor of loads and prescribed displacements to that at
  /// another. Linear problems take one step, or more where rounding lets the residual that iterations carry
  /// drift.
  bool settle(double from, double to) {
    const double tolerance = to < 1 ? std::max(plan_.tolerance, path_tolerance) : plan_.tolerance;
    double before = std::numeric_limits<double>::infinity();
    load_ = to * full_load_, lost_stiffness_ = false;
    for (;; ++newton_) {
      model_.residual(to, r_);
      lift(newton_ == 0 ? to - from : 0);
      measure();
      if (found_.residual <= tolerance) return true;
      const bool stalls = !(found_.residual < 0.5 * before);
      if (stalls && (!model_.turns() || found_.residual < 1e-6)) say_stalled();
      if (model_.turns() && (newton_ == most_newton || !std::isfinite(found_.residual))) return false;
      if (!goes_on()) return false;
      before = found_.residual;
      const double wanted = model_.turns() ? linear_tolerance * found_.residual : 0;
      if (newton_ == 0 || model_.turns()) set_up_preconditioner();
      const bool solved = solve(std::max(0.5 * tolerance, wanted));
      model_.move(d_);
      if (!solved && !model_.turns()) return false;
    }
  }

  void set_up_preconditioner() {
    model_.show();
    points_.emplace(sim_.model, model_.places());
    blocks_.emplace(sim_.model, model_.places());
  }

  /// d = share · prescribed displacements, r −= K d.
  void lift(double share) {
    bool moves = false;
    for (std::size_t i = 0; i < d_.size(); ++i) moves = (d_[i] = share * prescribed_[i]) != 0 || moves;
    if (!moves) return;
    model_.tangent(d_, q_);
    for (std::size_t i = 0; i < d_.size(); ++i) r_[i] += q_[i];
  }

  void measure() {
    const StaticModel::Norms norms = model_.norms(r_);
    const double scale = std::max(load_, norms.held);
    found_.residual = scale > 0 ? norms.free / scale : norms.free;
  }

  /// K d = r by conjugate gradients, beginning with the d that r knows of; whether the residual got small.
  /// Where a direction has no positive stiffness they end; what they have so far leads downhill.
  bool solve(double wanted) {
    double rz = precondition();
    p_ = z_;
    for (;;) {
      model_.tangent(p_, q_);
      const double stiffness = -dot(p_, q_);
      if (!(stiffness > 0) || !std::isfinite(stiffness)) return say_loose();
      advance(rz / stiffness);
      ++found_.iterations;
      measure();
      if (plan_.progress) plan_.progress(found_.iterations, found_.residual);
      if (found_.residual <= wanted) return true;
      if (!goes_on()) return false;
      const double before = std::exchange(rz, precondition());
      turn(rz / before);
    }
  }

  /// Whether K has no negative stiffness at the state found: conjugate gradients meet it if there is one and
  /// the right side is blind to nothing. Numbers that follow no pattern, smoothed by the preconditioner so
  /// that slow motions count as much as fast ones, times K.
  bool is_stable() {
    model_.residual(1, r_);
    set_up_preconditioner();
    for (std::size_t i = 0; i < r_.size(); ++i) r_[i] = std::fmod(0.6180339887498949 * (i + 1.0), 1) - 0.5;
    precondition();
    model_.tangent(z_, r_);
    std::fill(d_.begin(), d_.end(), 0.0);
    const Equilibrium found = found_;
    measure();
    lost_stiffness_ = false;
    solve(linear_tolerance * found_.residual);
    found_.end = found.end, found_.message = found.message, found_.residual = found.residual;
    return !lost_stiffness_;
  }

  /// z = M⁻¹ r; returns r·z.
  double precondition() {
    points_->solve(r_, z_);
    blocks_->add_solution(r_, z_);
    return dot(r_, z_);
  }

  double dot(const PlaceVector& a, const PlaceVector& b) const {
    return sum<double>(a.size() / 6, [a = a.data(), b = b.data()](std::size_t k) {
      double s = 0;
      for (std::size_t i = 6 * k; i < 6 * k + 6; ++i) s = fma(a[i], b[i], s);
      return s;
    });
  }
  /// d += α p, r −= α K p.
  void advance(double alpha) {
    for_each(
        d_.size(),
        [this, alpha](std::size_t i) {
          d_[i] = fma(alpha, p_[i], d_[i]);
          r_[i] = fma(alpha, q_[i], r_[i]);
        },
        10'000);
  }
  /// p = z + β p.
  void turn(double beta) {
    for_each(
        p_.size(), [this, beta](std::size_t i) { p_[i] = fma(beta, p_[i], z_[i]); }, 10'000);
  }

  bool goes_on() {
    if (found_.end != Equilibrium::End::found) return false;
    if (plan_.stop && *plan_.stop) {
      found_.end = Equilibrium::End::interrupted;
      found_.message = fmt::format("stopped by a signal after {} iterations", found_.iterations);
    } else if (found_.iterations >= plan_.max_iterations) {
      give_up("");
    } else {
      return true;
    }
    return false;
  }
  void give_up(const char* why) {
    found_.end = Equilibrium::End::not_converged;
    found_.message =
        fmt::format("no equilibrium after {} iterations: the residual is {:.2g} of the load, wanted {:.2g}{}",
                    found_.iterations, found_.residual, plan_.tolerance, why);
  }
  void say_stalled() { give_up("; rounding allows no better"); }

  /// With finite rotations the load may have gone too far at once.
  bool say_loose() {
    lost_stiffness_ = true;
    if (model_.turns()) return false;
    found_.end = Equilibrium::End::failed;
    found_.message = fmt::format(
        "no equilibrium: after {} iterations there is a motion that nothing resists; is a part "
        "hinged, or hourglass control switched off?",
        found_.iterations);
    return false;
  }

  void lose(double factor) {
    found_.end = Equilibrium::End::not_converged;
    found_.message = fmt::format(
        "no equilibrium beyond {:.3g} of the loads and prescribed displacements, after {} iterations: {}; "
        "type = \"quasi-static\" shows where the body goes",
        factor, found_.iterations,
        lost_stiffness_ ? "nothing resists some motion there: the body buckles or snaps through, or a part "
                          "is hinged"
                        : "Newton's method does not converge; is an element strained too far?");
  }

  void say_unstable() {
    found_.end = Equilibrium::End::not_converged;
    found_.message =
        "the equilibrium found is not stable: the body buckles before its full load; a small load across "
        "shows where it goes";
  }

  Simulation& sim_;
  const EquilibriumPlan& plan_;
  const double full_load_;
  double load_ = 0;  ///< norm of the loads at the present factor
  StaticModel model_;
  std::optional<PointBlocks> points_;
  std::optional<RigidBlocks> blocks_;
  const PlaceVector prescribed_;
  PlaceVector r_, z_, p_, q_, d_;  ///< d: the step that is looked for
  int newton_ = 0;
  bool lost_stiffness_ = false;  ///< whether the present step met a direction without stiffness
  Equilibrium found_;
};

}  // namespace

Equilibrium find_equilibrium(Simulation& sim, const EquilibriumPlan& plan) {
  const auto timing = sim.timers.time(Phase::equilibrium);
  if (std::string loose = find_free_body(sim.model); !loose.empty())
    return {Equilibrium::End::failed, std::move(loose), 0, 0};
  return Search(sim, plan).run();
}

}  // namespace geist
