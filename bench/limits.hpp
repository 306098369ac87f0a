// The machine's limits: multiply-add rate, memory bandwidth, and what it costs to wake the threads.
#pragma once
#include <cstddef>

#include "core/field.hpp"

namespace geist::bench {

/// Flops per second of independent multiply-adds on all threads in use.
double fma_rate();

/// Seconds that an empty loop over the threads takes.
double fork_join_time();

/// a = b + s c on three arrays of `bytes` together; every thread keeps its share.
class Triad {
 public:
  explicit Triad(std::size_t bytes);

  /// Bytes per second, 24 for each element: the better of ordinary stores (which read the line that they
  /// write, uncounted) and of stores past the caches.
  double bandwidth();

 private:
  double once(bool streaming);
  std::size_t n_, repeats_;
  Field<3> arrays_;
};

/// The best of what was measured, for one number of threads.
struct Limits {
  double fma = 0, cache = 0, memory = 0;  ///< flop/s; bytes/s in the second-level cache and from memory
  double fork_join = 1e9;                 ///< seconds
};

/// Measures all limits again, so that they see the same machine as what is measured between the calls;
/// returns this call's multiply-add rate.
class LimitProbe {
 public:
  LimitProbe();
  double measure(Limits& limits);

 private:
  Triad cache_, memory_;
};

}  // namespace geist::bench
