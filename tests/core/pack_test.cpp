// Packs: every lane does what the scalar does, to the bit.
#include "core/pack.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <random>

namespace geist {
namespace {

using Lanes = std::array<double, lanes>;

Lanes lanes_of(Pack p) {
  Lanes a;
  for (int l = 0; l < lanes; ++l) a[l] = p[l];
  return a;
}

class RandomPacks : public ::testing::Test {
 protected:
  /// Numbers of very different sizes, so that rounding shows.
  Pack pack() {
    Pack p;
    for (int l = 0; l < lanes; ++l) p[l] = std::ldexp(mantissa_(random_), exponent_(random_));
    return p;
  }

 private:
  std::mt19937 random_{5};
  std::uniform_real_distribution<double> mantissa_{-1, 1};
  std::uniform_int_distribution<int> exponent_{-30, 30};
};

TEST(Pack, LoadAndStoreKeepLanesInOrderAtAnyAddress) {
  alignas(64) double memory[3 * lanes];
  for (int i = 0; i < 3 * lanes; ++i) memory[i] = 100 + i;
  for (int shift = 0; shift < lanes; ++shift) {
    const Pack p = load(memory + shift);
    for (int l = 0; l < lanes; ++l) EXPECT_EQ(p[l], 100 + shift + l);
  }
  store(memory + 3, broadcast(-1));
  for (int i = 0; i < 3 * lanes; ++i) EXPECT_EQ(memory[i], i >= 3 && i < 3 + lanes ? -1 : 100 + i);
}

TEST(Pack, LoadOfWordsWidensEach) {
  std::uint32_t memory[2 * lanes];
  for (std::uint32_t i = 0; i < 2 * lanes; ++i) memory[i] = 0xffffff00u + i;
  const PackInt p = load(memory + 1);
  for (int l = 0; l < lanes; ++l) EXPECT_EQ(p[l], 0xffffff01 + l);
}

TEST(Pack, ConstantFillsEveryLane) {
  EXPECT_EQ(constant<double>(2.5), 2.5);
  for (const double x : lanes_of(constant<Pack>(2.5))) EXPECT_EQ(x, 2.5);
}

TEST_F(RandomPacks, ArithmeticIsTheScalarsOfEachLane) {
  for (int repeat = 0; repeat < 100; ++repeat) {
    const Pack a = pack(), b = pack();
    const Pack sum = a + b, difference = a - b, product = a * b, negative = -a;
    const Pack same_sum = add_by_fma(hidden_one, a, b);
    for (int l = 0; l < lanes; ++l) {
      EXPECT_EQ(same_sum[l], a[l] + b[l]);
      EXPECT_EQ(sum[l], a[l] + b[l]);
      EXPECT_EQ(difference[l], a[l] - b[l]);
      EXPECT_EQ(product[l], a[l] * b[l]);
      EXPECT_EQ(negative[l], -a[l]);
    }
  }
}

TEST_F(RandomPacks, FmaIsStdFmaOfEachLaneInAllItsForms) {
  for (int repeat = 0; repeat < 100; ++repeat) {
    const Pack a = pack(), b = pack(), c = pack();
    const Pack all = fma(a, b, c), scalar_first = fma(a[0], b, c), scalar_second = fma(a, b[0], c);
    for (int l = 0; l < lanes; ++l) {
      EXPECT_EQ(all[l], std::fma(a[l], b[l], c[l]));
      EXPECT_EQ(scalar_first[l], std::fma(a[0], b[l], c[l]));
      EXPECT_EQ(scalar_second[l], std::fma(a[l], b[0], c[l]));
      EXPECT_EQ(fma(a[l], b[l], c[l]), all[l]);
    }
  }
}

TEST(Pack, FmaRoundsOnce) {
  // (1 + 2⁻³⁰)² = 1 + 2⁻²⁹ + 2⁻⁶⁰, of which a rounded product forgets the last term.
  volatile double a = 1 + std::ldexp(1, -30);
  const double c = -(1 + std::ldexp(1, -29)), exact = std::ldexp(1, -60);
  EXPECT_EQ(a * a + c, 0);
  EXPECT_EQ(fma(a, a, c), exact);
  for (const double x : lanes_of(fma(broadcast(a), broadcast(a), broadcast(c)))) EXPECT_EQ(x, exact);
}

TEST(Pack, SumOfLanesCountsEveryLaneOnce) {
  EXPECT_EQ(sum_lanes(3.5), 3.5);
  EXPECT_EQ(sum_lanes(Pack{1, 2, 4, 8, 16, 32, 64, 128}), 255);
  for (int l = 0; l < lanes; ++l) {
    Pack one = {};
    one[l] = 1;
    EXPECT_EQ(sum_lanes(one), 1);
  }
}

TEST_F(RandomPacks, SumOfLanesIsTheTreeOfHalves) {
  // The order that its results are golden for: lanes 4 apart, then 2 apart, then 1 apart.
  for (int repeat = 0; repeat < 100; ++repeat) {
    Lanes a = lanes_of(pack());
    const double found = sum_lanes(load(a.data()));
    for (int width = lanes / 2; width >= 1; width /= 2)
      for (int l = 0; l < width; ++l) a[l] += a[l + width];
    EXPECT_EQ(std::bit_cast<std::uint64_t>(found), std::bit_cast<std::uint64_t>(a[0]));
  }
}

}  // namespace
}  // namespace geist
