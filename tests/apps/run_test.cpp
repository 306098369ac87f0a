// geist run: results, exit codes, and what it leaves alone.
#include <algorithm>

#include "apps/program.hpp"

namespace geist {
namespace {

using testing::Program;
using Words = std::vector<std::string>;

const char* const all_results[] = {"case-as-run.toml", "history.csv", "summary.json", "fields.pvd"};

using Running = Program;

TEST_F(Running, CompletesAndWritesItsResults) {
  const auto ended = run({"run", "case.toml", "--out", "out"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const std::string name : all_results) EXPECT_TRUE(exists("out/" + name)) << name;
  EXPECT_TRUE(exists("out/fields"));
  const auto summary = this->summary("out");
  EXPECT_EQ(summary["status"], "completed");
  EXPECT_NE(ended.out.find("completed"), std::string::npos);
  EXPECT_NE(ended.out.find("tip"), std::string::npos);
}

TEST_F(Running, SolvesAStaticCase) {
  const auto ended = run({"run", "case.toml", "--out", "out", "--set", "analysis.type=static"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const std::string name : all_results) EXPECT_TRUE(exists("out/" + name)) << name;
  const auto summary = this->summary("out");
  EXPECT_GT(summary["static"]["iterations"], 0);
  EXPECT_TRUE(summary["static"]["converged"]);
  EXPECT_LE(summary["static"]["residual"], summary["static"]["tolerance"]);
  EXPECT_TRUE(summary["quasi_static"].is_null());
  EXPECT_NE(ended.out.find(" iterations in "), std::string::npos) << ended.out;
}

TEST_F(Running, SaysWhichRegionHasNoStateOfRest) {
  const auto ended = run({"run", "case.toml", "--out", "out", "--quiet", "--set", "analysis.type=static",
                          "--set", "coupling.type=none"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.err.find("region 'right' is free to move"), std::string::npos) << ended.err;
  EXPECT_EQ(summary("out")["status"], "failed");
}

TEST_F(Running, StartsAMotionFromEquilibrium) {
  const auto ended = run({"run", "case.toml", "--out", "out", "--quiet", "--set",
                          "analysis={type=\"dynamic\",start=\"static\",duration=0.01}"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const auto summary = this->summary("out");
  EXPECT_GT(summary["static"]["iterations"], 0);
  EXPECT_LT(summary["ledger"]["kinetic_translation"], 1e-12);
  EXPECT_GT(summary["ledger"]["initial"], 1e-6);
}

TEST_F(Running, NamesItsResultsAfterTheCase) {
  write("short.toml", testing::beam);
  EXPECT_EQ(run({"run", "short.toml", "--quiet"}).code, 0);
  EXPECT_TRUE(exists("results/short/summary.json"));
  EXPECT_EQ(run({"run", "case.toml", "--quiet"}).code, 0);
  EXPECT_TRUE(exists("results/" + directory_.filename().string() + "/summary.json"));
}

TEST_F(Running, CanBeRepeatedFromTheCaseThatItWrote) {
  EXPECT_EQ(run({"run", "case.toml", "--out", "out", "--set", "regions.right.radius=0.25", "--quiet"}).code,
            0);
  EXPECT_EQ(run({"run", "out/case-as-run.toml", "--out", "again", "--quiet"}).code, 0);
  EXPECT_EQ(summary("out")["state_hash"], summary("again")["state_hash"]);
  EXPECT_EQ(read("out/history.csv"), read("again/history.csv"));
}

TEST_F(Running, EndsWithTwoForBadInputAndWritesNothing) {
  const Words bad[] = {
      {"run", "case.toml", "--set", "regions.right.radius=0.3"},              // no whole number of diameters
      {"run", "case.toml", "--set", "regions.right.raduis=0.25"},             // unknown key
      {"run", "case.toml", "--set", "supports.0.where.x=77"},                 // selects nothing
      {"run", "case.toml", "--set", "analysis.time_step=1"},                  // too long
      {"run", "case.toml", "--set", "regions.left.box=[[0,0,0],[2.1,1,1]]"},  // overlap
      {"run", "missing.toml"},
      {"run", "."}};
  for (Words words : bad) {
    words.insert(words.end(), {"--out", "out"});
    const auto ended = run(words);
    EXPECT_EQ(ended.code, 2) << words[words.size() - 3];
    EXPECT_FALSE(ended.err.empty());
    EXPECT_EQ(ended.out, "");
    EXPECT_FALSE(exists("out"));
  }
}

TEST_F(Running, EndsWithThreeWhereItDoesNotConverge) {
  const auto ended = run({"run", "case.toml", "--out", "out", "--set", "analysis.max_steps=200"});
  EXPECT_EQ(ended.code, 3);
  for (const std::string name : all_results) EXPECT_TRUE(exists("out/" + name)) << name;
  const auto summary = this->summary("out");
  EXPECT_EQ(summary["status"], "not converged");
  EXPECT_EQ(summary["case"]["analysis"]["max_steps"], 200);
  EXPECT_NE(ended.err.find("not converged"), std::string::npos);
}

TEST_F(Running, DoesNotTouchResultsThatAreThere) {
  ASSERT_EQ(run({"run", "case.toml", "--out", "out", "--quiet"}).code, 0);
  const auto before = contents("out");
  EXPECT_GE(before.size(), 5u);
  const auto ended = run({"run", "case.toml", "--out", "out", "--set", "regions.right.radius=0.25"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("--force"), std::string::npos);
  EXPECT_EQ(contents("out"), before);
}

TEST_F(Running, OverwritesResultsAndNothingElseIfForced) {
  ASSERT_EQ(run({"run", "case.toml", "--out", "out", "--quiet", "--set", "output.fields.every=0.01"}).code,
            0);
  const std::size_t many = contents("out").size();
  write("out/notes.txt", "mine");
  const auto ended =
      run({"run", "case.toml", "--out", "out", "--force", "--set", "regions.right.radius=0.25"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(read("out/notes.txt"), "mine");
  EXPECT_EQ(summary("out")["case"]["regions"]["right"]["radius"], 0.25);
  EXPECT_LT(contents("out").size(), many);  // the first run's fields are gone
}

TEST_F(Running, KeepsResultsIfTheForcedCaseIsBad) {
  ASSERT_EQ(run({"run", "case.toml", "--out", "out", "--quiet"}).code, 0);
  const auto before = contents("out");
  EXPECT_EQ(run({"run", "case.toml", "--out", "out", "--force", "--set", "supports.0.where.x=77"}).code, 2);
  EXPECT_EQ(contents("out"), before);
}

TEST_F(Running, SaysSoIfItCannotWrite) {
  write("file", "not a directory");
  for (const std::string out : {"file", "file/out", "/proc/geist"}) {
    const auto ended = run({"run", "case.toml", "--out", out});
    EXPECT_EQ(ended.code, 2) << out;
    EXPECT_NE(ended.err.find(out.substr(0, 4)), std::string::npos) << ended.err;
  }
  EXPECT_EQ(read("file"), "not a directory");
}

TEST_F(Running, QuietlySaysNothing) {
  const auto ended = run({"run", "case.toml", "--out", "out", "--quiet"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.out, "");
  EXPECT_EQ(ended.err, "");
}

TEST_F(Running, DoesNotMindAFullTerminal) {
  const auto ended = run({"run", "case.toml", "--out", "out"}, "/dev/full");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(summary("out")["status"], "completed");
}

TEST_F(Running, EndsInTheSameStateWithAnyNumberOfThreads) {
  const Words common{
      "run",    "case.toml", "--set", "analysis.max_steps=300", "--set", "regions.right.radius=0.0625",
      "--quiet"};
  std::vector<std::string> hashes;
  for (const std::string n : {"1", "3", "4"}) {
    Words words = common;
    words.insert(words.end(), {"--threads", n, "--out", "out" + n});
    EXPECT_EQ(run(words).code, 3);
    EXPECT_EQ(summary("out" + n)["threads"], std::stoi(n));
    hashes.push_back(summary("out" + n)["state_hash"]);
    EXPECT_EQ(read("out" + n + "/history.csv"), read("out1/history.csv"));
  }
  EXPECT_EQ(hashes[0].size(), 16u);
  EXPECT_EQ(std::count(hashes.begin(), hashes.end(), hashes[0]), 3);
}

TEST_F(Running, FailsWhereTheEnergyBalanceIsBroken) {
  // No run balances to within rounding of its energies, so this one must end and say why.
  const auto ended = run({"run", "case.toml", "--out", "out", "--set", "analysis.type=dynamic", "--set",
                          "analysis.duration=1", "--set", "analysis.balance_tolerance=1e-12"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(summary("out")["status"], "failed");
  EXPECT_NE(ended.err.find("balance"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace geist
