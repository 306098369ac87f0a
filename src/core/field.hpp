// Field: N components of one quantity at n places, structure of arrays, zero to begin with.
#pragma once
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

#include "core/parallel.hpp"
#include "core/vec.hpp"

namespace geist {

/// f[c][i] is component c at place i. Each component is aligned to 64 bytes and has `guard` readable and
/// writable places before the first and after the last, so that a stencil may look over the edge; they stay
/// zero. Components are staggered so that they do not compete for the same cache sets.
template <int N>
class Field {
 public:
  Field() = default;
  explicit Field(std::size_t n, std::size_t guard = 0) : size_(n) {
    const std::size_t lead = round_up(guard), stagger = 8 * 9;
    const std::size_t stride = lead + round_up(n + guard) + stagger;
    data_.reset(allocate(N * stride * sizeof(double)));
    double* const base = data_.get();
    for_each(
        N * stride, [=](std::size_t i) { base[i] = 0; }, 1 << 14);
    for (int c = 0; c < N; ++c) component_[c] = base + c * stride + lead;
  }
  Field(const Field& other) = delete;
  Field& operator=(const Field& other) = delete;
  Field(Field&&) noexcept = default;
  Field& operator=(Field&&) noexcept = default;

  std::size_t size() const { return size_; }
  double* operator[](int c) { return component_[c]; }
  const double* operator[](int c) const { return component_[c]; }

  /// The three components from `first` on at place i.
  Vec3 vector(std::size_t i, int first = 0) const {
    return {component_[first][i], component_[first + 1][i], component_[first + 2][i]};
  }
  void set(std::size_t i, Vec3 a, int first = 0) {
    for (int c = 0; c < 3; ++c) component_[first + c][i] = a[c];
  }
  void add(std::size_t i, Vec3 a, int first = 0) {
    for (int c = 0; c < 3; ++c) component_[first + c][i] += a[c];
  }

 private:
  static constexpr std::size_t round_up_to(std::size_t n, std::size_t m) { return (n + m - 1) / m * m; }
  static constexpr std::size_t round_up(std::size_t n) { return round_up_to(n, 8); }
  /// Large fields take large pages: a stencil touches more small ones than the processor remembers.
  static double* allocate(std::size_t bytes) {
    constexpr std::size_t line = 64, large_page = 2 << 20;
    const std::size_t alignment = bytes >= 4 * large_page ? large_page : line;
    void* const p = std::aligned_alloc(alignment, round_up_to(bytes, alignment));
    if (!p) throw std::bad_alloc();
    if (alignment == large_page) madvise(p, round_up_to(bytes, alignment), MADV_HUGEPAGE);
    return static_cast<double*>(p);
  }
  struct Free {
    void operator()(double* p) const { std::free(p); }
  };
  std::unique_ptr<double, Free> data_;
  std::array<double*, N> component_{};
  std::size_t size_ = 0;
};

/// The first n components, for a kernel to take along.
template <int n, int N>
std::array<double*, n> components(Field<N>& f) {
  std::array<double*, n> all;
  for (int c = 0; c < n; ++c) all[c] = f[c];
  return all;
}
template <int n, int N>
std::array<const double*, n> components(const Field<N>& f) {
  std::array<const double*, n> all;
  for (int c = 0; c < n; ++c) all[c] = f[c];
  return all;
}

/// Make everything zero again.
template <int N>
void clear(Field<N>& f) {
  for (int c = 0; c < N; ++c)
    for_each(
        f.size(), [p = f[c]](std::size_t i) { p[i] = 0; }, 1 << 14);
}

/// Both have the same size; guards stay as they are.
template <int N>
void copy(const Field<N>& from, Field<N>& to) {
  constexpr std::size_t block = 1024;
  const std::size_t n = from.size();
  for (int c = 0; c < N; ++c)
    for_each((n + block - 1) / block,
             [=, x = from[c], y = to[c]](std::size_t b) {
               std::copy(x + b * block, x + std::min(n, (b + 1) * block), y + b * block);
             },
             8);
}

}  // namespace geist
