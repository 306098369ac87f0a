// Graded divisions: elements along a direction whose lengths grow geometrically from where they are smallest.
#pragma once
#include <string_view>
#include <vector>

namespace geist {

/// Where the smallest elements are.
enum class Towards { low, high, middle, ends };

/// From "low", "high", "middle" or "ends".
Towards towards_of(std::string_view word);

/// How elements along a direction are graded; with ratio 1 they are all of one length.
struct Grading {
  Towards towards = Towards::low;
  double ratio = 1;  ///< longest element / shortest element, ≥ 1
};

/// Whether low and high may be exchanged.
constexpr bool symmetric(const Grading& g) {
  return g.ratio == 1 || g.towards == Towards::middle || g.towards == Towards::ends;
}

/// Number of divisions from which on a ratio other than 1 can be had.
constexpr int least_divisions(Towards towards) {
  return towards == Towards::low || towards == Towards::high ? 2 : 3;
}

/// The n + 1 ends of n elements along [−1, 1].
std::vector<double> stations(int n, const Grading& grading = {});

/// The same with t_i = −t_{n−i} to the last bit, so that the middle of an even n is 0; for a symmetric
/// grading.
std::vector<double> mirrored(std::vector<double> t);

}  // namespace geist
