// Stepping the reference.
#include "reference/incremental.hpp"

#include "fe/formulations.hpp"

namespace geist::reference {

/// (15)–(18); at the end of a step the same formulas are (24)–(27).
void Incremental::half_kick(double dt) {
  for (std::vector<Point>* points : {&nodes, &particles, &ghosts})
    for (Point& p : *points) {
      if (p.held) {
        p.v = p.omega = {};
        continue;
      }
      if (p.mass > 0) p.v += (0.5 * dt / p.mass) * p.f;
      if (p.inertia > 0) p.omega += (0.5 * dt / p.inertia) * p.m;
    }
  if (!description_.ghosts_spin)
    for (Point& g : ghosts) g.omega = {};
}

void Incremental::step(double dt) {
  half_kick(dt);
  move(dt);
  half_kick(dt);
}

/// The first term of (21).
Vec3 Incremental::ghost_velocity(std::size_t g) const {
  Vec3 v;
  for (int I = 0; I < 8; ++I)
    v += riders[g].N[I] * nodes[description_.hexahedra[riders[g].hexahedron].node[I]].v;
  return v;
}

void Incremental::move(double dt) {
  for (std::size_t g = 0; g < ghosts.size(); ++g) ghosts[g].v = ghost_velocity(g);
  for (Bond& b : bonds) {
    const Point &p = particles[b.i], &q = b.to_ghost ? ghosts[b.j] : particles[b.j];
    const Vec3 v_i = p.v + cross(p.omega, b.half_length * b.n);  // (20)
    const Vec3 v_j = q.v - cross(q.omega, b.half_length * b.n);  // (20), (21)
    const Vec3 v = v_j - v_i;                                    // (19)
    b.d += dt * Vec3{dot(b.n, v), dot(b.s, v), dot(b.t, v)};     // (22), (23)
  }
  for (std::vector<Point>* points : {&nodes, &particles, &ghosts})
    for (Point& p : *points) p.u += dt * p.v, p.theta += dt * p.omega;
  forces();
}

void Incremental::forces() {
  for (std::vector<Point>* points : {&nodes, &particles, &ghosts})
    for (Point& p : *points) p.f = p.load, p.m = {};
  element_forces();
  bond_forces();
  for (std::size_t g = 0; g < ghosts.size(); ++g)
    for (int I = 0; I < 8; ++I)
      nodes[description_.hexahedra[riders[g].hexahedron].node[I]].f += riders[g].N[I] * ghosts[g].f;  // (14)
}

void Incremental::bond_forces() {
  for (const Bond& b : bonds) {
    Point &p = particles[b.i], &q = b.to_ghost ? ghosts[b.j] : particles[b.j];
    const Vec3 f = (b.k_n * b.d.x) * b.n + (b.k_s * b.d.y) * b.s + (b.k_s * b.d.z) * b.t;  // (3), (4)
    p.f += f, q.f -= f;
    p.m += cross(b.half_length * b.n, f);    // (13)
    q.m += cross(-b.half_length * b.n, -f);  // the mechanical moment, also on a ghost
  }
}

/// f_I^int of (1), element by element.
void Incremental::element_forces() {
  for (const auto& h : description_.hexahedra) {
    fe::Corners<double> X, u, v, f;
    for (int I = 0; I < 8; ++I)
      for (int c = 0; c < 3; ++c) {
        const Point& node = nodes[h.node[I]];
        X[I][c] = node.X[c], u[I][c] = node.u[c], v[I][c] = node.v[c];
      }
    const fe::Parameters parameters{h.material.lambda(), h.material.mu(), h.material.density,
                                    h.hourglass_coefficient};
    fe::visit_formulation(h.formulation, parameters,
                          [&](const auto& formulation) { formulation.forces(X, u, v, f); });
    for (int I = 0; I < 8; ++I)
      for (int c = 0; c < 3; ++c) nodes[h.node[I]].f[c] += f[I][c];
  }
}

double Incremental::bond_energy() const {
  double energy = 0;
  for (const Bond& b : bonds)
    energy += 0.5 * (b.k_n * b.d.x * b.d.x + b.k_s * (b.d.y * b.d.y + b.d.z * b.d.z));
  return energy;
}

}  // namespace geist::reference
