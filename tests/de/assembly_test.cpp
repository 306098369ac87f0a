// The consistent lattice: bonds against a literal assembly, and states that must be exact.
#include "de/assembly.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "core/parallel.hpp"
#include "de/bonds.hpp"
#include "de/dilatation.hpp"
#include "de/stencil.hpp"
#include "de/support.hpp"

namespace geist::de {
namespace {

using namespace testing;
using Place = std::array<int, 3>;

Place operator+(Place a, Place b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

Lattice consistent(Lattice lattice) {
  assemble(lattice);
  return lattice;
}

/// Free particles where `in` says so.
Lattice consistent_body(const Place& n, const std::function<bool(int, int, int)>& in) {
  return consistent(make_lattice(n, [&](int i, int j, int k) { return in(i, j, k) ? free_particle : 0u; }));
}

Lattice consistent_box(const Place& n) { return consistent(full_lattice(n)); }

/// The recipe as it is said: every cube, face and edge between occupied sites gives its share to pairs.
class Recipe {
 public:
  struct Springs {
    double k_n = 0, k_s = 0;
  };

  explicit Recipe(const Lattice& lattice) : lattice_(lattice) {
    const Grid& g = lattice.grid;
    for (int k = -1; k <= g.nz; ++k)
      for (int j = -1; j <= g.ny; ++j)
        for (int i = -1; i <= g.nx; ++i) add_cube({i, j, k});
  }

  /// Forces, as the literal law has them, with bonds that bend, and cubes and squares that resist dilatation.
  Loads6 forces(BondEnergies& energy) const {
    Loads6 on{std::vector<Vec3>(lattice_.grid.size()), std::vector<Vec3>(lattice_.grid.size())};
    energy = {};
    for (const auto& [pair, springs] : springs_) add_force(pair[0], pair[1], springs, on, energy);
    for (const Swollen& body : swollen_) add_dilatation(body, on, energy);
    return on;
  }

 private:
  bool occupied(Place p) const {
    const Grid& g = lattice_.grid;
    return g.contains(p[0], p[1], p[2]) && lattice_.word[g.index(p[0], p[1], p[2])] != 0;
  }
  double E() const { return lattice_.material.young; }
  double nu() const { return lattice_.material.poisson; }
  double mu() const { return E() / (2 * (1 + nu())); }
  /// What bonds take of ν.
  double bond_nu() const { return nu() > 0.25 ? 0.15 : nu(); }
  double bond_E() const { return 2 * mu() * (1 + bond_nu()); }
  double r() const { return lattice_.radius(); }

  void give(Place a, Place b, double k_n, double k_s) {
    if (!occupied(a) || !occupied(b)) return;
    Springs& springs = springs_[{std::min(a, b), std::max(a, b)}];
    springs.k_n += k_n, springs.k_s += k_s;
  }

  bool particle(Place p) const {
    const Grid& g = lattice_.grid;
    return occupied(p) && lattice_.is(g.index(p[0], p[1], p[2]), site::particle);
  }

  void add_cube(Place p) {
    bool cell = true, counts = false;  // ghosts alone are nothing
    for (int c = 0; c < 8; ++c) {
      const Place corner = p + Place{c & 1, c >> 1 & 1, c >> 2};
      cell = cell && occupied(corner), counts = counts || particle(corner);
    }
    if (!counts) return;
    const double E = bond_E(), nu = bond_nu(), lambda = 2 * mu() * nu / (1 - 2 * nu);
    const double plane = E * nu / (1 - nu * nu);
    if (cell) add_swollen(p, 3, 2 * mu() * this->nu() / (1 - 2 * this->nu()) - lambda);
    std::map<std::array<Place, 2>, int> skins;  // on every edge
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        Place at = p, a{}, b{};
        at[axis] += side, a[(axis + 1) % 3] = 1, b[(axis + 2) % 3] = 1;
        const std::array<std::array<Place, 2>, 4> sides{
            {{at, at + a}, {at + b, at + b + a}, {at, at + b}, {at + a, at + a + b}}};
        const std::array<std::array<Place, 2>, 2> diagonals{{{at, at + a + b}, {at + a, at + b}}};
        const bool square = occupied(at) && occupied(at + a) && occupied(at + b) && occupied(at + a + b);
        for (const auto& [x, y] : sides) {
          if (cell)  // a quarter of a bond; a cell's edge is a side of two of its faces
            give(x, y, r() * (2 * mu() - lambda) / 4, r() * (mu() - lambda) / 2);
          if (!cell && square)
            give(x, y, r() * E / (1 + nu) / 2, r() * E * (1 - 3 * nu) / ((1 + nu) * (1 - nu)) / 2);
          skins[{x, y}] += square;
        }
        for (const auto& [x, y] : diagonals) {
          if (cell) give(x, y, r() * lambda, 0);  // half a bond
          if (!cell && square) give(x, y, r() * plane, 0);
        }
        if (!cell && square)
          add_swollen(at, axis, this->E() * this->nu() / (1 - this->nu() * this->nu()) - plane);
      }
    const double beam_shear = 5.0 / 6 * mu() * r() / 2;
    for (const auto& [edge, n] : skins)
      if (!cell) give(edge[0], edge[1], (1 - n) * this->E() * r() / 2, n == 0 ? beam_shear : 0);
  }

  /// A cell (across = 3), or a skin across an axis, r thick: its corners and what is left of λ.
  struct Swollen {
    std::vector<Place> corners;
    std::vector<Vec3> outwards;  ///< areas of its sides that lie at each corner
    double lambda, volume;
  };

  void add_swollen(Place low, std::size_t across, double lambda) {
    if (std::abs(lambda) < 1e-12 * E()) return;
    const double thickness = across == 3 ? 2 * r() : r();
    Swollen body{{}, {}, lambda, 4 * r() * r() * thickness};
    for (int a = 0; a < 8; ++a) {
      const Place step{a & 1, a >> 1 & 1, a >> 2};
      if (across < 3 && step[across] == 1) continue;
      Vec3 area;  // a quarter of each face of the cube; half of each side of the square
      for (std::size_t c = 0; c < 3; ++c)
        if (c != across)
          area[static_cast<int>(c)] = (step[c] ? 1 : -1) * (across == 3 ? r() * r() : r() * thickness);
      body.corners.push_back(low + step), body.outwards.push_back(area);
    }
    swollen_.push_back(body);
  }

  /// θ = 1/V ∮ u·n dA, E = ½ λ V θ².
  void add_dilatation(const Swollen& body, Loads6& on, BondEnergies& energy) const {
    double change = 0;
    bool coupling = false;
    const auto site = [&](std::size_t a) {
      return lattice_.grid.index(body.corners[a][0], body.corners[a][1], body.corners[a][2]);
    };
    for (std::size_t a = 0; a < body.corners.size(); ++a) {
      change += dot(body.outwards[a], lattice_.motion.vector(site(a)));
      coupling = coupling || lattice_.is(site(a), site::ghost);
    }
    const double stress = body.lambda * change / body.volume;
    for (std::size_t a = 0; a < body.corners.size(); ++a) on.force[site(a)] -= stress * body.outwards[a];
    (coupling ? energy.coupling : energy.bonds) += 0.5 * stress * change;
  }

  void add_force(Place pi, Place pj, const Springs& springs, Loads6& on, BondEnergies& energy) const {
    const Grid& g = lattice_.grid;
    const std::size_t i = g.index(pi[0], pi[1], pi[2]), j = g.index(pj[0], pj[1], pj[2]);
    const bool between_ghosts = !lattice_.is(i, site::particle) && !lattice_.is(j, site::particle),
               coupling = lattice_.is(i, site::ghost) || lattice_.is(j, site::ghost);
    const Vec3 x_i = g.centre(i), x_j = g.centre(j), c = 0.5 * (x_i + x_j);
    const Vec3 normal = (1 / norm(x_j - x_i)) * (x_j - x_i);
    const auto carried = [&](std::size_t s, Vec3 x) {
      return lattice_.motion.vector(s) + cross(lattice_.motion.vector(s, 3), c - x);
    };
    const Vec3 d = carried(j, x_j) - carried(i, x_i), d_n = dot(d, normal) * normal;
    const Vec3 f = springs.k_n * d_n + springs.k_s * (d - d_n);
    on.force[i] += f, on.force[j] -= f;
    on.moment[i] += cross(c - x_i, f), on.moment[j] -= cross(c - x_j, f);
    (coupling ? energy.coupling : energy.bonds) += 0.5 * dot(f, d);
    if (norm(x_j - x_i) > 2.1 * r() || between_ghosts) return;
    const Vec3 turn = lattice_.motion.vector(j, 3) - lattice_.motion.vector(i, 3);
    const Vec3 twist = dot(turn, normal) * normal;
    const double I = std::pow(2 * r(), 4) / 12, J = 0.14057701495515552 * std::pow(2 * r(), 4);
    const Vec3 m = (E() * I / (2 * r())) * (turn - twist) + (E() / (2 * (1 + nu())) * J / (2 * r())) * twist;
    on.moment[i] += m, on.moment[j] -= m;
    (coupling ? energy.coupling : energy.bonds) += 0.5 * dot(m, turn);
  }

  const Lattice& lattice_;
  std::map<std::array<Place, 2>, Springs> springs_;
  std::vector<Swollen> swollen_;
};

/// The same body of another material.
Lattice with_poisson(const Lattice& of, double poisson) {
  Lattice lattice = make_lattice({of.grid.nx, of.grid.ny, of.grid.nz}, [&](int i, int j, int k) {
    return of.word[of.grid.index(i, j, k)] & (site::particle | site::free | site::ghost);
  });
  lattice.material.poisson = poisson;
  return consistent(std::move(lattice));
}

template <class F>
void for_bodies(F visit) {
  const Place n{17, 7, 6};
  std::vector<Lattice> bodies;
  for (const Place& box : {n, Place{9, 1, 3}, Place{12, 1, 1}, Place{2, 2, 2}, Place{1, 1, 1}})
    bodies.push_back(consistent_box(box));
  bodies.push_back(
      consistent_body(n, [](int i, int, int k) { return std::abs(i - 8) > 1 || std::abs(k - 2) > 1; }));
  bodies.push_back(consistent_body(n, [](int i, int j, int k) { return i != 5 || j != 3 || k != 3; }));
  bodies.push_back(consistent_body(n, [](int i, int j, int) { return j < 3 || i != 8; }));
  for (int seed = 0; seed < 6; ++seed) bodies.push_back(consistent(random_lattice(n, seed)));
  const std::size_t kinds = bodies.size();
  for (std::size_t b = 0; b < kinds; ++b) bodies.push_back(with_poisson(bodies[b], 0.4));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    SCOPED_TRACE(b);
    move_at_random(bodies[b], 60 + static_cast<int>(b));
    visit(bodies[b]);
  }
}

TEST(Assembly, IsTheRecipe) {
  for_bodies([](Lattice& lattice) {
    BondEnergies energy;
    const Loads6 expected = Recipe(lattice).forces(energy), found = kernel_forces(lattice);
    const double tolerance = 1e-13 * expected.largest();
    for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
      EXPECT_LE(norm(found.force[s] - expected.force[s]), tolerance) << s;
      EXPECT_LE(norm(found.moment[s] - expected.moment[s]), tolerance) << s;
    }
    const BondEnergies e = energies(lattice);
    const double all = energy.bonds + energy.coupling;
    EXPECT_NEAR(e.bonds, energy.bonds, 1e-13 * all);
    EXPECT_NEAR(e.coupling, energy.coupling, 1e-13 * all);
    double sum = 0;
    for (const double half : site_energies(lattice)) sum += half;
    EXPECT_NEAR(sum, all, 1e-13 * all);
  });
}

