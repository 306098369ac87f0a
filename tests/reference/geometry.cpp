// Setting up the reference: positions, masses, pairs.
#include <cmath>
#include <stdexcept>

#include "reference/incremental.hpp"

namespace geist::reference {
namespace {

/// Natural coordinates of the corners: Table 1.
constexpr double table_1[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                  {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

using Corners = std::array<Vec3, 8>;

Corners corners_of(const Description& d, std::size_t e) {
  Corners x;
  for (int I = 0; I < 8; ++I) x[I] = d.nodes[d.hexahedra[e].node[I]];
  return x;
}

/// x(ξ) (7).
Vec3 position(const Corners& x, Vec3 xi) {
  const auto N = shape(xi);
  Vec3 p;
  for (int I = 0; I < 8; ++I) p += N[I] * x[I];
  return p;
}

/// J (10), from the derivatives of (8).
Mat3 jacobian(const Corners& x, Vec3 xi) {
  Mat3 J{};
  for (int I = 0; I < 8; ++I) {
    const double* s = table_1[I];
    const Vec3 a{1 + s[0] * xi.x, 1 + s[1] * xi.y, 1 + s[2] * xi.z};
    const Vec3 dN{0.125 * s[0] * a.y * a.z, 0.125 * s[1] * a.x * a.z, 0.125 * s[2] * a.x * a.y};
    for (int i = 0; i < 3; ++i) J[i] += x[I][i] * dN;
  }
  return J;
}

/// (9)–(12), then one more step so that only rounding is left. Whether p lies inside; xi if so.
bool natural_coordinates(const Corners& x, Vec3 p, Vec3& xi) {
  xi = {};
  for (int k = 0; k < 30; ++k) {
    const Vec3 error = p - position(x, xi);
    const bool last = norm(error) < 1e-7 * norm(x[6] - x[0]);
    xi += inverse(jacobian(x, xi)) * error;
    if (!last) continue;
    for (int c = 0; c < 3; ++c)
      if (std::abs(xi[c]) > 1 + 1e-9) return false;
    return true;
  }
  return false;
}

/// Two unit vectors across n.
void across(Vec3 n, Vec3& s, Vec3& t) {
  const Vec3 other = std::abs(n.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  s = cross(n, other);
  s *= 1 / norm(s);
  t = cross(n, s);
}

}  // namespace

std::array<double, 8> shape(Vec3 xi) {
  std::array<double, 8> N;
  for (int I = 0; I < 8; ++I) {
    const double* s = table_1[I];
    N[I] = 0.125 * (1 + s[0] * xi.x) * (1 + s[1] * xi.y) * (1 + s[2] * xi.z);
  }
  return N;
}

Incremental::Incremental(const Description& description) : description_(description) {
  lump_masses();
  find_particles();
  find_ghosts();
  find_bonds();
}

/// m_I = Σ ρ ∫ N_I dV, by 2 × 2 × 2 Gauss points (exact: N_I det J is at most cubic along each axis).
void Incremental::lump_masses() {
  for (const Vec3 X : description_.nodes) nodes.push_back({.X = X});
  for (std::size_t e = 0; e < description_.hexahedra.size(); ++e) {
    const Corners x = corners_of(description_, e);
    for (const auto& s : table_1) {
      const Vec3 xi = (1 / std::sqrt(3.0)) * Vec3{s[0], s[1], s[2]};
      const auto N = shape(xi);
      const double dm = description_.hexahedra[e].material.density * det(jacobian(x, xi));
      for (int I = 0; I < 8; ++I) nodes[description_.hexahedra[e].node[I]].mass += N[I] * dm;
    }
  }
}

/// Every cube of edge 2r of every box, unless an earlier box has it.
void Incremental::find_particles() {
  const double r = description_.radius, pitch = 2 * r;
  const double mass = description_.lattice_material.density * pitch * pitch * pitch;
  const double inertia = description_.cube_inertia ? mass * pitch * pitch / 6 : 0.4 * mass * r * r;
  const auto known = [&](Vec3 X) {
    for (const Point& p : particles)
      if (norm(p.X - X) < 0.1 * r) return true;
    return false;
  };
  for (const Box& box : description_.lattice)
    for (double z = box.low.z + r; z < box.high.z; z += pitch)
      for (double y = box.low.y + r; y < box.high.y; y += pitch)
        for (double x = box.low.x + r; x < box.high.x; x += pitch)
          if (!known({x, y, z})) particles.push_back({.X = {x, y, z}, .mass = mass, .inertia = inertia});
}

/// A ghost on every free place of the packing, one bond away from a particle, that some hexahedron holds (6).
void Incremental::find_ghosts() {
  const double pitch = 2 * description_.radius;
  const auto taken = [&](Vec3 X, const std::vector<Point>& points) {
    for (const Point& p : points)
      if (norm(p.X - X) < 0.1 * pitch) return true;
    return false;
  };
  for (const Point& particle : particles)
    for (int step = 0; step < 27; ++step) {
      const Vec3 e{double(step % 3 - 1), double(step / 3 % 3 - 1), double(step / 9 - 1)};
      if (dot(e, e) < 0.5 || dot(e, e) > 2.5) continue;  // groups 1 and 2
      const Vec3 X = particle.X + pitch * e;
      if (taken(X, particles) || taken(X, ghosts)) continue;
      for (std::size_t h = 0; h < description_.hexahedra.size(); ++h) {
        Vec3 xi;
        if (!natural_coordinates(corners_of(description_, h), X, xi)) continue;
        ghosts.push_back({.X = X, .inertia = particle.inertia});  // I_g = I_d
        riders.push_back({h, shape(xi)});
        break;
      }
    }
}

/// All pairs whose centres are 2r or 2√2 r apart, except two ghosts.
void Incremental::find_bonds() {
  const double r = description_.radius;
  const Material& m = description_.lattice_material;
  const double k_n = 2 * m.young * r / (5 * (1 - 2 * m.poisson));  // (5)
  const double k_s = 2 * m.young * r * (1 - 4 * m.poisson) / (5 * (1 - 2 * m.poisson) * (1 + m.poisson));
  const auto try_pair = [&](std::size_t i, std::size_t j, const Point& other, bool to_ghost) {
    const Vec3 L = other.X - particles[i].X;
    const double length = norm(L);
    const bool group_1 = std::abs(length - 2 * r) < 0.1 * r;
    const bool group_2 = std::abs(length - 2 * std::sqrt(2.0) * r) < 0.1 * r;
    if (!group_1 && !group_2) return;
    Bond bond{i, j, to_ghost, (1 / length) * L, {}, {}, k_n, k_s, length / 2, {}};
    across(bond.n, bond.s, bond.t);
    bonds.push_back(bond);
  };
  for (std::size_t i = 0; i < particles.size(); ++i) {
    for (std::size_t j = i + 1; j < particles.size(); ++j) try_pair(i, j, particles[j], false);
    for (std::size_t g = 0; g < ghosts.size(); ++g) try_pair(i, g, ghosts[g], true);
  }
}

}  // namespace geist::reference
