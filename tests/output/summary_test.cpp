#include "output/summary.hpp"

#include <gtest/gtest.h>

#include "output/support.hpp"

namespace geist::output {
namespace {

using geist::testing::error_of;
using geist::testing::FullDisk;
using geist::testing::read_text;
using geist::testing::Scratch;

RunSummary example() {
  RunSummary s;
  s.title = "Cantilever \"with\" a middle";
  s.status = "completed";
  s.units = {"mm", "g", "ms"};
  s.probes = {{"tip", dimension::length, -1.0 / 3}, {"missing", dimension::force}};
  s.ledger.strain_bonds = 2, s.ledger.external = 3, s.ledger.linear = {1, 2, 3};
  s.ledger.friction = 0.25, s.warnings = {"deep"};
  s.counts = count(geist::testing::small_model());
  s.time_step = {1e-3, 1.1e-3, "region middle: bonds", 3, 8, 12};
  s.steps = 42, s.time = 0.5, s.threads = 4;
  s.phases = {{"set-up", 0.25}, {"bonds", 0.5}};
  s.versions = library_versions();
  s.complete_case = {{"title", "x"}, {"regions", {{"left", {{"divisions", {14, 4, 4}}}}}}};
  return s;
}

TEST(Summary, ReadsBack) {
  const Scratch scratch;
  write_summary(scratch / "summary.json", example());
  const auto json = nlohmann::json::parse(read_text(scratch / "summary.json"));
  EXPECT_EQ(json["title"], "Cantilever \"with\" a middle");
  EXPECT_EQ(json["status"], "completed");
  EXPECT_EQ(json["probes"]["tip"].get<double>(), -1.0 / 3);
  EXPECT_TRUE(json["probes"]["missing"].is_null());
  EXPECT_EQ(json["units"]["length"], "mm");
  EXPECT_EQ(json["units"]["energy"], "mJ");
  EXPECT_EQ(json["units"]["history"]["tip"], "mm");
  EXPECT_EQ(json["units"]["history"]["balance"], "mJ");
  EXPECT_EQ(json["units"]["fields"]["stress"], "MPa");
  EXPECT_EQ(json["ledger"]["balance"], -0.75);
  EXPECT_EQ(json["ledger"]["friction"], 0.25);
  EXPECT_EQ(json["warnings"], nlohmann::json({"deep"}));
  EXPECT_EQ(json["units"]["fields"]["contact_force"], "N");
  EXPECT_EQ(json["ledger"]["momentum_y"], 2);
  EXPECT_EQ(json["counts"]["particles"], 12);
  EXPECT_EQ(json["time_step"]["limited_by"], "region middle: bonds");
  EXPECT_EQ(json["time_step"]["substeps"], 3);
  EXPECT_EQ(json["time_step"]["fine_hexahedra"], 8);
  EXPECT_EQ(json["time_step"]["fine_particles"], 12);
  EXPECT_EQ(json["steps"], 42);
  EXPECT_TRUE(json["quasi_static"].is_null());
  EXPECT_EQ(json["wall_seconds"]["total"], 0.75);
  EXPECT_EQ(json["wall_seconds"]["phases"]["bonds"], 0.5);
  EXPECT_EQ(json["case"]["regions"]["left"]["divisions"][0], 14);
  EXPECT_TRUE(json["versions"].contains("compiler"));
}

TEST(Summary, TellsWhetherAQuasiStaticRunConverged) {
  RunSummary s = example();
  s.quasi_static = Convergence{1e-3, 1e-6, false};
  const auto json = to_json(s);
  EXPECT_EQ(json["quasi_static"]["residual"], 1e-3);
  EXPECT_EQ(json["quasi_static"]["converged"], false);
}

TEST(Summary, CountsEachBondOnce) {
  const Counts counts = count(geist::testing::small_model());
  EXPECT_EQ(counts.nodes, 12u);
  EXPECT_EQ(counts.hexahedra, 2u);
  EXPECT_EQ(counts.particles, 12u);
  EXPECT_EQ(counts.ghosts, 4u);
  // 4 × 2 × 2 sites: along x 12, y 8, z 8; diagonals xy 12, xz 12, yz 8; less those among the 4 ghosts: 2 + 2
  // + 2
  EXPECT_EQ(counts.bonds, 54u);
  EXPECT_EQ(counts.degrees_of_freedom, 3u * 12 + 6 * 12);
}

TEST(Summary, BadTextAndFullDisk) {
  const Scratch scratch;
  RunSummary s = example();
  s.title = "\xff\xfe";
  write_summary(scratch / "summary.json", s);
  EXPECT_TRUE(nlohmann::json::accept(read_text(scratch / "summary.json")));
  const FullDisk full(100);
  const std::string path = scratch / "other.json";
  EXPECT_EQ(error_of([&] { write_summary(path, s); }), "cannot write " + path + ": File too large");
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace geist::output
