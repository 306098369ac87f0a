// The time of day for measurements.
#pragma once
#include <chrono>

namespace geist::bench {

/// Seconds since some moment.
inline double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace geist::bench