TEST(Assembly, MarksWhatIsNotInside) {
  const Lattice lattice = consistent_box({17, 6, 6});
  std::size_t inner = 0;
  for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
    if ((lattice.word[s] & site::inner) != site::inner) continue;
    ++inner;
    EXPECT_FALSE(lattice.is(s, site::surface));
    EXPECT_EQ(lattice.class_of[s], 0u);
  }
  EXPECT_EQ(inner, 15u * 4 * 4);
  EXPECT_EQ(lattice.classes.size(), 27u);  // inside, 6 faces, 12 edges, 8 corners
}

/// u = strain (X − origin).
void strain_by(Lattice& lattice, const Vec3& strain) {
  for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
    const Vec3 X = lattice.grid.centre(s);
    if (lattice.word[s]) lattice.motion.set(s, {strain.x * X.x, strain.y * X.y, strain.z * X.z});
  }
}

/// Section of a bar: box, L, a hollow one, a thin one, a row, and one that hangs together at an edge.
bool in_section(int which, int a, int b) {
  switch (which) {
    case 0:
      return a < 4 && b < 3;
    case 1:
      return a < 2 || b < 1;
    case 2:
      return a == 0 || a == 4 || b == 0 || b == 4;
    case 3:
      return a < 1;
    case 4:
      return a == 0 && b == 0;
    default:
      return (a < 2) == (b < 2);
  }
}

