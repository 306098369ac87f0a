// A case with contact, from its file to its results.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "apps/program.hpp"

namespace geist {
namespace {

using Contact = testing::Program;

/// One particle above a block, on its way down.
const std::string drop = R"(units = { length = "mm", mass = "g", time = "ms" }
[materials.m]
density = 0.001
young = 1000
poisson = 0.2
[regions.block]
type = "hexahedra"
material = "m"
box = [[0, 0, 0], [2, 2, 1]]
divisions = [4, 4, 2]
[regions.ball]
type = "lattice"
material = "m"
box = [[0.55, 0.55, 1.01], [0.95, 0.95, 1.41]]
radius = 0.2
[[contact]]
between = ["ball", "block"]
law = "hertz"
[[supports]]
where = { z = 0 }
fix = ["x", "y", "z"]
[[initial]]
where = { region = "ball" }
velocity = [0, 0, -2]
[analysis]
type = "dynamic"
duration = 0.05
[probes.ball]
where = { region = "ball" }
quantity = "contact-force"
component = "z"
[probes.block]
where = { region = "block" }
quantity = "contact-force"
component = "z"
[probes.speed]
where = { region = "ball" }
quantity = "velocity"
component = "z"
[output]
history = { every = 1e-4 }
)";

/// Column of a history by its name.
std::vector<double> column(const std::string& history, const std::string& name) {
  std::istringstream lines(history);
  std::string line, cell;
  std::getline(lines, line);
  std::istringstream header(line);
  int wanted = 0;
  while (std::getline(header, cell, ',') && cell != name) ++wanted;
  std::vector<double> values;
  while (std::getline(lines, line)) {
    std::istringstream row(line);
    for (int c = 0; c <= wanted; ++c) std::getline(row, cell, ',');
    values.push_back(std::stod(cell));
  }
  return values;
}

TEST_F(Contact, AParticleBouncesOffABlock) {
  write("drop.toml", drop);
  const auto ended = run({"run", "drop.toml", "--out", "out"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const auto summary = this->summary("out");
  EXPECT_EQ(summary["status"], "completed");
  EXPECT_TRUE(summary["warnings"].empty());
  EXPECT_GT(summary["probes"]["speed"], 1.5);
  EXPECT_EQ(summary["probes"]["ball"], 0);
  EXPECT_LT(std::abs(summary["ledger"]["balance"].get<double>()),
            1e-3 * summary["ledger"]["initial"].get<double>());
  EXPECT_EQ(summary["ledger"]["contact"], 0);
  const std::string history = read("out/history.csv");
  const auto ball = column(history, "ball"), block = column(history, "block");
  EXPECT_GT(*std::max_element(ball.begin(), ball.end()), 0.05);
  for (std::size_t i = 0; i < ball.size(); ++i) EXPECT_NEAR(ball[i], -block[i], 1e-12);
  const auto stored = column(history, "contact");
  EXPECT_GT(*std::max_element(stored.begin(), stored.end()), 1e-5);
  EXPECT_EQ(ended.out.find("contact damping"), std::string::npos) << "there is none";
}

TEST_F(Contact, IsDescribedByCheck) {
  write("drop.toml", drop);
  const auto ended = run({"check", "drop.toml", "--set", "contact.0.friction=0.25"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const std::string words :
       {"Contact\n  block - ball", "hertz, friction 0.25; ", "N/mm^1.5 for a particle", "64 facets"})
    EXPECT_NE(ended.out.find(words), std::string::npos) << ended.out;
}

/// Much too soft: the particle goes in further than its radius, which is said once, even quietly.
TEST_F(Contact, WarnsOfDeepOverlap) {
  write("drop.toml", drop);
  const auto ended = run({"run", "drop.toml", "--out", "out", "--quiet", "--set",
                          "contact.0.stiffness_factor=1e-6", "--set", "analysis.duration=0.13"});
  const auto warnings = summary("out")["warnings"];
  ASSERT_EQ(warnings.size(), 1u);
  const std::string warning = warnings[0];
  for (const std::string words : {"step ", "region 'ball', site (", "deep in region 'block'",
                                  "at most: raise stiffness_factor, or refine"})
    EXPECT_NE(warning.find(words), std::string::npos) << warning;
  EXPECT_NE(ended.err.find("geist: warning: " + warning + "\n"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace geist
