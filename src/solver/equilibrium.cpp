#include "solver/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/parallel.hpp"
#include "fe/elements.hpp"
#include "solver/free_bodies.hpp"
#include "solver/nodes.hpp"
#include "solver/places.hpp"
#include "solver/point_blocks.hpp"
#include "solver/rigid_blocks.hpp"

namespace geist {
namespace {

/// Measured: fewer places a block do not pay in iterations, and the matrix of 2000 blocks is factorised in a
/// second.
std::size_t block_size(const Model& model) {
  std::size_t places = model.mesh.nodes();
  for (const Lattice& lattice : model.lattices) places += lattice.count(site::particle);
  return std::max<std::size_t>(100, places / 1000);
}

/// Sums over places.
struct Norms {
  double free = 0, held = 0;
  Norms& operator+=(const Norms& b) { return free += b.free, held += b.held, *this; }
};

/// One search. Vectors have six numbers a place; forces hold reactions (with their sign turned) where
/// components are held.
class Search {
 public:
  Search(Simulation& sim, const EquilibriumPlan& plan)
      : sim_(sim),
        model_(sim.model),
        plan_(plan),
        places_(model_, block_size(model_)),
        points_(model_, places_),
        blocks_(model_, places_),
        x_(6 * places_.size()),
        r_(x_.size()),
        z_(x_.size()),
        p_(x_.size()),
        q_(x_.size()) {}

  Equilibrium run() {
    swap_velocities();
    prescribe();
    double before = std::numeric_limits<double>::infinity();
    for (;;) {  // the residual that iterations carry along drifts by rounding: begin anew until it is true
      find_residual();
      if (found_.residual <= plan_.tolerance) break;
      if (!(found_.residual < 0.5 * before)) stall();
      before = found_.residual;
      if (!goes_on() || !iterate()) break;
    }
    places_.put(x_, model_);
    swap_velocities();
    return found_;
  }

 private:
  /// The lattice kernel leaves forces in the velocities: take those that nobody reads for it.
  void swap_velocities() {
    for (Lattice& lattice : model_.lattices) std::swap(lattice.velocity, lattice.velocity_before);
  }

  void prescribe() {
    for (const HeldComponent& h : sim_.supports.held) {
      const std::int32_t k = h.lattice < 0 ? places_.of_node(h.place) : places_.of_site(h.lattice, h.place);
      x_[6 * k + h.component] = sim_.supports.motions[h.motion].displacement(model_.time);
    }
  }

  /// −K x into mesh.f, velocities of unit kicks and listed forces: the kernels of a step.
  void find_forces(const PlaceVector& x) {
    places_.put(x, model_);
    fe::internal_forces(model_.mesh);
    const de::Kick unit{.keep = 0, .per_mass = 1, .per_inertia = 1, .gravity = {}};
    for (Lattice& lattice : model_.lattices) de::bond_forces_and_kick(lattice, unit);
    gather_internal_forces(model_.mesh);
    sim_.reactions.add(model_);
  }

  /// r = f − K x.
  void find_residual() {
    find_forces(x_);
    add_loads(sim_.loads, model_, model_.time);
    places_.take(model_, r_);
    const Vec3 g = gravity(sim_.loads, model_.time);
    for_each(places_.size(), [this, g](std::size_t k) {
      for (int c = 0; c < 3; ++c) r_[6 * k + c] += mass(k) * g[c];
    });
    load_ = norm(sim_.loads, model_, model_.time);
    measure();
  }

  /// Of what carries loads: not of ghosts.
  double mass(std::size_t k) const {
    const Place& place = places_[k];
    if (place.lattice < 0) return model_.mesh.mass[place.index];
    const Lattice& lattice = model_.lattices[place.lattice];
    return lattice.is(place.index, site::particle) ? lattice.mass : 0;
  }

  /// As Simulation::residual().
  void measure() {
    const Norms norms = sum<Norms>(places_.size(), [this](std::size_t k) {
      const Place& place = places_[k];
      const double arm = place.lattice < 0 ? 1 : model_.lattices[place.lattice].radius();
      Norms n;
      for (int c = 0; c < 6; ++c) {
        const double f = c < 3 ? r_[6 * k + c] : r_[6 * k + c] / arm;
        if (place.free >> c & 1) n.free += f * f;
        if (c < 3 && place.held >> c & 1) n.held += f * f;
      }
      return n;
    });
    const double scale = std::max(load_, std::sqrt(norms.held));
    found_.residual = scale > 0 ? std::sqrt(norms.free) / scale : std::sqrt(norms.free);
  }

  /// Conjugate gradients from x on; whether the residual got small.
  bool iterate() {
    double rz = precondition();
    p_ = z_;
    for (;;) {
      find_forces(p_);
      places_.take(model_, q_);  // −K p
      const double stiffness = -dot(p_, q_);
      if (!(stiffness > 0) || !std::isfinite(stiffness)) return fail();
      advance(rz / stiffness);
      ++found_.iterations;
      measure();
      if (plan_.progress) plan_.progress(found_.iterations, found_.residual);
      if (found_.residual <= 0.5 * plan_.tolerance) return true;
      if (!goes_on()) return false;
      const double before = std::exchange(rz, precondition());
      turn(rz / before);
    }
  }

  /// z = M⁻¹ r; returns r·z.
  double precondition() {
    points_.solve(r_, z_);
    blocks_.add_solution(r_, z_);
    return dot(r_, z_);
  }

  double dot(const PlaceVector& a, const PlaceVector& b) const {
    return sum<double>(places_.size(), [a = a.data(), b = b.data()](std::size_t k) {
      double s = 0;
      for (std::size_t i = 6 * k; i < 6 * k + 6; ++i) s = fma(a[i], b[i], s);
      return s;
    });
  }
  /// x += α p, r −= α K p.
  void advance(double alpha) {
    for_each(
        x_.size(),
        [this, alpha](std::size_t i) {
          x_[i] = fma(alpha, p_[i], x_[i]);
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
  void stall() { give_up("; rounding allows no better"); }
  void give_up(const char* why) {
    found_.end = Equilibrium::End::not_converged;
    found_.message =
        fmt::format("no equilibrium after {} iterations: the residual is {:.2g} of the load, wanted {:.2g}{}",
                    found_.iterations, found_.residual, plan_.tolerance, why);
  }
  bool fail() {
    found_.end = Equilibrium::End::failed;
    found_.message = fmt::format(
        "no equilibrium: after {} iterations there is a motion that nothing resists; is a part "
        "hinged, or hourglass control switched off?",
        found_.iterations);
    return false;
  }

  Simulation& sim_;
  Model& model_;
  const EquilibriumPlan& plan_;
  const Places places_;
  const PointBlocks points_;
  const RigidBlocks blocks_;
  PlaceVector x_, r_, z_, p_, q_;
  double load_ = 0;
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