TEST(ConsistentLattice, HasExactlyYoungsModulusAndPoissonsRatioInBars) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int which = 0; which < 6; ++which)
      for (const double poisson : {0.0, 0.1, 0.23, 0.25, 0.3, 0.4, 0.45, 0.49}) {
        SCOPED_TRACE(which);
        const double rounding = 1e-13 / (1 - 2 * poisson);
        Place n{5, 5, 5};
        n[axis] = 9;
        Lattice lattice = make_lattice(n, [&](int i, int j, int k) {
          const Place p{i, j, k};
          return in_section(which, p[(axis + 1) % 3], p[(axis + 2) % 3]) ? free_particle : 0u;
        });
        lattice.material.poisson = poisson;
        assemble(lattice);
        Vec3 strain{-poisson, -poisson, -poisson};
        strain[static_cast<int>(axis)] = 1;
        strain_by(lattice, strain);
        const Loads6 f = kernel_forces(lattice);
        double end = 0, cells = 0;
        for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
          if (!lattice.word[s]) continue;
          const int along = lattice.grid.ijk(s)[axis];
          if (along == 0) end += f.force[s][static_cast<int>(axis)], ++cells;
          if (along == 0 || along == 8) continue;
          EXPECT_LT(norm(f.force[s]), rounding * lattice.material.young);
          EXPECT_LT(norm(f.moment[s]), rounding * lattice.material.young);
        }
        const double area = cells * std::pow(lattice.grid.pitch, 2);
        EXPECT_NEAR(end / (lattice.material.young * area), 1, 1e-12);
      }
}

