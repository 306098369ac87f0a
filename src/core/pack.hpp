// Pack: eight doubles that are computed with together, the unit of every vectorised kernel.
//
// A kernel is a template over T; with T = double it is the scalar formula, with T = Pack eight sites or
// elements at once. Multiply-adds are written fma(a, b, c) by name and rounded once on every machine; the
// compiler may not form its own (-ffp-contract=off). So the bits of a result do not depend on the instruction
// set, only the speed does.
//
// The number of lanes is a power of two, 8 unless GEIST_LANES says otherwise. With 1 every kernel is compiled
// as a machine wants it that gives each item a thread of its own: docs/architecture.md, "Other machines".
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#if defined(__AVX512F__) || defined(__FMA__)
#include <immintrin.h>
#endif

namespace geist {

#ifndef GEIST_LANES
#define GEIST_LANES 8
#endif
inline constexpr int lanes = GEIST_LANES;

using Pack = double __attribute__((vector_size(lanes * sizeof(double))));
using PackInt = std::int64_t __attribute__((vector_size(lanes * sizeof(std::int64_t))));

#define GEIST_INLINE inline __attribute__((always_inline))

GEIST_INLINE Pack load(const double* p) {
  Pack a;
  std::memcpy(&a, p, sizeof a);
  return a;
}
/// Eight words.
GEIST_INLINE PackInt load(const std::uint32_t* p) {
  using Words = std::uint32_t __attribute__((vector_size(lanes * sizeof(std::uint32_t))));
  Words w;
  std::memcpy(&w, p, sizeof w);
  return __builtin_convertvector(w, PackInt);
}
GEIST_INLINE void store(double* p, Pack a) { std::memcpy(p, &a, sizeof a); }

GEIST_INLINE Pack broadcast(double s) { return s - Pack{}; }

/// a·b + c, rounded once.
GEIST_INLINE double fma(double a, double b, double c) { return __builtin_fma(a, b, c); }
GEIST_INLINE Pack fma(Pack a, Pack b, Pack c) {
#if GEIST_LANES == 8 && defined(__AVX512F__)
  return (Pack)_mm512_fmadd_pd((__m512d)a, (__m512d)b, (__m512d)c);
#elif GEIST_LANES == 8 && defined(__FMA__)
  union Halves {
    Pack whole;
    __m256d half[2];
  };
  const Halves p{a}, q{b}, s{c};
  Halves r;
  r.half[0] = _mm256_fmadd_pd(p.half[0], q.half[0], s.half[0]);
  r.half[1] = _mm256_fmadd_pd(p.half[1], q.half[1], s.half[1]);
  return r.whole;
#else
  Pack r;
  for (int l = 0; l < lanes; ++l) r[l] = __builtin_fma(a[l], b[l], c[l]);
  return r;
#endif
}
GEIST_INLINE Pack fma(double a, Pack b, Pack c) { return fma(broadcast(a), b, c); }
GEIST_INLINE Pack fma(Pack a, double b, Pack c) { return fma(a, broadcast(b), c); }

/// a in the lanes where mask is −1, b where it is 0. Without masks in hardware bit by bit: compilers would go
/// lane by lane.
GEIST_INLINE Pack select(PackInt mask, Pack a, Pack b) {
#if defined(__AVX512F__)
  return mask ? a : b;
#else
  return (Pack)(((PackInt)a & mask) | ((PackInt)b & ~mask));
#endif
}

/// a in the lanes whose word has that bit, else 0.
template <int bit>
GEIST_INLINE Pack where_set(PackInt word, Pack a) {
#if defined(__AVX512F__)
  return (word & (std::int64_t{1} << bit)) != 0 ? a : Pack{};
#else
  return (Pack)((PackInt)a & -((word >> bit) & 1));
#endif
}

/// 1, but the compiler may not know.
inline const volatile double hidden_one = 1;

/// a + b to the same bits, of packs in hardware by the units that multiply; one is hidden_one. Processors
/// begin as many multiplications as additions in a cycle, so this is for some of the sums where a kernel has
/// little to multiply.
template <class T>
GEIST_INLINE T add_by_fma([[maybe_unused]] double one, T a, T b) {
#if defined(__AVX512F__)
  if constexpr (std::is_same_v<T, Pack>) return fma(one, a, b);
#endif
  return a + b;
}

/// The value of type T (double or Pack) all of whose lanes are s.
template <class T>
GEIST_INLINE T constant(double s) {
  if constexpr (std::is_same_v<T, Pack>)
    return broadcast(s);
  else
    return s;
}

/// Sum of the lanes in a fixed order.
GEIST_INLINE double sum_lanes(double a) { return a; }
GEIST_INLINE double sum_lanes(Pack a) {
  for (int half = lanes / 2; half > 0; half /= 2)
    for (int l = 0; l < half; ++l) a[l] += a[l + half];
  return a[0];
}

}  // namespace geist
