#include "solver/nodes.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "core/parallel.hpp"

namespace geist {

de::KickSums kick_nodes(Mesh& mesh, const de::Kick& kick) {
  double* const v[3] = {mesh.v[0], mesh.v[1], mesh.v[2]};
  const double* const f[3] = {mesh.f[0], mesh.f[1], mesh.f[2]};
  return sum<de::KickSums>(
      mesh.nodes(), [=, mass = mesh.mass.data(), held = mesh.held.data()](std::size_t i) {
        de::KickSums sums;
        for (int c = 0; c < 3; ++c) {
          if (held[i] >> c & 1) continue;
          const double before = v[c][i];
          const double after = fma(kick.per_mass / mass[i], f[c][i], fma(kick.keep, before, kick.gravity[c]));
          v[c][i] = after;
          sums.across += mass[i] * before * after;
          sums.after += mass[i] * after * after;
        }
        return sums;
      });
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
