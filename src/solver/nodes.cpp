#include "solver/nodes.hpp"

#include <algorithm>
#include <cstdint>

#include "core/pack.hpp"
#include "core/parallel.hpp"

namespace geist {

namespace {

/// The kick of nodes i …, as many as T has lanes, in component c, and its sums.
template <class T>
struct NodeKick {
  const de::Kick& kick;
  T mass, per_mass = kick.per_mass / mass, across = constant<T>(0), after = constant<T>(0);

  GEIST_INLINE T operator()(int c, const T& f, const T& before) {
    const T v = fma(per_mass, f, fma(kick.keep, before, constant<T>(kick.gravity[c])));
    const T momentum = mass * v;
    across = fma(momentum, before, across), after = fma(momentum, v, after);
    return v;
  }
};

}  // namespace

de::KickSums kick_nodes(Mesh& mesh, const de::Kick& kick) {
  double* const v[3] = {mesh.v[0], mesh.v[1], mesh.v[2]};
  const double* const f[3] = {mesh.f[0], mesh.f[1], mesh.f[2]};
  const auto kick_pack = [=, n = mesh.nodes(), mass = mesh.mass.data(),
                          held = mesh.held.data()](std::size_t b) {
    const std::size_t first = b * lanes, end = std::min(n, first + lanes);
    if (first + lanes <= n && std::all_of(held + first, held + end, [](std::uint8_t h) { return h == 0; })) {
      NodeKick<Pack> eight{kick, load(mass + first)};
      for (int c = 0; c < 3; ++c) store(v[c] + first, eight(c, load(f[c] + first), load(v[c] + first)));
      return de::KickSums{sum_lanes(eight.across), sum_lanes(eight.after), 0, 0};
    }
    de::KickSums sums;
    for (std::size_t i = first; i < end; ++i) {
      NodeKick<double> one{kick, mass[i]};
      for (int c = 0; c < 3; ++c)
        if (!(held[i] >> c & 1)) v[c][i] = one(c, f[c][i], v[c][i]);
      sums += {one.across, one.after, 0, 0};
    }
    return sums;
  };
  constexpr std::size_t block = 64;  // packs
  return sum<de::KickSums, block>((mesh.nodes() + lanes - 1) / lanes, kick_pack);
}

void drift(Mesh& mesh, double dt) {
  constexpr std::size_t block = 1024;
  const std::size_t n = mesh.nodes();
  double* const u[3] = {mesh.u[0], mesh.u[1], mesh.u[2]};
  const double* const v[3] = {mesh.v[0], mesh.v[1], mesh.v[2]};
  const auto drift_block = [=](std::size_t b) {
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = b * block; i < std::min(n, (b + 1) * block); ++i)
        u[c][i] = fma(dt, v[c][i], u[c][i]);
  };
  for_each((n + block - 1) / block, drift_block, 4);
}

}  // namespace geist
