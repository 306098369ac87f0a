#include "solver/static_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/parallel.hpp"
#include "de/rotation.hpp"
#include "fe/elements.hpp"

namespace geist {
namespace {

constexpr std::size_t grain = 2000;

/// Edge of the smallest element (along its axes) or pitch of the finest lattice.
double smallest_length(const Model& model) {
  double least = std::numeric_limits<double>::infinity();
  for (const Lattice& lattice : model.lattices) least = std::min(least, lattice.grid.pitch);
  for (const auto& corners : model.mesh.elements)
    for (const int a : {1, 3, 4})
      least = std::min(least, norm(model.mesh.points[corners[a]] - model.mesh.points[corners[0]]));
  return least;
}

struct Largest {
  double value = 0;
  Largest& operator+=(Largest b) { return value = std::max(value, b.value), *this; }
};

Vec3 part(const PlaceVector& p, std::size_t k, int first) {
  return {p[6 * k + first], p[6 * k + first + 1], p[6 * k + first + 2]};
}

}  // namespace

StaticModel::StaticModel(Simulation& sim, std::size_t block_size)
    : sim_(sim),
      model_(sim.model),
      places_(model_, block_size),
      turns_(turns_finitely(model_)),
      length_(smallest_length(model_)),
      load_(6 * places_.size()),
      x_(load_.size()),
      rotation_(turns_ ? 9 * places_.size() : 0),
      present_(load_.size()),
      other_(turns_ ? load_.size() : 0),
      internal_(load_.size()) {
  swap_velocities();
  add_loads();
}

/// The lattice kernel leaves forces in the velocities: take those that nobody reads for it.
void StaticModel::swap_velocities() {
  for (Lattice& lattice : model_.lattices) std::swap(lattice.velocity, lattice.velocity_before);
}

void StaticModel::add_loads() {
  const auto add = [this](std::int32_t k, Vec3 force) {
    for (int c = 0; c < 3; ++c) load_[6 * k + c] += force[c];
  };
  for (const Load& load : sim_.loads) {
    const double c = load.curve.at(model_.time);
    for (const NodeForce& p : load.nodes) add(places_.of_node(p.node), c * p.force);
    for (const ParticleForce& p : load.particles) add(places_.of_site(p.lattice, p.site), c * p.force);
  }
  const Vec3 g = gravity(sim_.loads, model_.time);
  for (std::size_t k = 0; k < places_.size(); ++k) {  // ghosts carry nothing
    const Place& place = places_[k];
    if (place.lattice < 0)
      add(k, model_.mesh.mass[place.index] * g);
    else if (const Lattice& lattice = model_.lattices[place.lattice]; lattice.is(place.index, site::particle))
      add(k, lattice.mass * g);
  }
}

PlaceVector StaticModel::prescribed() const {
  PlaceVector x(x_.size());
  for (const HeldComponent& h : sim_.supports.held) {
    const std::int32_t k = h.lattice < 0 ? places_.of_node(h.place) : places_.of_site(h.lattice, h.place);
    x[6 * k + h.component] = sim_.supports.motions[h.motion].displacement(model_.time);
  }
  return x;
}

/// Finite rotations about one axis add up, and that of the rotation vector is fixed while it grows. A single
/// component says nothing: what the others do meanwhile changes it.
std::string StaticModel::refusal(const PlaceVector& prescribed) const {
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const Place& place = places_[k];
    if (place.lattice < 0 || model_.lattices[place.lattice].kinematics == Kinematics::small) continue;
    if (norm(part(prescribed, k, 3)) == 0 || place.held >> 3 == 0b111) continue;
    return fmt::format(
        "region '{}' at ({:.6g}, {:.6g}, {:.6g}): finite rotations are prescribed with all of rx, ry and rz, "
        "or fixed for those that stay zero",
        model_.lattices[place.lattice].name, place.X.x, place.X.y, place.X.z);
  }
  return {};
}

