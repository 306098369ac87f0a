// Products of triples of doubles or packs, for kernels.
#pragma once
#include "core/pack.hpp"

namespace geist {

/// out = a × b.
template <class T>
GEIST_INLINE void cross(const T* a, const T* b, T* out) {
  out[0] = fma(a[1], b[2], -(a[2] * b[1]));
  out[1] = fma(a[2], b[0], -(a[0] * b[2]));
  out[2] = fma(a[0], b[1], -(a[1] * b[0]));
}

template <class T>
GEIST_INLINE T dot(const T* a, const T* b) {
  return fma(a[2], b[2], fma(a[1], b[1], a[0] * b[0]));
}

}  // namespace geist
