// Fields: zero, aligned, guarded, and no component touches another.
#include "core/field.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace geist {
namespace {

constexpr std::size_t sizes[] = {0, 1, 7, 8, 9, 64, 1000, 20000}, guards[] = {0, 1, 8, 13, 100};

template <class F>
void for_all_shapes(F visit) {
  for (const std::size_t n : sizes)
    for (const std::size_t guard : guards) visit(n, guard);
}

TEST(Field, IsZeroToBeginWithIncludingItsGuards) {
  for_all_shapes([](std::size_t n, std::size_t guard) {
    const Field<6> f(n, guard);
    EXPECT_EQ(f.size(), n);
    for (int c = 0; c < 6; ++c)
      for (auto i = -static_cast<std::ptrdiff_t>(guard); i < static_cast<std::ptrdiff_t>(n + guard); ++i)
        ASSERT_EQ(f[c][i], 0) << n << ' ' << guard << ' ' << c << ' ' << i;
  });
}

TEST(Field, ComponentsAreAligned) {
  for_all_shapes([](std::size_t n, std::size_t guard) {
    const Field<3> f(n, guard);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(reinterpret_cast<std::uintptr_t>(f[c]) % 64, 0u);
  });
}

TEST(Field, ComponentsAndTheirGuardsDoNotOverlap) {
  for_all_shapes([](std::size_t n, std::size_t guard) {
    Field<4> f(n, guard);
    const auto value = [](int c, std::ptrdiff_t i) { return 1e6 * (c + 1) + static_cast<double>(i); };
    const auto visit = [&](auto action) {
      for (int c = 0; c < 4; ++c)
        for (auto i = -static_cast<std::ptrdiff_t>(guard); i < static_cast<std::ptrdiff_t>(n + guard); ++i)
          action(c, i);
    };
    visit([&](int c, std::ptrdiff_t i) { f[c][i] = value(c, i); });
    visit([&](int c, std::ptrdiff_t i) { ASSERT_EQ(f[c][i], value(c, i)); });
  });
}

TEST(Field, VectorsAreThreeComponentsFromAGivenOneOn) {
  Field<6> f(5);
  f.set(2, {1, 2, 3});
  f.set(2, {4, 5, 6}, 3);
  f.add(2, {10, 20, 30});
  EXPECT_EQ(f.vector(2), (Vec3{11, 22, 33}));
  EXPECT_EQ(f.vector(2, 3), (Vec3{4, 5, 6}));
  EXPECT_EQ(f[4][2], 5);
  EXPECT_EQ(f.vector(1), Vec3{});
  EXPECT_EQ(f.vector(3, 3), Vec3{});
}

TEST(Field, MovesKeepTheData) {
  Field<3> f(4);
  f.set(3, {7, 8, 9});
  const double* const place = f[0];
  const Field<3> g = std::move(f);
  EXPECT_EQ(g[0], place);
  EXPECT_EQ(g.vector(3), (Vec3{7, 8, 9}));
  EXPECT_EQ(g.size(), 4u);
}

}  // namespace
}  // namespace geist