void StaticModel::residual(double factor, PlaceVector& r) {
  show();
  find_forces(internal_);
  for_each(
      r.size(), [=, this, r = r.data()](std::size_t i) { r[i] = fma(factor, load_[i], internal_[i]); },
      10'000);
}

/// Small displacements: the force of the displacement p. Finite ones: central differences along p,
///
///   q = (f(x + h p) − f(x − h p)) / 2h
///
/// whose error is (h p)² by what they leave out and u/(h p) by rounding, u = 10⁻¹⁶; h makes the largest
/// rotation, or displacement by an element's edge, near u^⅓.
///
/// The derivative of moments about spins is not symmetric: with the energy's second derivative H along
/// R = exp(θ×) R_0 it is dm = −H θ + ½ θ × m, as spins do not commute. The part with m vanishes at rest
/// and is taken out, so that K is symmetric (Simo and Vu-Quoc, CMAME 58 (1986) 79–116).
void StaticModel::tangent(const PlaceVector& p, PlaceVector& q) {
  if (!turns_) {
    places_.put(p, model_);
    return find_forces(q);
  }
  constexpr double step = 2e-5;
  const double size = largest(p, length_), h = size > 0 ? step / size : 1;
  show(p, h), find_forces(q);
  show(p, -h), find_forces(other_);
  for_each(
      places_.size(),
      [&, h](std::size_t k) {
        for (std::size_t i = 6 * k; i < 6 * k + 6; ++i) q[i] = (q[i] - other_[i]) / (2 * h);
        const Place& place = places_[k];
        if (place.lattice < 0 || model_.lattices[place.lattice].kinematics != Kinematics::finite) return;
        const Vec3 skew = 0.5 * cross(part(p, k, 3), part(internal_, k, 3));
        for (int c = 0; c < 3; ++c) q[6 * k + 3 + c] -= skew[c];
      },
      grain);
}

void StaticModel::move(const PlaceVector& p) {
  if (turns_) show(p, 1);
  for_each(
      places_.size(),
      [this, &p](std::size_t k) {
        for (std::size_t i = 6 * k; i < 6 * k + 6; ++i) x_[i] += p[i];
        const Place& place = places_[k];
        if (!turns_ || place.lattice < 0) return;
        const Lattice& lattice = model_.lattices[place.lattice];
        if (lattice.kinematics != Kinematics::finite) return;
        for (int c = 0; c < 9; ++c) rotation_[9 * k + c] = lattice.rotation[c][place.index];
      },
      grain);
}

void StaticModel::back_to(State state) {
  x_ = std::move(state.x), rotation_ = std::move(state.rotation);
  for (Lattice& lattice : model_.lattices)  // kicks forget numbers only
    for (int c = 0; c < 6; ++c) std::fill_n(lattice.velocity[c], lattice.velocity.size(), 0.0);
  show();
}

void StaticModel::show() {
  if (turns_)
    show(x_, 0);
  else
    places_.put(x_, model_);
}

/// The model at the present state moved by factor · p.
void StaticModel::show(const PlaceVector& p, double factor) {
  for (std::size_t l = 0; l < model_.lattices.size(); ++l)
    if (model_.lattices[l].kinematics == Kinematics::finite)
      turn(model_.lattices[l], static_cast<std::int32_t>(l), p, factor);
  for_each(
      x_.size(),
      [=, from = x_.data(), along = p.data(), to = present_.data()](std::size_t i) {
        to[i] = fma(factor, along[i], from[i]);
      },
      10'000);
  places_.put(present_, model_);
}

/// In as many turns as keep exp(ψ×) exact: de/drift.hpp.
void StaticModel::turn(Lattice& lattice, std::int32_t l, const PlaceVector& p, double factor) {
  for_each(
      places_.size(),
      [&, l](std::size_t k) {
        if (places_[k].lattice != l) return;
        const std::size_t s = places_[k].index;
        for (int c = 0; c < 9; ++c) lattice.rotation[c][s] = rotation_[9 * k + c];
        lattice.velocity.set(s, part(p, k, 3), 3);
      },
      grain);
  if (factor == 0) return;
  const double angle = std::abs(factor) * largest(p, std::numeric_limits<double>::infinity());
  const int turns = std::max(1, static_cast<int>(std::ceil(angle / 0.03)));
  for (int n = 0; n < turns; ++n) de::turn(lattice, factor / turns);
}

/// Largest displacement by that length, or rotation of lattices with finite ones.
double StaticModel::largest(const PlaceVector& p, double length) const {
  return sum<Largest>(places_.size(),
                      [&p, length](std::size_t k) {
                        return Largest{std::max(norm(part(p, k, 0)) / length, norm(part(p, k, 3)))};
                      })
      .value;
}

void StaticModel::find_forces(PlaceVector& f) {
  fe::internal_forces(model_.mesh);
  const de::Kick unit{.keep = 0, .per_mass = 1, .per_inertia = 1, .gravity = {}};
  for (Lattice& lattice : model_.lattices) de::bond_forces_and_kick(lattice, unit);
  sim_.reactions.add(model_);
  places_.take(model_, f);
}

/// As Simulation::residual().
StaticModel::Norms StaticModel::norms(const PlaceVector& r) const {
  Norms norms = sum<Norms>(places_.size(), [this, &r](std::size_t k) {
    const Place& place = places_[k];
    const double arm = place.lattice < 0 ? 1 : model_.lattices[place.lattice].radius();
    Norms n;
    for (int c = 0; c < 6; ++c) {
      const double f = c < 3 ? r[6 * k + c] : r[6 * k + c] / arm;
      if (place.free >> c & 1) n.free += f * f;
      if (c < 3 && place.held >> c & 1) n.held += f * f;
    }
    return n;
  });
  return {std::sqrt(norms.free), std::sqrt(norms.held)};
}

}  // namespace geist
