#include "fe/elements.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "core/parallel.hpp"
#include "fe/corotational.hpp"
#include "fe/cut.hpp"
#include "fe/formulations.hpp"
#include "fe/gather.hpp"
#include "fe/parameters.hpp"
#include "geometry/hex8.hpp"

namespace geist::fe {
namespace {

/// Fewer blocks than this are not worth waking the threads.
constexpr std::size_t grain = 16;

double sum_real_lanes(Pack a, int real) {
  double s = 0;
  for (int l = 0; l < real; ++l) s += a[l];
  return s;
}

/// The formulations of a mesh's blocks: as they are, or cut; and turning with their elements, or not.
struct Blocks {
  const HexBlock* block;
  const BlockCut* cuts;
  const std::int32_t* cut_of_block;  ///< null if there are none
  bool turn;

  explicit Blocks(const Mesh& mesh)
      : block(mesh.blocks.data()),
        cuts(mesh.block_cuts.data()),
        cut_of_block(mesh.cuts.empty() ? nullptr : mesh.cut_of_block.data()),
        turn(mesh.kinematics == Kinematics::finite) {}

  template <class Formulation, class Visit>
  GEIST_INLINE auto visit(std::size_t b, const Formulation& formulation, Visit visit_one) const {
    if (cut_of_block && cut_of_block[b] >= 0)
      return visit_turned(Cut<Formulation>{formulation, cuts[cut_of_block[b]]}, visit_one);
    return visit_turned(formulation, visit_one);
  }

 private:
  template <class Formulation, class Visit>
  GEIST_INLINE auto visit_turned(const Formulation& formulation, Visit visit_one) const {
    return turn ? visit_one(Corotational<Formulation>{formulation}) : visit_one(formulation);
  }
};

/// Add the forces of some blocks of one region to the nodes; returns the power that is dissipated.
template <class Formulation>
double add_forces(Mesh& mesh, std::span<const std::int32_t> sweep, Formulation formulation, double factor) {
  const NodeField X(mesh, mesh.X), u(mesh, mesh.u), v(mesh, mesh.v);
  const NodeForces total(mesh, mesh.f);
  const Blocks blocks(mesh);
  Corners<Pack> room[3];
  double power = 0;
  for (const std::int32_t b : sweep) {
    const HexBlock& block = blocks.block[b];
    const CornerValues x = X.at(block, room[0]), w = u.at(block, room[1]);
    Corners<Pack> f;
    const Pack p = blocks.visit(static_cast<std::size_t>(b), formulation, [&](const auto& own) {
      const Corners<Pack> d = w.all();
      if constexpr (Formulation::uses_velocity)
        return own.forces(x.all(), d, v.at(block, room[2]).all(), f);
      else
        return own.forces(x.all(), d, d, f);
    });
    total.add(block, factor, f);
    if constexpr (Formulation::uses_velocity) power += sum_real_lanes(p, block.count);
  }
  return power;
}

/// The same for blocks of any regions, in ascending order.
double add_slab(Mesh& mesh, std::span<const std::int32_t> slab, double factor) {
  double power = 0;
  for (const HexRegion& region : mesh.regions) {
    const auto end = std::lower_bound(slab.begin(), slab.end(),
                                      static_cast<std::int32_t>(region.first_block + region.blocks()));
    const std::size_t n = static_cast<std::size_t>(end - slab.begin());
    if (n == 0) continue;
    visit_formulation(region.formulation, parameters(region), [&](auto formulation) {
      power += add_forces(mesh, slab.first(n), formulation, factor);
    });
    slab = slab.subspan(n);
  }
  return power;
}

template <class Formulation>
Energies region_energies(const Mesh& mesh, const HexRegion& region, Formulation formulation) {
  const NodeField X(mesh, mesh.X), u(mesh, mesh.u);
  const Blocks blocks(mesh);
  return sum<Energies>(region.blocks(), [=, &region](std::size_t i) {
    const std::size_t b = region.first_block + i;
    Corners<Pack> room[2];
    const CornerValues x = X.at(blocks.block[b], room[0]), w = u.at(blocks.block[b], room[1]);
    const Stored<Pack> e =
        blocks.visit(b, formulation, [&](const auto& own) { return own.energy(x.all(), w.all()); });
    const int real = blocks.block[b].count;
    return Energies{sum_real_lanes(e.strain, real), sum_real_lanes(e.hourglass, real)};
  });
}

Corners<double> corner_values(const Mesh& mesh, const Field<3>& field, std::size_t e) {
  Corners<double> x;
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) x[a][i] = field[i][mesh.elements[e][a]];
  return x;
}

std::array<double, 6> centre_stress(Kinematics kinematics, const Corners<double>& X, const Corners<double>& u,
                                    const Material& m) {
  double L[3][3], s[3][3];
  if (kinematics == Kinematics::finite) {
    turned_stress(m.lambda(), m.mu(), TurningAxes<double>(X, u), s);
  } else {
    mean_of_gradient(mean_gradient(to_modes(X)), to_modes(u), L);
    hooke(m.lambda(), m.mu(), L, s);
  }
  return {s[0][0], s[1][1], s[2][2], s[0][1], s[1][2], s[0][2]};
}

BlockCut whole_block(const Mesh& mesh, const HexBlock& block) {
  Corners<Pack> room;
  const MeanGradient<Pack> m = mean_gradient(to_modes(NodeField(mesh, mesh.X).at(block, room).all()));
  BlockCut whole;
  whole.volume = m.volume;
  Modes<Pack> g = m.g;
  for (int i = 0; i < 3; ++i) g[7][i] = broadcast(0);
  Corners<Pack> B;
  to_corners(g, B);
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < 8; ++a) whole.gradient[a][i] = B[a][i];
  return whole;
}

}  // namespace

