#include "de/assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "de/stiffness.hpp"

#include <Eigen/Dense>

namespace geist::de {
namespace {

using Step = std::array<int, 3>;

Step unit(std::size_t axis, int sign) {
  Step e{};
  e[axis] = sign;
  return e;
}

Step operator+(Step a, Step b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

constexpr std::uint32_t place_bit(int a, int b, int c) { return 1u << (9 * (c + 1) + 3 * (b + 1) + a + 1); }
constexpr std::uint32_t everywhere = (1u << 27) - 1;
constexpr Surroundings endless{everywhere, everywhere};

/// Whether a step from the site leads to an occupied place.
struct Occupied {
  std::uint32_t places;
  bool operator()(Step e) const { return places & place_bit(e[0], e[1], e[2]); }
};

/// Places that the cube with edges e, b, c has its corners at.
std::uint32_t cube(Step e, Step b, Step c) {
  std::uint32_t places = 0;
  for (const Step& s : {Step{}, e, b, c, e + b, e + c, b + c, e + b + c})
    places |= place_bit(s[0], s[1], s[2]);
  return places;
}

/// The cube that the edge e spans with b and c: a cell, or skins and bars.
Parts edge_in_cube(Surroundings around, Step e, Step b, Step c) {
  if (!(around.particles & cube(e, b, c))) return {};
  const Occupied at{around.occupied};
  const bool face_b = at(b) && at(e + b), face_c = at(c) && at(e + c);
  if (face_b && face_c && at(b + c) && at(e + b + c)) return {1, 0, 0, 0};
  const int skins = face_b + face_c;
  return {0, skins, 1 - skins, skins == 0};
}

/// The cube on side c of the face with the edges a and b, for the diagonal a + b.
Parts diagonal_in_cube(Surroundings around, Step a, Step b, Step c) {
  const Occupied at{around.occupied};
  if (!(around.particles & cube(a, b, c)) || !at(a) || !at(b)) return {};
  const bool cell = at(c) && at(a + c) && at(b + c) && at(a + b + c);
  return {cell, !cell, 0, 0};
}

/// A particle's bonds are in cubes with a particle whatever is around, so only ghosts look who is one.
Surroundings surroundings(const Lattice& lattice, std::size_t s) {
  const Grid& grid = lattice.grid;
  const auto [i, j, k] = grid.ijk(s);
  Surroundings around;
  for (int c = -1; c <= 1; ++c)
    for (int b = -1; b <= 1; ++b)
      for (int a = -1; a <= 1; ++a) {
        if (!grid.contains(i + a, j + b, k + c)) continue;
        const std::uint32_t word = lattice.word[grid.index(i + a, j + b, k + c)];
        if (word & (site::particle | site::ghost)) around.occupied |= place_bit(a, b, c);
        if (word & site::particle) around.particles |= place_bit(a, b, c);
      }
  if (lattice.is(s, site::particle)) around.particles = everywhere;
  return around;
}

bool has_neighbour(Surroundings around, int d) {
  const auto [a, b, c] = directions[static_cast<std::size_t>(d)];
  return around.occupied & place_bit(a, b, c);
}

BondClass make_class(Surroundings around, const Material& material, double r) {
  BondClass made;
  made.around = around;
  for (int d = 0; d < 18; ++d) {
    if (!has_neighbour(around, d)) continue;
    const auto at = static_cast<std::size_t>(d);
    const auto [a, b, c] = directions[at];
    const ElasticBond bond = assembled(parts_of(around, d), group(d), material, r);
    made.shear[at] = bond.k_s;
    made.along[at] = (bond.k_n - bond.k_s) / group(d);
    made.bends[at] = group(d) == 1 && around.particles & (place_bit(0, 0, 0) | place_bit(a, b, c)) ? 1 : 0;
  }
  return made;
}

using Kinds = std::set<std::pair<int, Parts>>;  ///< group and parts of every bond that differs

Kinds kinds_of(const Lattice& lattice) {
  std::set<Surroundings> done;
  Kinds kinds;
  for (std::size_t s = 0; s < lattice.word.size(); ++s) {
    const Surroundings around = lattice.classes[lattice.class_of[s]].around;
    if (!lattice.is(s, site::particle | site::ghost) || !done.insert(around).second) continue;
    for (int d = 0; d < 18; ++d)
      if (has_neighbour(around, d)) kinds.insert({group(d), parts_of(around, d)});
  }
  return kinds;
}

/// Bonds between two ghosts where cells, skins or bars give them springs.
void connect_ghosts(Lattice& lattice) {
  for (const Ghost& ghost : lattice.ghosts) {
    const BondClass& own = lattice.classes[lattice.class_of[ghost.site]];
    for (int d = 0; d < 18; ++d)
      if (own.shear[static_cast<std::size_t>(d)] != 0 || own.along[static_cast<std::size_t>(d)] != 0)
        lattice.word[ghost.site] |= 1u << d;
  }
}

/// Whether no spring of that kind is negative at this ν, but for rounding.
bool holds(const std::pair<int, Parts>& kind, double poisson) {
  const ElasticBond bond = assembled(kind.second, kind.first, {"", 0, 1, poisson}, 1);
  return std::min(bond.k_n, bond.k_s) >= -1e-12;
}

/// The ν next to `limit` at which the kind still holds. All hold from 0 to ¼.
double last_poisson(const std::pair<int, Parts>& kind, double limit) {
  double good = 0.125, bad = limit;
  for (int n = 0; n < 60; ++n) (holds(kind, (good + bad) / 2) ? good : bad) = (good + bad) / 2;
  return std::abs(good) < 1e-10 ? 0 : good;
}

std::string words(const std::pair<int, Parts>& kind) {
  const auto& [group, parts] = kind;
  std::string text = fmt::format("{} of {} cells and {} skins", group == 1 ? "sides" : "diagonals",
                                 parts.cells, parts.skins);
  if (parts.bars != 0) text += fmt::format(", {} edge bars", parts.bars);
  return text;
}

void check_stiffness(const Lattice& lattice) {
  const double poisson = lattice.material.poisson;
  const Kinds kinds = kinds_of(lattice);
  const auto weak =
      std::find_if(kinds.begin(), kinds.end(), [&](const auto& kind) { return !holds(kind, poisson); });
  if (weak == kinds.end()) return;
  double least = -1, most = 0.5;
  for (const auto& kind : kinds) {
    least = std::max(least, last_poisson(kind, -1));
    most = std::min(most, last_poisson(kind, 0.5));
  }
  throw std::invalid_argument(fmt::format(
      "poisson = {} gives some bonds negative stiffness ({}); this lattice allows {:.4f} to {:.4f}", poisson,
      words(*weak), least, most));
}

/// Bᵀ K B, where B (u, θ) is what the motion of one end adds to d.
Matrix6 at_one_end(const Eigen::Matrix3d& K, const Eigen::Vector3d& e, double r) {
  Eigen::Matrix<double, 3, 6> B;
  B.leftCols<3>() = -Eigen::Matrix3d::Identity();
  B.rightCols<3>() = cross_matrix(r * e);
  return B.transpose() * K * B;
}

/// The endless lattice's bond to an empty place, cut: all of its energy at motion 0 over there.
Matrix6 cut_bond(const EndlessBond& law, const Eigen::Vector3d& e, double r) {
  Matrix6 cut = at_one_end(spring_matrix(law.of(static_cast<int>(e.squaredNorm())), e), e, r);
  if (e.squaredNorm() == 1) cut.bottomRightCorner<3, 3>() += turning_matrix(law, e);
  return cut;
}

/// Twice what a bond at one end adds at most where it is stiffer than the endless lattice's:
/// |a + b|² ≤ 2|a|² + 2|b|².
Matrix6 stiffer_bond(const BondClass& kind, std::size_t d, const ElasticBond& bond, const Eigen::Vector3d& e,
                     double r) {
  const double g = e.squaredNorm(), shear = kind.shear[d], normal = shear + g * kind.along[d];
  const double more_s = std::max(0.0, shear - bond.k_s), more_n = std::max(0.0, normal - bond.k_n);
  return 2 * at_one_end(spring_matrix(more_s, (more_n - more_s) / g, e), e, r);
}

/// Four times what the skins around a site add to its stiffness: q² ≤ 4 Σ (s_a·u_a)².
Matrix6 skins_around(Surroundings around, double stiffness) {
  Matrix6 sum = Matrix6::Zero();
  for (int d = 0; d < 18; ++d) {
    if (group(d) == 1 || !has_neighbour(around, d)) continue;
    const auto [a, b, c] = directions[static_cast<std::size_t>(d)];
    const Eigen::Vector3d s(a, b, c);
    sum.topLeftCorner<3, 3>() += (4 * stiffness * parts_of(around, d).skins) * s * s.transpose();
  }
  return sum;
}

}  // namespace

Parts parts_of(Surroundings around, int d) {
  const Step e = directions[static_cast<std::size_t>(d)];
  std::array<std::size_t, 3> across{}, along{};
  std::size_t n_across = 0, n_along = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (e[axis] == 0)
      across[n_across++] = axis;
    else
      along[n_along++] = axis;
  Parts sum;
  const auto add = [&sum](const Parts& p) {
    sum.cells += p.cells, sum.skins += p.skins, sum.bars += p.bars, sum.lone_bars += p.lone_bars;
  };
  for (const int b : {-1, 1}) {
    if (n_across == 1)
      add(diagonal_in_cube(around, unit(along[0], e[along[0]]), unit(along[1], e[along[1]]),
                           unit(across[0], b)));
    else
      for (const int c : {-1, 1}) add(edge_in_cube(around, e, unit(across[0], b), unit(across[1], c)));
  }
  return sum;
}

ElasticBond assembled(const Parts& parts, int group, const Material& material, double r) {
  const Material bonds = material_of_bonds(material);  // of cells and skins; bars are in uniaxial stress
  const double E = bonds.young, nu = bonds.poisson, G = material.mu();
  const ElasticBond cell = EndlessBond::from(material, r).of(group);
  if (group == 2) {
    const double share = 0.5 * parts.cells, k_n2 = r * nu * E / (1 - nu * nu);
    return {share * cell.k_n + parts.skins * k_n2, share * cell.k_s};
  }
  const double share = 0.25 * parts.cells, skin = 0.5 * parts.skins;
  const double k_n1 = r * E / (1 + nu), k_s1 = k_n1 * (1 - 3 * nu) / (1 - nu);
  return {share * cell.k_n + skin * k_n1 + parts.bars * (material.young * r / 2),
          share * cell.k_s + skin * k_s1 + parts.lone_bars * (5.0 / 6 * G * r / 2)};
}

namespace {

/// Cells and skins that the site is the lowest corner of.
std::uint8_t dilating_at(Surroundings around) {
  std::uint8_t here = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Step a = unit((axis + 1) % 3, 1), b = unit((axis + 2) % 3, 1);
    if (!Occupied{around.occupied}(a + b)) continue;
    const Parts above = diagonal_in_cube(around, a, b, unit(axis, 1)),
                below = diagonal_in_cube(around, a, b, unit(axis, -1));
    here |= static_cast<std::uint8_t>((above.skins + below.skins) << 2 * axis);
    if (above.cells) here |= dilating::cell;
  }
  return here;
}

/// Cells and skins with an energy of dilatation; none where bonds carry all.
void make_dilating(Lattice& lattice) {
  lattice.dilating.clear(), lattice.pressure = {};
  const Dilatation stiffness = Dilatation::from(lattice.material, lattice.radius());
  if (stiffness.cell == 0 && stiffness.skin == 0) return;
  std::vector<std::uint8_t> dilating(lattice.grid.size());
  for (std::size_t s = 0; s < dilating.size(); ++s)
    if (lattice.is(s, site::particle | site::ghost))
      dilating[s] = dilating_at(lattice.classes[lattice.class_of[s]].around);
  if (std::all_of(dilating.begin(), dilating.end(), [](std::uint8_t here) { return here == 0; })) return;
  lattice.dilating = std::move(dilating);
  lattice.pressure = Field<4>(lattice.grid.size(), lattice.grid.guard());
}

}  // namespace

void assemble(Lattice& lattice) {
  const double r = lattice.radius();
  lattice.classes.assign(1, make_class(endless, lattice.material, r));
  lattice.class_of.assign(lattice.grid.size(), 0);
  std::map<Surroundings, std::uint32_t> index{{endless, 0}};
  for (std::size_t s = 0; s < lattice.word.size(); ++s) {
    lattice.word[s] &= ~site::surface;
    if (!lattice.is(s, site::particle | site::ghost)) continue;
    const Surroundings around = surroundings(lattice, s);
    const auto [at, is_new] = index.emplace(around, lattice.classes.size());
    if (is_new) lattice.classes.push_back(make_class(around, lattice.material, r));
    lattice.class_of[s] = at->second;
    if (at->second != 0) lattice.word[s] |= site::surface;
  }
  connect_ghosts(lattice);
  check_stiffness(lattice);
  make_dilating(lattice);
}

double surface_excess(const Lattice& lattice) {
  const double r = lattice.radius();
  const EndlessBond law = EndlessBond::from(lattice.material, r);
  Eigen::Matrix<double, 6, 1> scale;
  scale << Eigen::Vector3d::Constant(1 / std::sqrt(lattice.mass)),
      Eigen::Vector3d::Constant(1 / std::sqrt(lattice.inertia));
  const double skin = lattice.dilates() ? Dilatation::from(lattice.material, r).skin : 0;
  double most = 0;
  for (const BondClass& kind : lattice.classes) {
    Matrix6 S = skins_around(kind.around, skin);
    for (int d = 0; d < 18; ++d) {
      const auto at = static_cast<std::size_t>(d);
      const Eigen::Vector3d e(directions[at][0], directions[at][1], directions[at][2]);
      if (has_neighbour(kind.around, d))
        S += stiffer_bond(kind, at, law.of(group(d)), e, r);
      else
        S -= cut_bond(law, e, r);
    }
    const Matrix6 A = scale.asDiagonal() * S * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Matrix6> solver(A, Eigen::EigenvaluesOnly);
    most = std::max(most, solver.eigenvalues()(5));
  }
  return most;
}

}  // namespace geist::de