void expect_exact_in_plane_stress(double poisson) {
  for (std::size_t normal = 0; normal < 3; ++normal)
    for (const int layers : {1, 2, 4}) {
      Place n{9, 9, 9};
      n[normal] = layers;
      Lattice lattice = with_poisson(full_lattice(n), poisson);
      const double E = lattice.material.young, nu = lattice.material.poisson, a = 1, b = -0.3;
      Vec3 strain;
      const int x = static_cast<int>(normal + 1) % 3, y = static_cast<int>(normal + 2) % 3;
      strain[x] = a, strain[y] = b, strain[static_cast<int>(normal)] = -nu / (1 - nu) * (a + b);
      strain_by(lattice, strain);
      const Loads6 f = kernel_forces(lattice);
      double edge = 0;
      for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
        if (!lattice.word[s]) continue;
        const auto at = lattice.grid.ijk(s);
        const int i = at[static_cast<std::size_t>(x)], j = at[static_cast<std::size_t>(y)];
        if (i == 0 && j == 4) edge += f.force[s][x];
        if (i == 0 || j == 0 || i == 8 || j == 8) continue;
        EXPECT_LT(norm(f.force[s]), 1e-13 / (1 - 2 * nu) * E);
        EXPECT_LT(norm(f.moment[s]), 1e-13 * E);
      }
      const double area = layers * std::pow(lattice.grid.pitch, 2);
      EXPECT_NEAR(edge / area, E / (1 - nu * nu) * (a + nu * b), 1e-12 * E);
    }
}

TEST(ConsistentLattice, IsExactInPlanesOfPlaneStress) {
  for (const double poisson : {0.2, 0.3, 0.4, 0.45, 0.49}) expect_exact_in_plane_stress(poisson);
}

TEST(ConsistentLattice, HasTheMaterialsConstantsWhateverNu) {
  for (const double poisson : {0.1, 0.25, 0.26, 0.3, 0.4, 0.45, 0.49, 0.499}) {
    const Recovered found = recovered_constants(with_poisson(full_lattice({2, 2, 2}), poisson));
    EXPECT_NEAR(found.young / 30, 1, 1e-11);
    EXPECT_NEAR(found.poisson, poisson, 1e-12);
  }
}

