// Graded divisions: ratios, growth, symmetry.
#include "geometry/grading.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace geist {
namespace {

std::vector<double> lengths(const std::vector<double>& t) {
  std::vector<double> l;
  for (std::size_t i = 1; i < t.size(); ++i) l.push_back(t[i] - t[i - 1]);
  return l;
}

TEST(Grading, WithoutOneAllElementsAreOfOneLength) {
  for (const Towards towards : {Towards::low, Towards::high, Towards::middle, Towards::ends})
    for (const int n : {1, 2, 7, 100}) {
      const std::vector<double> t = stations(n, {towards, 1});
      ASSERT_EQ(t.size(), n + 1u);
      for (int i = 0; i <= n; ++i)
        EXPECT_EQ(t[i], 2.0 * i / n - 1);  // to the bit: golden hashes depend on it
    }
}

TEST(Grading, HasTheRatioBetweenTheEnds) {
  for (const Towards towards : {Towards::low, Towards::high, Towards::middle, Towards::ends})
    for (const int n : {3, 4, 11, 500})
      for (const double ratio : {1.01, 2.0, 1000.0}) {
        const std::vector<double> t = stations(n, {towards, ratio}), l = lengths(t);
        EXPECT_EQ(t.front(), -1);
        EXPECT_EQ(t.back(), 1);
        const auto [shortest, longest] = std::minmax_element(l.begin(), l.end());
        EXPECT_NEAR(*longest / *shortest / ratio, 1, 1e-9) << n;
      }
}

TEST(Grading, GrowsByOneFactor) {
  const std::vector<double> low = lengths(stations(9, {Towards::low, 5}));
  for (std::size_t i = 1; i < low.size(); ++i) EXPECT_NEAR(low[i] / low[i - 1], std::pow(5, 1 / 8.0), 1e-12);
  const std::vector<double> high = lengths(stations(9, {Towards::high, 5}));
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(high[i], low[8 - i], 1e-15);
  const std::vector<double> middle = lengths(stations(9, {Towards::middle, 5}));
  for (std::size_t i = 5; i < 9; ++i) EXPECT_NEAR(middle[i] / middle[i - 1], std::pow(5, 1 / 4.0), 1e-12);
  const std::vector<double> ends = lengths(stations(8, {Towards::ends, 5}));
  for (std::size_t i = 5; i < 8; ++i) EXPECT_NEAR(ends[i - 1] / ends[i], std::pow(5, 1 / 3.0), 1e-12);
  EXPECT_NEAR(ends[3], ends[4], 1e-15);
}

TEST(Grading, AboutTheMiddleIsSymmetricToTheBit) {
  for (const Towards towards : {Towards::middle, Towards::ends})
    for (const int n : {3, 4, 12, 37}) {
      const std::vector<double> t = stations(n, {towards, 7});
      for (int i = 0; i <= n; ++i) EXPECT_EQ(t[i], -t[n - i]);
    }
}

TEST(Grading, TakesEnoughDivisions) {
  EXPECT_EQ(stations(1, {Towards::high, 5}), (std::vector<double>{-1, 1}));
  EXPECT_EQ(stations(2, {Towards::middle, 5}), (std::vector<double>{-1, 0, 1}));
  EXPECT_EQ(least_divisions(Towards::low), 2);
  EXPECT_EQ(least_divisions(Towards::ends), 3);
}

}  // namespace
}  // namespace geist
