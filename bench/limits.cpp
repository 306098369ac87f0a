#include "limits.hpp"

#include <algorithm>

#include "clock.hpp"
#include "core/pack.hpp"
#include "core/parallel.hpp"

namespace geist::bench {
namespace {

#if defined(__AVX512F__)
constexpr int chains = 12;  // enough to hide the latency; all in registers
#else
constexpr int chains = 5;
#endif
constexpr std::size_t cache_share = 384 << 10;    // bytes for each thread: well inside a second-level cache
constexpr std::size_t memory_bytes = 384u << 20;  // well outside any cache

/// Sum of `chains` independent chains of n multiply-adds.
double chains_of(long n) {
  Pack x[chains];
  for (int k = 0; k < chains; ++k) x[k] = broadcast(1.0 + k);
  const Pack factor = broadcast(0.999999999), term = broadcast(1e-9);
  for (long i = 0; i < n; ++i)
#pragma GCC unroll 12
    for (int k = 0; k < chains; ++k) x[k] = fma(x[k], factor, term);
  double s = 0;
  for (const Pack& a : x) s += sum_lanes(a);
  return s;
}

GEIST_INLINE void store_past_caches(double* p, Pack a) {
#if defined(__AVX512F__)
  _mm512_stream_pd(p, (__m512d)a);
#elif defined(__AVX__)
  double half[2][4];
  __builtin_memcpy(half, &a, sizeof a);
  _mm256_stream_pd(p, _mm256_loadu_pd(half[0]));
  _mm256_stream_pd(p + 4, _mm256_loadu_pd(half[1]));
#else
  store(p, a);
#endif
}

template <bool streaming>
void triad(double* a, const double* b, const double* c, std::size_t begin, std::size_t end) {
  const Pack s = broadcast(3);
  for (std::size_t i = begin; i < end; i += lanes) {
    const Pack r = fma(s, load(c + i), load(b + i));
    if constexpr (streaming)
      store_past_caches(a + i, r);
    else
      store(a + i, r);
  }
#if defined(__AVX__)
  if constexpr (streaming) _mm_sfence();
#endif
}

}  // namespace

double fma_rate() {
  constexpr long n = 1'000'000;
  const std::size_t team = static_cast<std::size_t>(threads());
  volatile double sink[256];
  volatile double* const out = sink;
  const double begin = now();
  for_each(team, [=](std::size_t t) { out[t % 256] = chains_of(n); });
  return 2.0 * lanes * chains * n * static_cast<double>(team) / (now() - begin);
}

double fork_join_time() {
  constexpr int n = 200;
  const std::size_t team = static_cast<std::size_t>(threads());
  const double begin = now();
  for (int i = 0; i < n; ++i) for_each(team, [](std::size_t) { asm volatile(""); });
  return (now() - begin) / n;
}

Triad::Triad(std::size_t bytes)
    : n_(bytes / 24 / lanes * lanes),
      repeats_(std::max<std::size_t>(1, (std::size_t{96} << 20) * threads() / bytes)),
      arrays_(n_) {}

double Triad::once(bool streaming) {
  const std::size_t team = static_cast<std::size_t>(threads()), packs = n_ / lanes;
  const auto share = [=, repeats = repeats_, a = arrays_[0], b = arrays_[1], c = arrays_[2]](std::size_t t) {
    const std::size_t first = packs * t / team * lanes, last = packs * (t + 1) / team * lanes;
    for (std::size_t k = 0; k < repeats; ++k)
      streaming ? triad<true>(a, b, c, first, last) : triad<false>(a, b, c, first, last);
  };
  const double begin = now();
  for_each(team, share);
  return 24.0 * static_cast<double>(n_ * repeats_) / (now() - begin);
}

double Triad::bandwidth() { return std::max(once(false), once(true)); }

LimitProbe::LimitProbe() : cache_(cache_share * threads()), memory_(memory_bytes) {}

double LimitProbe::measure(Limits& limits) {
  const double fma = fma_rate();
  limits.fma = std::max(limits.fma, fma);
  limits.cache = std::max(limits.cache, cache_.bandwidth());
  limits.memory = std::max(limits.memory, memory_.bandwidth());
  limits.fork_join = std::min(limits.fork_join, fork_join_time());
  return fma;
}

}  // namespace geist::bench
