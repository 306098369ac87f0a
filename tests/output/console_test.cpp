#include "output/console.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "output/progress.hpp"

namespace geist::output {
namespace {

TEST(Console, NumbersForPeople) {
  EXPECT_EQ(with_commas(0), "0");
  EXPECT_EQ(with_commas(999), "999");
  EXPECT_EQ(with_commas(12345), "12,345");
  EXPECT_EQ(with_commas(-123456789), "-123,456,789");
  EXPECT_EQ(with_commas(-123), "-123");
  EXPECT_EQ(human_bytes(512), "512 B");
  EXPECT_EQ(human_bytes(1.5 * 1024 * 1024), "1.5 MiB");
  EXPECT_EQ(human_seconds(0.0032), "3.2 ms");
  EXPECT_EQ(human_seconds(12.34), "12.3 s");
  EXPECT_EQ(human_seconds(80.2), "1 min 20 s");
  EXPECT_EQ(human_seconds(59.97), "1 min");
  EXPECT_EQ(human_seconds(3599.7), "1 h");
  EXPECT_EQ(human_seconds(7500), "2 h 5 min");
  EXPECT_EQ(human_seconds(86399), "1 d");
  EXPECT_EQ(human_seconds(100 * 3600), "4 d 4 h");
  EXPECT_EQ(human_seconds(std::nan("")), "-");
}

TEST(Console, TablesAreAligned) {
  EXPECT_EQ(to_text({{"name", "value"}, {{"é", "1"}, {"long", "1234567"}}}),
            "  name    value\n"
            "  é           1\n"
            "  long  1234567\n");
}

TEST(Console, EndOfRunTables) {
  const UnitSystem units("mm", "g", "ms");
  Ledger ledger;
  ledger.kinetic_translation = 1, ledger.strain_bonds = 3, ledger.external = 4.0008;
  EXPECT_EQ(to_text(ledger_table(ledger, units)),
            "  energy                    mJ    share\n"
            "  kinetic translation        1   25.0 %\n"
            "  strain bonds               3   75.0 %\n"
            "  external              4.0008  100.0 %\n"
            "  balance              -0.0008  -0.02 %\n");
  EXPECT_EQ(to_text(probe_table(std::vector<ProbeValue>{{"tip", dimension::length, -11.8765432}}, units)),
            "  probe     value  unit\n"
            "  tip    -11.8765    mm\n");
  EXPECT_EQ(to_text(timing_table(std::vector<Phase>{{"bonds", 3}, {"elements", 1}})),
            "  phase      time    share\n"
            "  bonds     3.0 s   75.0 %\n"
            "  elements  1.0 s   25.0 %\n"
            "  total     4.0 s  100.0 %\n");
}

double now = 0;
double test_clock() { return now; }

/// What a progress writes to its stream.
template <class F>
std::string shown(Progress::Style style, F run) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* out = open_memstream(&text, &size);
  now = 100;
  {
    Progress progress(out, style, "ms", test_clock);
    run(progress);
  }
  std::fclose(out);
  const std::string result(text, size);
  std::free(text);
  return result;
}

TEST(Progress, LinesShowStepTimeBalanceSpeedAndTimeLeft) {
  EXPECT_EQ(shown(Progress::Style::lines,
                  [](Progress& progress) {
                    now += 10;
                    progress.show({.step = 12345, .time = 0.25, .fraction = 0.1, .balance = -1.25e-7});
                  }),
            "step 12,345 | 0.25 ms | 10 % | balance -1.2e-07 | 1,235 steps/s | 1 min 30 s left\n");
}

TEST(Progress, LinesComeEveryTenSecondsAndAtEachTenth) {
  shown(Progress::Style::lines, [](Progress& progress) {
    EXPECT_FALSE(progress.due(0.05));
    EXPECT_TRUE(progress.due(0.1));
    progress.show({.step = 1, .time = 1, .fraction = 0.1});
    EXPECT_FALSE(progress.due(0.15));
    now += 9.9;
    EXPECT_FALSE(progress.due());
    now += 0.2;
    EXPECT_TRUE(progress.due());
  });
}

TEST(Progress, LiveLineIsOverwrittenAndRemoved) {
  const std::string text = shown(Progress::Style::live, [](Progress& progress) {
    EXPECT_FALSE(progress.due(0.9));
    now += 0.25;
    EXPECT_TRUE(progress.due());
    progress.show({.step = 1000, .time = 0.125, .residual = 0.5, .tolerance = 1e-6});
    progress.show({.step = 1000, .time = 1});
  });
  const std::string first = "step 1,000 | 0.125 ms | residual 5.00e-01 | 4,000 steps/s";
  const std::string second = "step 1,000 | 1 ms | 4,000 steps/s";
  const std::string cover(first.size() - second.size(), ' '), blank(second.size(), ' ');
  EXPECT_EQ(text, "\r" + first + "\r" + second + cover + "\r" + blank + "\r");
}

TEST(Progress, WhatIsSaidStays) {
  EXPECT_EQ(shown(Progress::Style::live,
                  [](Progress& progress) {
                    progress.show({.step = 1, .time = 0});
                    progress.say("wrote fields");
                  }),
            "\rstep 1 | 0 ms\r             \rwrote fields\n");
}

TEST(Progress, QuietPrintsNothing) {
  EXPECT_EQ(shown(Progress::Style::quiet,
                  [](Progress& progress) {
                    now += 100;
                    EXPECT_FALSE(progress.due(0.5));
                    progress.show({.step = 1, .time = 0});
                    progress.say("hello");
                  }),
            "");
}

TEST(Progress, AStreamThatIsFullDoesNotEndTheRun) {
  std::FILE* full = std::fopen("/dev/full", "w");
  Progress progress(full, Progress::Style::lines, "ms", test_clock);
  EXPECT_NO_THROW(progress.show({.step = 1, .time = 0}));
  std::fclose(full);
}

TEST(Decay, EstimatesWhenTheResidualReachesItsTolerance) {
  DecayEstimate decay;
  EXPECT_TRUE(std::isnan(decay.seconds_left(1e-6)));
  for (int i = 0; i <= 1000; ++i) decay.add(i, std::pow(10, -i / 500.0) * (1 + 0.3 * std::sin(i)));
  EXPECT_NEAR(decay.seconds_left(1e-6), 2000, 60);
  EXPECT_EQ(decay.seconds_left(0.5), 0);
}

TEST(Decay, KeepsSilentWhileTheResidualGrows) {
  DecayEstimate decay;
  for (int i = 0; i < 50; ++i) decay.add(i, 1.0 + i);
  decay.add(50, 0.0), decay.add(51, std::nan(""));
  EXPECT_TRUE(std::isnan(decay.seconds_left(1e-6)));
}

}  // namespace
}  // namespace geist::output