TEST(ConsistentLattice, DilatesAboveAQuarterOnly) {
  EXPECT_FALSE(with_poisson(full_lattice({4, 4, 4}), 0.25).dilates());
  EXPECT_FALSE(with_poisson(full_lattice({4, 1, 1}), 0.4).dilates());
  const Lattice box = with_poisson(full_lattice({4, 3, 3}), 0.4);
  std::map<int, int> parts;
  for (const std::uint8_t here : box.dilating)
    for (int kind = 0; kind <= of_cell; ++kind) parts[kind] += dilating::count(here, kind);
  EXPECT_EQ(parts[of_cell], 3 * 2 * 2);
  EXPECT_EQ(parts[0], 2 * 2 * 2);  // two faces across x
  EXPECT_EQ(parts[1], 2 * 3 * 2);
  const Lattice sheet = with_poisson(full_lattice({4, 3, 1}), 0.4);
  EXPECT_EQ(sheet.dilating[0], 2u << 4);  // both sides of it
}

/// Energy of a square bar of n × n rows, bent uniformly, over ½ E I κ² L, less 1.
double bending_excess(int n) {
  constexpr int length = 8;
  Lattice lattice = make_lattice({length + 2, n, n}, [&](int i, int, int) {
    return i == 0 || i == length + 1 ? +site::ghost : free_particle;
  });
  assemble(lattice);
  const double r = lattice.radius(), nu = lattice.material.poisson, kappa = 1e-2;
  for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
    if (!lattice.word[s]) continue;
    const auto [i, j, k] = lattice.grid.ijk(s);
    const double x = 2 * r * i, y = r * (2 * j - n + 1), z = r * (2 * k - n + 1);
    lattice.motion.set(s, kappa * Vec3{-x * y, x * x / 2 + nu * (y * y - z * z) / 2, nu * y * z});
    lattice.motion.set(s, kappa * Vec3{nu * z, 0, x}, 3);
  }
  const std::vector<double> energy = site_energies(lattice);
  double found = 0;
  for (std::size_t s = 0; s < energy.size(); ++s) {
    const int i = lattice.grid.ijk(s)[0];
    if (i > 1 && i < length) found += energy[s];
  }
  const double I = std::pow(2 * r * n, 4) / 12;
  return found / (0.5 * lattice.material.young * I * kappa * kappa * 2 * r * (length - 2)) - 1;
}

TEST(ConsistentLattice, BendsLikeABeam) {
  EXPECT_NEAR(bending_excess(1), 0, 1e-12);
  for (const int n : {2, 3, 4, 6, 8, 12}) {
    RecordProperty(("n" + std::to_string(n)).c_str(), std::to_string(bending_excess(n)));
    EXPECT_LT(std::abs(bending_excess(n)) * n * n, 1) << n;
  }
}

TEST(ConsistentLattice, TwistsARowLikeASquareBar) {
  Lattice lattice = consistent_box({9, 1, 1});
  const double pitch = lattice.grid.pitch, rate = 0.01;
  for (std::size_t s = 0; s < 9; ++s) lattice.motion.set(s, {rate * pitch * static_cast<double>(s), 0, 0}, 3);
  // J of a square of edge a: a⁴ (1/3 − 64/π⁵ Σ tanh(nπ/2)/n⁵), n odd
  double J = 1.0 / 3;
  for (int n = 1; n < 4000; n += 2)
    J -= 64 / std::pow(std::numbers::pi, 5) * std::tanh(n * std::numbers::pi / 2) / std::pow(n, 5);
  const double G = lattice.material.young / (2 * (1 + lattice.material.poisson));
  const double expected = 0.5 * G * J * std::pow(pitch, 4) * rate * rate * 8 * pitch;
  EXPECT_NEAR(energies(lattice).bonds, expected, 1e-12 * expected);
}

TEST(ConsistentLattice, ForcesAreMinusTheDerivativesOfTheEnergy) {
  for (const double poisson : {0.2, 0.4})
    expect_forces_of_the_energy(with_poisson(random_lattice({9, 4, 3}, 31), poisson));
}

TEST(ConsistentLattice, HasTheSameBitsForAnyNumberOfThreads) {
  Lattice lattice = with_poisson(random_lattice({17, 9, 8}, 5), 0.4);
  move_at_random(lattice, 6);
  set_threads(1);
  const Loads6 alone = kernel_forces(lattice);
  for (const int threads : {2, 3, 4}) {
    set_threads(threads);
    const Loads6 together = kernel_forces(lattice);
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      for (int c = 0; c < 3; ++c) EXPECT_EQ(alone.force[s][c], together.force[s][c]);
  }
  set_threads(1);
}

