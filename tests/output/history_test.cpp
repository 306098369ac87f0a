#include "output/history.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "output/support.hpp"

namespace geist::output {
namespace {

using geist::testing::error_of;
using geist::testing::read_text;
using geist::testing::Scratch;

std::vector<std::vector<std::string>> cells(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream in(line + ",end");
    std::vector<std::string> row;
    for (std::string cell; std::getline(in, cell, ',');) row.push_back(cell);
    row.pop_back();
    rows.push_back(row);
  }
  return rows;
}

const std::vector<ProbeValue> probes{{"tip", dimension::length}, {"reaction", dimension::force}};

TEST(History, RowsReadBackBitForBit) {
  const Scratch scratch;
  History history(scratch / "history.csv", probes);
  HistoryRow row{.step = 12, .time = 0.1, .probes = {1.0 / 3, -1e-300}, .ledger = {}, .residual = 5e-324};
  row.ledger.kinetic_translation = std::nextafter(1.0, 2.0), row.ledger.external = 1e22;
  row.ledger.angular = {0, 0, -0.0};
  history.write(row);
  const auto read = cells(read_text(scratch / "history.csv"));  // while the history is still open
  ASSERT_EQ(read.size(), 2u);
  ASSERT_EQ(read[0].size(), read[1].size());
  std::map<std::string, double> value;
  for (std::size_t c = 0; c < read[0].size(); ++c)
    value[read[0][c]] = std::strtod(read[1][c].c_str(), nullptr);
  EXPECT_EQ(value["step"], 12);
  EXPECT_EQ(value["time"], 0.1);
  EXPECT_EQ(value["tip"], 1.0 / 3);
  EXPECT_EQ(value["reaction"], -1e-300);
  EXPECT_EQ(value["kinetic_translation"], std::nextafter(1.0, 2.0));
  EXPECT_EQ(value["external"], 1e22);
  EXPECT_EQ(value["balance"], row.ledger.balance());
  EXPECT_TRUE(std::signbit(value["angular_momentum_z"]));
  EXPECT_EQ(value["residual"], 5e-324);
}

TEST(History, HeaderNamesEveryColumn) {
  const Scratch scratch;
  History(scratch / "history.csv", probes);
  EXPECT_EQ(read_text(scratch / "history.csv"),
            "step,time,tip,reaction,kinetic_translation,kinetic_rotation,strain_elements,strain_bonds,"
            "strain_coupling,hourglass,contact,damping,friction,contact_damping,external,initial,balance,"
            "momentum_x,momentum_y,momentum_z,"
            "angular_momentum_x,angular_momentum_y,angular_momentum_z,residual\n");
}

TEST(History, WhatDoesNotExistIsEmpty) {
  const Scratch scratch;
  History history(scratch / "history.csv", {});
  history.write({.step = 1, .time = 0.5, .probes = {}, .ledger = {}});
  EXPECT_TRUE(
      read_text(scratch / "history.csv").ends_with("\n1,0.5,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,\n"));
}

TEST(History, AwkwardNamesAreQuotedAndClashesRefused) {
  const Scratch scratch;
  History(scratch / "history.csv", std::vector<ProbeValue>{{"a, \"b\"", dimension::length}});
  EXPECT_TRUE(read_text(scratch / "history.csv").starts_with("step,time,\"a, \"\"b\"\"\",kinetic"));
  EXPECT_THROW(History(scratch / "history.csv", std::vector<ProbeValue>{{"time", dimension::length}}),
               std::invalid_argument);
}

TEST(History, FullDiskIsNoticedAtOnce) {
  EXPECT_EQ(error_of([] { History("/dev/full", probes); }),
            "cannot write /dev/full: No space left on device");
}

}  // namespace
}  // namespace geist::output
