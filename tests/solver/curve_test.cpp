#include "solver/curve.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace geist {
namespace {

TEST(Curve, IsOneWithoutPoints) {
  EXPECT_EQ(Curve{}.at(-3), 1);
  EXPECT_EQ(Curve{}.at(7), 1);
  EXPECT_TRUE(Curve{}.constant_over(0, 1e9));
}

TEST(Curve, IsLinearBetweenItsPointsAndConstantBeyond) {
  const Curve c{{{1, 2}, {3, 6}, {4, -1}}};
  EXPECT_EQ(c.at(-1), 2);
  EXPECT_EQ(c.at(1), 2);
  EXPECT_DOUBLE_EQ(c.at(1.5), 3);
  EXPECT_EQ(c.at(3), 6);
  EXPECT_DOUBLE_EQ(c.at(3.5), 2.5);
  EXPECT_EQ(c.at(4), -1);
  EXPECT_EQ(c.at(9), -1);
}

TEST(Curve, OnePointIsAConstant) {
  const Curve c{{{5, 0.3}}};
  for (const double t : {0.0, 5.0, 6.0}) EXPECT_EQ(c.at(t), 0.3);
  EXPECT_TRUE(c.constant_over(0, 10));
}

TEST(Curve, KnowsWhereItIsConstant) {
  const Curve c{{{1, 0.5}, {2, 0.5}, {3, 1}, {4, 0.5}}};
  EXPECT_TRUE(c.constant_over(0, 2));
  EXPECT_FALSE(c.constant_over(0, 2.001));
  EXPECT_FALSE(c.constant_over(2.5, 2.6));
  EXPECT_FALSE(c.constant_over(1, 4)) << "equal at both ends, but not between";
  EXPECT_TRUE(c.constant_over(4, std::numeric_limits<double>::infinity()));
}

/// Whatever the value, and wherever between two equal points: or deferred work would be settled at every
/// step.
TEST(Curve, IsExactlyConstantBetweenEqualPoints) {
  for (const double value : {0.1, 0.7, 1.0 / 3}) {
    const Curve c{{{0, value}, {0.9, value}}};
    int off = 0;
    for (int i = 0; i < 1000; ++i) off += c.at(0.0009 * i) != value;
    EXPECT_EQ(off, 0) << value;
    EXPECT_TRUE(c.constant_over(0.1, 0.17));
  }
}

}  // namespace
}  // namespace geist
