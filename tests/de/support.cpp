#include "de/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "de/assembly.hpp"

namespace geist::de::testing {
namespace {

void fill_at_random(const Lattice& lattice, Field<6>& field, int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  for (std::size_t s = 0; s < lattice.grid.size(); ++s)
    for (int c = 0; c < 6; ++c) field[c][s] = lattice.word[s] ? number(random) : 0;
}

/// The pairs that are bonded, each once.
std::vector<std::array<std::size_t, 2>> bonded_pairs(const Lattice& lattice) {
  std::vector<std::array<std::size_t, 2>> pairs;
  const double r = lattice.radius();
  for (std::size_t i = 0; i < lattice.grid.size(); ++i)
    for (std::size_t j = i + 1; j < lattice.grid.size(); ++j) {
      const auto occupied = [&](std::size_t s) { return lattice.is(s, site::particle | site::ghost); };
      if (!occupied(i) || !occupied(j)) continue;
      if (!lattice.is(i, site::particle) && !lattice.is(j, site::particle)) continue;
      const double distance = norm(lattice.grid.centre(j) - lattice.grid.centre(i));
      if (std::abs(distance - 2 * r) < 1e-6 * r || std::abs(distance - 2 * std::sqrt(2.0) * r) < 1e-6 * r)
        pairs.push_back({i, j});
    }
  return pairs;
}

}  // namespace

Lattice make_lattice(const std::array<int, 3>& n, const Kind& kind) {
  Lattice lattice;
  lattice.material = {"stone", 2.5, 30, 0.2};
  lattice.grid = {n[0], n[1], n[2], {0.4, -1, 0.2}, 0.5};
  lattice.mass = 2.5 * 0.125, lattice.inertia = 0.4 * lattice.mass * 0.0625;
  lattice.word.assign(lattice.grid.size(), 0);
  std::vector<std::size_t> acted_on;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        const std::size_t s = lattice.grid.index(i, j, k);
        const std::uint32_t word = kind(i, j, k);
        lattice.word[s] = word == site::particle ? free_particle : word;
        if (word == site::particle) acted_on.push_back(s);
        if (word == site::ghost) lattice.ghosts.push_back({s, 0, {}, {}});
      }
  connect(lattice), finish(lattice);
  list_sites(lattice, acted_on);
  return lattice;
}

Lattice full_lattice(const std::array<int, 3>& n) {
  return make_lattice(n, [](int, int, int) { return free_particle; });
}

Lattice random_lattice(const std::array<int, 3>& n, int seed) {
  std::mt19937 random(seed);
  std::discrete_distribution<int> draw{2, 9, 2, 2};
  const std::uint32_t kinds[] = {0, free_particle, site::particle, site::ghost};
  return make_lattice(n, [&](int, int, int) { return kinds[draw(random)]; });
}

void move_at_random(Lattice& lattice, int seed) { fill_at_random(lattice, lattice.motion, seed); }
void push_at_random(Lattice& lattice, int seed) { fill_at_random(lattice, lattice.velocity, seed); }

Mat3 operator*(const Mat3& a, const Mat3& b) {
  Mat3 product;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) product[i] += a[i][k] * b[k];
  return product;
}

Mat3 rotation_by(Vec3 theta) {
  const double angle = norm(theta);
  Mat3 R{{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}};
  if (angle == 0) return R;
  const Vec3 n = (1 / angle) * theta;
  const Mat3 K{{Vec3{0, -n.z, n.y}, Vec3{n.z, 0, -n.x}, Vec3{-n.y, n.x, 0}}}, K2 = K * K;
  for (std::size_t i = 0; i < 3; ++i) R[i] += std::sin(angle) * K[i] + (1 - std::cos(angle)) * K2[i];
  return R;
}

Lattice small(Lattice lattice, bool consistent) {
  if (consistent) assemble(lattice);
  finish(lattice);
  return lattice;
}

Lattice dilating(const std::array<int, 3>& n) {
  Lattice lattice = full_lattice(n);
  lattice.material.poisson = 0.35;
  return small(std::move(lattice), true);
}

Lattice finite(Lattice lattice, bool consistent) {
  lattice.kinematics = Kinematics::finite;
  return small(std::move(lattice), consistent);
}

void set_rotation(Lattice& lattice, std::size_t s, const Mat3& R) {
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t a = 0; a < 3; ++a)
      lattice.rotation[static_cast<int>(3 * c + a)][s] = R[a][c] - (a == c ? 1 : 0);
}

void turn_at_random(Lattice& lattice, int seed, double amount) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&] { return Vec3{number(random), number(random), number(random)}; };
  const Mat3 all = rotation_by(2.0 * vector());
  for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
    if (!lattice.word[s]) continue;
    const Vec3 X = lattice.grid.centre(s), u = amount * lattice.radius() * vector();
    lattice.motion.set(s, all * (X + u) - X);
    set_rotation(lattice, s, all * rotation_by(amount * vector()));
  }
}

