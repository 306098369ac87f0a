#include "solver/supports.hpp"

#include <cmath>

#include "core/parallel.hpp"

namespace geist {
namespace {

double& velocity_of(Model& model, const HeldComponent& h) {
  return h.lattice < 0 ? model.mesh.v[h.component][h.place]
                       : model.lattices[h.lattice].velocity[h.component][h.place];
}

double displacement_of(const Model& model, const HeldComponent& h) {
  return h.lattice < 0 ? model.mesh.u[h.component][h.place]
                       : model.lattices[h.lattice].motion[h.component][h.place];
}

double force_on(const Model& model, const HeldComponent& h) {
  return h.lattice < 0 ? model.mesh.f[h.component][h.place]
                       : model.lattices[h.lattice].listed_force[h.component][h.slot];
}

double mass_of(const Model& model, const HeldComponent& h) {
  if (h.lattice < 0) return model.mesh.mass[h.place];
  const Lattice& lattice = model.lattices[h.lattice];
  return h.component < 3 ? lattice.mass : lattice.inertia;
}

}  // namespace

double Motion::velocity(double t, double dt) const {
  switch (kind) {
    case Kind::displacement:
      return factor * (curve.at(t + dt) - curve.at(t)) / dt;
    case Kind::velocity:
      return factor * curve.at(t + dt / 2);
    case Kind::held:
      return 0;
  }
  return 0;
}

double Motion::displacement(double t) const { return kind == Kind::displacement ? factor * curve.at(t) : 0; }

void Supports::apply(Model& model, double dt, Vec3 gravity, bool arrived) {
  velocities.resize(motions.size());
  for (std::size_t m = 0; m < motions.size(); ++m) velocities[m] = motions[m].velocity(model.time, dt);
  const double done = sum<double, 64>(held.size(), [this, &model, dt, gravity](std::size_t i) {
    HeldComponent& h = held[i];
    const double after = velocities[h.motion], before = h.velocity;
    const double acceleration = (after - before) / dt - (h.component < 3 ? gravity[h.component] : 0);
    const double reaction = mass_of(model, h) * acceleration - force_on(model, h);
    const double work_of_step = 0.5 * (h.reaction + reaction) * before * dt;
    h.reaction = reaction, h.velocity = after;
    velocity_of(model, h) = after;
    return work_of_step;
  });
  if (arrived) work += done;
}

void Supports::halt(Model& model) {
  for (HeldComponent& h : held) velocity_of(model, h) = h.velocity = 0;
}

void Supports::reckon_proportional(const Model& model) {
  work = 0;
  for (const HeldComponent& h : held) work += 0.5 * h.reaction * displacement_of(model, h);
}

double Supports::reaction_norm() const {
  double squares = 0;
  for (const HeldComponent& h : held)
    if (h.component < 3) squares += h.reaction * h.reaction;
  return std::sqrt(squares);
}

}  // namespace geist
