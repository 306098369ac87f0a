#include "solver/nodes.hpp"

#include <algorithm>

#include "core/parallel.hpp"

namespace geist {

void gather_internal_forces(Mesh& mesh) {
  double* const f[3] = {mesh.f[0], mesh.f[1], mesh.f[2]};
  const auto gather_one = [=, corner_force = mesh.corner_force.data(), slot = mesh.gather.data(),
                           begin = mesh.gather_begin.data()](std::size_t i) {
    double s[3] = {0, 0, 0};
    for (std::int32_t k = begin[i]; k < begin[i + 1]; ++k)
      for (int c = 0; c < 3; ++c) s[c] += corner_force[slot[k] + lanes * c];
    for (int c = 0; c < 3; ++c) f[c][i] = s[c];
  };
  for_each(mesh.nodes(), gather_one, 500);
}

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
