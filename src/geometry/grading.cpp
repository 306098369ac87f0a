#include "geometry/grading.hpp"

#include <algorithm>
#include <cstdlib>

namespace geist {
namespace {

double power(double q, int n) {
  double p = 1;
  for (; n > 0; n /= 2, q *= q)
    if (n % 2) p *= q;
  return p;
}

/// The n-th root of a ≥ 1 by halving. Not std::pow, whose last bits differ from one library to the next.
double root(double a, int n) {
  double low = 1, high = a;
  for (double q = (low + high) / 2; q > low && q < high; q = (low + high) / 2)
    (power(q, n) > a ? high : low) = q;
  return low;
}

/// How many times element i of n is longer by the growth factor than the shortest one.
int growths(int i, int n, Towards towards) {
  const int from_middle = std::abs(2 * i - (n - 1)) / 2;
  switch (towards) {
    case Towards::low:
      return i;
    case Towards::high:
      return n - 1 - i;
    case Towards::middle:
      return from_middle;
    case Towards::ends:
      return (n - 1) / 2 - from_middle;
  }
  return 0;
}

}  // namespace

Towards towards_of(std::string_view word) {
  if (word == "low") return Towards::low;
  if (word == "high") return Towards::high;
  return word == "middle" ? Towards::middle : Towards::ends;
}

std::vector<double> stations(int n, const Grading& grading) {
  std::vector<double> t(static_cast<std::size_t>(n) + 1);
  if (grading.ratio == 1 || n < least_divisions(grading.towards)) {
    for (int i = 0; i <= n; ++i) t[i] = 2.0 * i / n - 1;
    return t;
  }
  const int most = symmetric(grading) ? (n - 1) / 2 : n - 1;
  const double q = root(grading.ratio, most);
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += power(q, growths(i, n, grading.towards)), t[i + 1] = sum;
  for (double& end : t) end = 2 * end / sum - 1;
  return symmetric(grading) ? mirrored(std::move(t)) : t;
}

std::vector<double> mirrored(std::vector<double> t) {
  for (std::size_t i = 0, n = t.size() - 1; 2 * i <= n; ++i) {
    const double half = (t[n - i] - t[i]) / 2;
    t[i] = -half, t[n - i] = half;
  }
  return t;
}

}  // namespace geist
