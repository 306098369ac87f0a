#include "output/units.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace geist::output {
namespace {

namespace dim = dimension;

TEST(Units, MillimetreGramMillisecond) {
  const UnitSystem units("mm", "g", "ms");
  EXPECT_EQ(units.label(dim::force), "N");
  EXPECT_EQ(units.label(dim::stress), "MPa");
  EXPECT_EQ(units.label(dim::energy), "mJ");
  EXPECT_EQ(units.label(dim::velocity), "mm/ms");
  EXPECT_EQ(units.label(dim::density), "g/mm^3");
  EXPECT_EQ(units.label(dim::frequency), "1/ms");
  EXPECT_EQ(units.label(dim::spin), "rad/ms");
  EXPECT_EQ(units.label(dim::angle), "rad");
  EXPECT_EQ(units.label(dim::momentum), "g*mm/ms");
  EXPECT_EQ(units.label(dim::angular_momentum), "g*mm^2/ms");
  EXPECT_EQ(units.label(dim::length), "mm");
  EXPECT_EQ(units.label(dim::none), "1");
}

struct Expected {
  const char *length, *mass, *time, *force, *stress, *energy;
};

TEST(Units, SiNamesWhereAPrefixFitsProductsElsewhere) {
  for (const Expected& e :
       {Expected{"m", "kg", "s", "N", "Pa", "J"}, Expected{"mm", "t", "s", "N", "MPa", "mJ"},
        Expected{"m", "t", "s", "kN", "kPa", "kJ"}, Expected{"mm", "mg", "ms", "mN", "kPa", "uJ"},
        Expected{"mm", "kg", "ms", "kN", "GPa", "J"}, Expected{"um", "mg", "us", "N", "TPa", "uJ"},
        Expected{"cm", "g", "us", "g*cm/us^2", "g/(cm*us^2)", "g*cm^2/us^2"},
        Expected{"cm", "kg", "s", "kg*cm/s^2", "kg/(cm*s^2)", "kg*cm^2/s^2"}}) {
    const UnitSystem units(e.length, e.mass, e.time);
    EXPECT_EQ(units.label(dim::force), e.force);
    EXPECT_EQ(units.label(dim::stress), e.stress);
    EXPECT_EQ(units.label(dim::energy), e.energy);
  }
}

TEST(Units, UnknownNamesAreRefused) {
  EXPECT_THROW(UnitSystem("inch", "g", "ms"), std::invalid_argument);
  EXPECT_THROW(UnitSystem("mm", "lb", "ms"), std::invalid_argument);
  EXPECT_THROW(UnitSystem("mm", "g", "h"), std::invalid_argument);
}

}  // namespace
}  // namespace geist::output