TEST(ConsistentLattice, StoresNothingInRigidMotion) {
  for_bodies([](Lattice& lattice) {
    const Vec3 shift{0.3, -0.2, 0.5}, turn{0.01, -0.03, 0.02}, about{1, 2, 3};
    for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
      if (!lattice.word[s]) continue;
      lattice.motion.set(s, shift + cross(turn, lattice.grid.centre(s) - about));
      lattice.motion.set(s, turn, 3);
    }
    EXPECT_LE(kernel_forces(lattice).largest(), 1e-13 * lattice.material.young);
  });
}

TEST(ConsistentLattice, KeepsMomentumAndAngularMomentum) {
  for_bodies([](Lattice& lattice) {
    const Loads6 f = kernel_forces(lattice);
    Vec3 momentum, angular;
    for (std::size_t s = 0; s < f.force.size(); ++s) {
      momentum += f.force[s];
      angular += cross(lattice.grid.centre(s), f.force[s]) + f.moment[s];
    }
    EXPECT_LE(norm(momentum), 1e-11 * f.largest());
    EXPECT_LE(norm(angular), 1e-10 * f.largest());
  });
}

TEST(ConsistentLattice, IgnoresWhateverIsAtEmptySites) {
  for_bodies([](Lattice& lattice) {
    const Loads6 before = kernel_forces(lattice);
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      for (int c = 0; c < 6 && !lattice.word[s]; ++c) lattice.motion[c][s] = std::nan("");
    const Loads6 after = kernel_forces(lattice);
    for (std::size_t s = 0; s < lattice.grid.size(); ++s)
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(before.force[s][c], after.force[s][c]);
        EXPECT_EQ(before.moment[s][c], after.moment[s][c]);
      }
  });
}

TEST(ConsistentLattice, IsTheScalarFormulaToTheBit) {
  for_bodies([](Lattice& lattice) {
    if (lattice.dilates()) return;
    const Loads6 packed = kernel_forces(lattice);
    std::ptrdiff_t offset[18];
    for (int d = 0; d < 18; ++d) offset[d] = lattice.grid.offset(d);
    const Bending bending = Bending::from(lattice.material, lattice.radius());
    for (std::size_t s = 0; s < lattice.grid.size(); ++s) {
      if (!lattice.word[s]) continue;
      const ClassBonds<double> law(bending, lattice.classes.data(), &lattice.class_of[s]);
      double f[6];
      site_force(view(lattice.motion), s, offset, law, lattice.radius(), SiteBonds{lattice.word[s]}, f);
      for (int c = 0; c < 6; ++c) EXPECT_EQ(c < 3 ? packed.force[s][c] : packed.moment[s][c - 3], f[c]);
    }
  });
}

/// What assemble says of a box at this ν; empty: it is content.
std::string refusal(const Place& n, double poisson) {
  Lattice lattice = full_lattice(n);
  lattice.material.poisson = poisson;
  try {
    assemble(lattice);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(ConsistentLattice, RefusesNegativeStiffness) {
  // Diagonals need λ ≥ 0; what sides cannot carry above ¼ cells and skins do.
  EXPECT_EQ(refusal({4, 4, 4}, 0.25), "");
  EXPECT_EQ(refusal({4, 4, 4}, 0), "");
  EXPECT_NE(refusal({4, 4, 4}, -0.01).find("0.0000 to 0.5000"), std::string::npos)
      << refusal({4, 4, 4}, -0.01);
  EXPECT_NE(refusal({4, 4, 4}, -0.01).find("diagonals of"), std::string::npos) << refusal({4, 4, 4}, -0.01);
  EXPECT_NE(refusal({4, 4, 1}, -0.01), "");
  for (const double poisson : {0.26, 0.34, 0.4999}) {
    EXPECT_EQ(refusal({4, 4, 4}, poisson), "");
    EXPECT_EQ(refusal({4, 4, 1}, poisson), "");
  }
  EXPECT_EQ(refusal({4, 1, 1}, 0.45), "");
}

}  // namespace
}  // namespace geist::de
