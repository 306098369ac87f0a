// Loops: every index once, and sums of the same bits for any number of threads.
#include "core/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <bit>
#include <cstdint>
#include <random>
#include <set>
#include <thread>

#include "core/vec.hpp"

namespace geist {
namespace {

const std::size_t counts[] = {0, 1, 2, 511, 512, 513, 1024, 5000, 100001};

/// Numbers whose sum depends on the order of adding.
std::vector<double> rough_numbers(std::size_t n) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-40, 40);
  std::vector<double> x(n);
  for (double& a : x) a = std::ldexp(mantissa(random), exponent(random));
  return x;
}

TEST(Parallel, EveryIndexIsVisitedOnce) {
  for (int n_threads = 1; n_threads <= 4; ++n_threads) {
    set_threads(n_threads);
    EXPECT_EQ(threads(), n_threads);
    for (const std::size_t n : counts)
      for (const std::size_t grain : {std::size_t{1}, std::size_t{1000}}) {
        std::vector<int> visits(n, 0);
        int* const visit = visits.data();
        for_each(
            n, [=](std::size_t i) { ++visit[i]; }, grain);
        EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), static_cast<long>(n));
      }
  }
}

TEST(Parallel, SharesCoverEveryIndexOnceInOrderAndAreAlwaysTheSame) {
  for (int n_threads = 1; n_threads <= 4; ++n_threads) {
    set_threads(n_threads);
    for (const std::size_t n : counts)
      for (const std::size_t grain : {std::size_t{1}, std::size_t{600}}) {
        std::vector<std::size_t> begins[2];
        for (auto& begin_of : begins) {
          begin_of.assign(n, n + 1);
          for_each_share(
              n,
              [begin = begin_of.data()](Indices share) {
                for (std::size_t i = share.begin; i < share.end; ++i) begin[i] = share.begin;
              },
              grain);
        }
        EXPECT_EQ(begins[0], begins[1]);
        std::set<std::size_t> shares(begins[0].begin(), begins[0].end());
        EXPECT_EQ(shares.size(), n == 0 ? 0 : n > grain ? std::min<std::size_t>(n, n_threads) : 1);
        EXPECT_EQ(shares.count(n + 1), 0u);
        EXPECT_TRUE(std::is_sorted(begins[0].begin(), begins[0].end()));
      }
  }
}

TEST(Parallel, FewIterationsStayOnTheCallingThread) {
  set_threads(4);
  const auto caller = std::this_thread::get_id();
  std::atomic<int> elsewhere = 0;
  const auto look = [&elsewhere, caller](std::size_t) { elsewhere += std::this_thread::get_id() != caller; };
  for_each(100, look, 100);
  EXPECT_EQ(elsewhere, 0);
  for_each(101, look, 100);
  EXPECT_GT(elsewhere, 0);
}

TEST(Parallel, LoopsWithinLoopsVisitEverythingOnce) {
  set_threads(3);
  constexpr std::size_t n = 40, m = 70;
  std::vector<int> visits(n * m, 0);
  int* const visit = visits.data();
  for_each(n, [=](std::size_t i) { for_each(m, [=](std::size_t j) { ++visit[i * m + j]; }); });
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), static_cast<long>(n * m));
}

TEST(Parallel, SumHasTheSameBitsForAnyNumberOfThreads) {
  for (const std::size_t n : counts) {
    const std::vector<double> numbers = rough_numbers(n);
    const double* const x = numbers.data();
    std::vector<std::uint64_t> bits;
    for (int n_threads = 1; n_threads <= 4; ++n_threads) {
      set_threads(n_threads);
      bits.push_back(std::bit_cast<std::uint64_t>(sum<double>(n, [=](std::size_t i) { return x[i]; })));
    }
    EXPECT_EQ(std::count(bits.begin(), bits.end(), bits[0]), 4) << n;
  }
}

TEST(Parallel, SumIsTheSum) {
  for (const std::size_t n : counts) {
    const auto total = static_cast<double>(n);
    EXPECT_EQ(sum<double>(n, [](std::size_t i) { return static_cast<double>(i) + 1; }),
              total * (total + 1) / 2);
    const Vec3 vector = sum<Vec3>(n, [](std::size_t) { return Vec3{1, 0, -2}; });
    EXPECT_EQ(vector, (Vec3{total, 0, -2 * total}));
  }
}

TEST(Parallel, BindingThreadsDoesNotShrinkWhatMayBeUsedLater) {
  set_threads(0);
  const int all = threads();
  EXPECT_GE(all, 1);
  set_threads(std::min(2, all));
  set_threads(0);
  EXPECT_EQ(threads(), all);
}

TEST(Parallel, MoreThreadsThanProcessorsAreAllowed) {
  const int many = static_cast<int>(allowed_processors().size()) + 3;
  set_threads(many);
  EXPECT_EQ(threads(), many);
  EXPECT_EQ(sum<double>(10000, [](std::size_t) { return 1.0; }), 10000);
}

}  // namespace
}  // namespace geist