double add_internal_forces(Mesh& mesh, const Sweep& sweep, double factor) {
  std::vector<double> power(sweep.slabs());
  for (std::size_t c = 0; c < sweep.colours(); ++c) {
    const std::size_t first = sweep.colour_begin[c];
    for_each(sweep.colour_begin[c + 1] - first, [=, &mesh, &sweep, powers = power.data()](std::size_t i) {
      const std::size_t begin = sweep.slab_begin[first + i], end = sweep.slab_begin[first + i + 1];
      powers[first + i] = add_slab(mesh, std::span(sweep.blocks).subspan(begin, end - begin), factor);
    });
  }
  return std::accumulate(power.begin(), power.end(), 0.0);
}

double internal_forces(Mesh& mesh) {
  clear(mesh.f);
  return add_internal_forces(mesh, mesh.sweep, 1);
}

Energies energies(const Mesh& mesh) {
  Energies total;
  for (const HexRegion& region : mesh.regions)
    visit_formulation(region.formulation, parameters(region),
                      [&](auto formulation) { total += region_energies(mesh, region, formulation); });
  return total;
}

std::vector<std::array<double, 6>> centre_stresses(const Mesh& mesh) {
  std::vector<std::array<double, 6>> stresses(mesh.elements.size());
  auto* const out = stresses.data();
  for (const HexRegion& region : mesh.regions)
    for_each(
        region.count,
        [=, &mesh, &region](std::size_t i) {
          const std::size_t e = region.first + i;
          out[e] = centre_stress(mesh.kinematics, corner_values(mesh, mesh.X, e),
                                 corner_values(mesh, mesh.u, e), region.material);
        },
        grain * lanes);
  return stresses;
}

std::optional<std::size_t> first_inverted(const Mesh& mesh) {
  if (mesh.kinematics == Kinematics::small) return {};
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    double F[3][3], normal[3];
    mean_deformation(mean_gradient(to_modes(corner_values(mesh, mesh.X, e))),
                     to_modes(corner_values(mesh, mesh.u, e)), F);
    cross(F[1], F[2], normal);
    if (dot(F[0], normal) <= 0) return e;
  }
  return {};
}

std::array<double, 8> corner_masses(const Mesh& mesh, std::size_t element) {
  if (const HexCut* cut = cut_of(mesh, element)) return cut->mass;
  auto mass = hex8::corner_volumes(hex8::corners(mesh, element));
  const HexRegion& region = mesh.regions[region_of(mesh, static_cast<std::int32_t>(element))];
  for (double& m : mass) m *= region.material.density;
  return mass;
}

void set_cuts(Mesh& mesh, std::vector<HexCut> cuts) {
  mesh.cuts = std::move(cuts);
  mesh.block_cuts.clear();
  mesh.cut_of_block.assign(mesh.blocks.size(), -1);
  for (const HexCut& cut : mesh.cuts) {
    const HexRegion& region = mesh.regions[region_of(mesh, cut.element)];
    const std::size_t i = static_cast<std::size_t>(cut.element) - region.first,
                      b = region.first_block + i / lanes;
    if (mesh.cut_of_block[b] < 0) {
      mesh.cut_of_block[b] = static_cast<std::int32_t>(mesh.block_cuts.size());
      mesh.block_cuts.push_back(whole_block(mesh, mesh.blocks[b]));
    }
    BlockCut& block = mesh.block_cuts[mesh.cut_of_block[b]];
    block.volume[i % lanes] = cut.volume;
    for (int a = 0; a < 8; ++a)
      for (int c = 0; c < 3; ++c) block.gradient[a][c][i % lanes] = cut.gradient[a][c];
  }
}

std::array<std::array<double, 8>, lanes> corner_masses_of_eight(const Mesh& mesh, const HexRegion& region,
                                                                std::size_t first) {
  Pack x[8][3], volumes[8];
  for (int l = 0; l < lanes; ++l) {
    const auto& nodes = mesh.elements[std::min(first + l, region.first + region.count - 1)];
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) x[a][i][l] = mesh.points[nodes[a]][i];
  }
  hex8::corner_volumes(x, volumes);
  std::array<std::array<double, 8>, lanes> mass;
  for (int l = 0; l < lanes; ++l) {
    for (int a = 0; a < 8; ++a) mass[l][a] = volumes[a][l] * region.material.density;
    if (const HexCut* cut = cut_of(mesh, first + l)) mass[l] = cut->mass;
  }
  return mass;
}

std::vector<double> region_masses(const Mesh& mesh) {
  std::vector<double> total(mesh.regions.size(), 0.0);
  std::size_t region = 0;
  visit_corner_masses(mesh, [&](std::size_t e, const std::array<double, 8>& mass) {
    while (e >= mesh.regions[region].first + mesh.regions[region].count) ++region;
    total[region] = std::accumulate(mass.begin(), mass.end(), total[region]);
  });
  return total;
}

void lump_masses(Mesh& mesh) {
  std::fill(mesh.mass.begin(), mesh.mass.end(), 0.0);
  visit_corner_masses(mesh, [&mesh](std::size_t e, const std::array<double, 8>& mass) {
    for (int a = 0; a < 8; ++a) mesh.mass[mesh.elements[e][a]] += mass[a];
  });
}

}  // namespace geist::fe
