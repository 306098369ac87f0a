#include "reference.hpp"

#include <algorithm>
#include <array>

namespace geist::bench {
namespace {

// Their machine: flop/s of multiply-adds and bytes/s from memory, on one core and on four.
constexpr double their_fma[2] = {105e9, 410e9}, their_memory[2] = {21e9, 69e9};

struct Bare {
  const char* subject;
  const char* size;
  double rate[2];  ///< on one core, on four
  Work work;       ///< their own count; bytes only where the cube is larger than the caches
};

constexpr std::array<Bare, 6> table{{{"lattice", "40x40x40", {5.0e7, 1.9e8}, {600, 0}},
                                     {"lattice", "100x100x100", {4.2e7, 1.6e8}, {600, 148}},
                                     {"one-point", "40x40x40", {1.8e7, 7.2e7}, {1350, 0}},
                                     {"one-point", "100x100x100", {0.9e7, 5.2e7}, {1350, 210}},
                                     {"selective-reduced", "40x40x40", {7.6e6, 2.8e7}, {5700, 0}},
                                     {"selective-reduced", "100x100x100", {5.3e6, 2.3e7}, {5700, 210}}}};

double roofline_seconds(Work work, double fma, double memory) {
  return std::max(work.flops / fma, work.bytes / memory);
}

}  // namespace

std::optional<double> bare_kernels(const Row& row, const Limits& limits) {
  if (row.what != whole_program) return std::nullopt;
  const int several = row.threads > 1;
  for (const Bare& bare : table)
    if (row.subject == bare.subject && row.size == bare.size)
      return bare.rate[several] * roofline_seconds(bare.work, their_fma[several], their_memory[several]) /
             roofline_seconds(bare.work, limits.fma, limits.memory);
  return std::nullopt;
}

}  // namespace geist::bench