double Loads6::largest() const {
  double most = 0;
  for (const Vec3 f : force) most = std::max(most, norm(f));
  for (const Vec3 m : moment) most = std::max(most, norm(m));
  return most;
}

std::string name_of(const ::testing::TestParamInfo<Method>& is) {
  return std::string(is.param.consistent ? "consistent" : "published") +
         (is.param.finite ? "_finite" : "_small");
}

Lattice moving(Method method, const std::array<int, 3>& n) {
  Lattice lattice = method.finite ? finite(random_lattice(n, 21), method.consistent)
                                  : small(random_lattice(n, 21), method.consistent);
  method.finite ? turn_at_random(lattice, 22, 0.5) : move_at_random(lattice, 22);
  push_at_random(lattice, 23);
  return lattice;
}

KickSums sums_of_free(const Lattice& before, const Lattice& after) {
  KickSums sums;
  for (std::size_t s = 0; s < after.grid.size(); ++s)
    for (int c = 0; c < 6 && after.is(s, site::free); ++c) {
      const double v = before.velocity[c][s], w = after.velocity[c][s];
      (c < 3 ? sums.across : sums.spin_across) += v * w;
      (c < 3 ? sums.after : sums.spin_after) += w * w;
    }
  return sums;
}

Literal literal(const Lattice& lattice) {
  const std::size_t n = lattice.grid.size();
  const double E = lattice.material.young, nu = lattice.material.poisson, r = lattice.radius();
  const double k_n = 2 * E * r / (5 * (1 - 2 * nu));
  const double k_s = 2 * E * r * (1 - 4 * nu) / (5 * (1 - 2 * nu) * (1 + nu));
  Literal result{{std::vector<Vec3>(n), std::vector<Vec3>(n)}, 0, 0, std::vector<double>(n), 0};
  for (const auto& [i, j] : bonded_pairs(lattice)) {
    const Vec3 x_i = lattice.grid.centre(i), x_j = lattice.grid.centre(j), c = 0.5 * (x_i + x_j);
    const Vec3 normal = (1 / norm(x_j - x_i)) * (x_j - x_i);
    const auto carried = [&](std::size_t s, Vec3 x) {
      return lattice.motion.vector(s) + cross(lattice.motion.vector(s, 3), c - x);
    };
    const Vec3 d = carried(j, x_j) - carried(i, x_i), d_n = dot(d, normal) * normal, d_t = d - d_n;
    const Vec3 f = k_n * d_n + k_s * d_t;
    result.on.force[i] += f, result.on.force[j] -= f;
    result.on.moment[i] += cross(c - x_i, f), result.on.moment[j] -= cross(c - x_j, f);
    const double energy = 0.5 * (k_n * dot(d_n, d_n) + k_s * dot(d_t, d_t));
    const bool ghost = lattice.is(i, site::ghost) || lattice.is(j, site::ghost);
    (ghost ? result.coupling : result.bonds) += energy;
    result.energy[i] += energy / 2, result.energy[j] += energy / 2;
    ++result.bond_count;
  }
  return result;
}

Loads6 kernel_forces(Lattice& lattice) {
  const std::size_t n = lattice.grid.size();
  bond_forces_and_kick(lattice, Kick{0, 1, 1, {}});  // v⁺ = f
  Loads6 found{std::vector<Vec3>(n), std::vector<Vec3>(n)};
  for (std::size_t s = 0; s < n; ++s)
    if (lattice.is(s, site::free))
      found.force[s] = lattice.velocity.vector(s), found.moment[s] = lattice.velocity.vector(s, 3);
  for (std::size_t slot = 0; slot < lattice.listed.size(); ++slot) {
    found.force[lattice.listed[slot]] = lattice.listed_force.vector(slot);
    found.moment[lattice.listed[slot]] = lattice.listed_force.vector(slot, 3);
  }
  return found;
}

void expect_forces_of_the_energy(Lattice lattice) {
  move_at_random(lattice, 32);
  const Loads6 f = kernel_forces(lattice);
  const auto energy = [&] {
    const BondEnergies e = energies(lattice);
    return e.bonds + e.coupling;
  };
  const double total = energy(),
               h = 0.25;  // the energy is quadratic: differences are exact but for rounding
  for (std::size_t s = 0; s < lattice.grid.size(); ++s)
    for (int c = 0; lattice.word[s] && c < 6; ++c) {
      double& q = lattice.motion[c][s];
      const double here = q;
      q = here + h;
      const double up = energy();
      q = here - h;
      const double down = energy();
      q = here;
      EXPECT_NEAR(c < 3 ? f.force[s][c] : f.moment[s][c - 3], -(up - down) / (2 * h), 1e-13 * total / h);
    }
}

}  // namespace geist::de::testing
