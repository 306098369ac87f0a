#include "solver/nodes.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/pack.hpp"
#include "core/parallel.hpp"

namespace geist {

namespace {

/// Eight nodes; those past the last one are held in all components.
struct EightNodes {
  std::size_t first, count;

  GEIST_INLINE Pack read(const double* p, double otherwise) const {
    if (count == lanes) return load(p + first);
    Pack a = broadcast(otherwise);
    for (std::size_t l = 0; l < count; ++l) a[l] = p[first + l];
    return a;
  }
  GEIST_INLINE void write(double* p, Pack a) const {
    if (count == lanes) return store(p + first, a);
    for (std::size_t l = 0; l < count; ++l) p[first + l] = a[l];
  }
  GEIST_INLINE PackInt bits(const std::uint8_t* p) const {
    using Bytes = std::uint8_t __attribute__((vector_size(lanes)));
    Bytes a = Bytes{} + std::uint8_t{0b111};
    if (count == lanes)
      std::memcpy(&a, p + first, sizeof a);
    else
      for (std::size_t l = 0; l < count; ++l) a[l] = p[first + l];
    return __builtin_convertvector(a, PackInt);
  }
};

}  // namespace

de::KickSums kick_nodes(Mesh& mesh, const de::Kick& kick) {
  double* const v[3] = {mesh.v[0], mesh.v[1], mesh.v[2]};
  const double* const f[3] = {mesh.f[0], mesh.f[1], mesh.f[2]};
  const auto kick_eight = [=, n = mesh.nodes(), mass = mesh.mass.data(),
                           held = mesh.held.data()](std::size_t b) {
    const EightNodes nodes{b * lanes, std::min<std::size_t>(lanes, n - b * lanes)};
    const Pack m = nodes.read(mass, 1), per_mass = kick.per_mass / m, none = broadcast(0);
    const PackInt bits = nodes.bits(held);
    Pack across = none, after_twice = none;
    for (int c = 0; c < 3; ++c) {
      const PackInt is_held = (bits >> c & 1) != 0;
      const Pack before = nodes.read(v[c], 0);
      const Pack free =
          fma(per_mass, nodes.read(f[c], 0), fma(kick.keep, before, broadcast(kick.gravity[c])));
      const Pack after = is_held ? before : free, p = (is_held ? none : m) * after;
      nodes.write(v[c], after);
      across = fma(p, before, across), after_twice = fma(p, after, after_twice);
    }
    return de::KickSums{sum_lanes(across), sum_lanes(after_twice), 0, 0};
  };
  constexpr std::size_t block = 64;  // packs
  return sum<de::KickSums, block>((mesh.nodes() + lanes - 1) / lanes, kick_eight);
}

template <int N>
void drift(Field<N>& u, const Field<N>& v, double dt, int components) {
  constexpr std::size_t block = 1024;
  const std::size_t n = u.size();
  struct Components {
    double* u;
    const double* v;
  };
  std::array<Components, N> all;
  for (int c = 0; c < N; ++c) all[c] = {u[c], v[c]};
  const auto drift_block = [=](std::size_t b) {
    for (const auto [x, y] : std::span(all).first(components))
      for (std::size_t i = b * block; i < std::min(n, (b + 1) * block); ++i) x[i] = fma(dt, y[i], x[i]);
  };
  for_each((n + block - 1) / block, drift_block, 4);
}
template void drift<3>(Field<3>&, const Field<3>&, double, int);
template void drift<6>(Field<6>&, const Field<6>&, double, int);

}  // namespace geist
