#include "de/short_steps.hpp"

#include <array>
#include <type_traits>
#include <utility>

#include "core/parallel.hpp"
#include "de/drift.hpp"

namespace geist::de {
namespace {

template <std::size_t n>
GEIST_INLINE void copy_pack(const std::array<double*, n>& from, const std::array<double*, n>& to,
                            std::size_t s) {
  for (std::size_t c = 0; c < n; ++c) store(to[c] + s, load(from[c] + s));
}

}  // namespace

ShortSteps::ShortSteps(const Lattice& lattice)
    : motion_(lattice.motion.size(), lattice.grid.guard()),
      increment_(lattice.motion.size(), lattice.grid.guard()),
      sum_(lattice.motion.size()),
      rotation_(lattice.rotation.size(), lattice.rotation.size() > 0 ? lattice.grid.guard() : 0),
      rest_(lattice.listed.size()),
      mean_(lattice.listed.size()) {}

void ShortSteps::begin(Lattice& lattice) {
  copy(lattice.listed_force, rest_), copy(lattice.listed_force, mean_);
  std::swap(lattice.velocity, increment_);
  first_ = true;
}

void ShortSteps::drift(Lattice& lattice) {
  lattice.kinematics == Kinematics::finite ? drift_by(FiniteDrift(lattice, 1), lattice)
                                           : drift_by(SmallDrift(lattice, 1), lattice);
  first_ = false;
}

/// In one pass over memory; what has not been kept yet is kept before.
template <class Drift>
void ShortSteps::drift_by(const Drift& drift, Lattice& lattice) {
  constexpr std::size_t grain = 512;  // packs that are not worth waking the threads
  const auto w = components<6>(lattice.velocity), sum = components<6>(sum_);
  const auto motion = components<6>(lattice.motion), kept = components<6>(motion_);
  const auto rotation = components<9>(lattice.rotation), kept_rotation = components<9>(rotation_);
  const auto first_drift = [=](std::size_t pack) {
    const std::size_t s = lanes * pack;
    copy_pack(motion, kept, s), copy_pack(w, sum, s);
    if constexpr (std::is_same_v<Drift, FiniteDrift>) copy_pack(rotation, kept_rotation, s);
    drift(s);
  };
  const auto later_drift = [=](std::size_t pack) {
    const std::size_t s = lanes * pack;
    for (int c = 0; c < 6; ++c) store(sum[c] + s, load(sum[c] + s) + load(w[c] + s));
    drift(s);
  };
  const std::size_t packs = lattice.grid.size() / lanes;
  first_ ? for_each(packs, first_drift, grain) : for_each(packs, later_drift, grain);
}

void ShortSteps::step(Lattice& lattice, const Kick& kick, double share) {
  bond_forces_and_kick(lattice, kick);
  for (int c = 0; c < 6; ++c)
    for (std::size_t slot = 0; slot < lattice.listed.size(); ++slot) {
      double& force = lattice.listed_force[c][slot];
      mean_[c][slot] = fma(share, force, mean_[c][slot]);
      force += rest_[c][slot];
    }
  kick_listed(lattice, kick);
}

void ShortSteps::end(Lattice& lattice) {
  std::swap(lattice.motion, motion_), std::swap(lattice.rotation, rotation_);
  std::swap(lattice.velocity, increment_);
  copy(mean_, lattice.listed_force);
}

KickSums ShortSteps::kick(Lattice& lattice, const Kick& kick) const {
  const auto velocity = components<6>(lattice.velocity);
  const auto sum = components<6>(sum_), last = components<6>(increment_);
  return geist::sum<KickSums, 64>(
      lattice.grid.size() / lanes, [=, word = lattice.word.data()](std::size_t pack) {
        const std::size_t s = lanes * pack;
        const PackInt free = -((load(word + s) / site::free) & 1);
        Pack across[2] = {}, after[2] = {};
        for (int c = 0; c < 6; ++c) {
          const Pack before = load(velocity[c] + s), zero = {};
          const Pack kicked = kick(c, before, load(sum[c] + s) + load(last[c] + s));
          store(velocity[c] + s, select(free, kicked, before));
          const Pack counted = select(free, kicked, zero);
          across[c / 3] = fma(before, counted, across[c / 3]);
          after[c / 3] = fma(counted, counted, after[c / 3]);
        }
        return KickSums{sum_lanes(across[0]), sum_lanes(after[0]), sum_lanes(across[1]), sum_lanes(after[1])};
      });
}

}  // namespace geist::de
