// The command line itself, and the commands that run nothing.
#include "apps/program.hpp"

namespace geist {
namespace {

using Commands = testing::Program;
namespace fs = std::filesystem;

TEST_F(Commands, VersionAndHelpAreOnStandardOutput) {
  const auto version = run({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out.rfind("geist ", 0), 0u) << version.out;
  EXPECT_TRUE(isdigit(version.out.at(6)));
  EXPECT_EQ(version.err, "");
  const auto help = run({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const std::string word : {"run", "check", "schema", "reference", "Exit codes"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  const auto run_help = run({"run", "--help"});
  EXPECT_EQ(run_help.code, 0);
  for (const std::string word : {"--out", "--force", "--threads", "--quiet", "--set"})
    EXPECT_NE(run_help.out.find(word), std::string::npos) << word;
}

TEST_F(Commands, MisuseIsBadInput) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{},
                                                {"walk"},
                                                {"run"},
                                                {"run", "case.toml", "--thread", "2"},
                                                {"run", "case.toml", "--threads", "0"},
                                                {"run", "case.toml", "--threads", "two"},
                                                {"run", "case.toml", "--set", "nonsense"},
                                                {"check"}}) {
    const auto ended = run(words);
    EXPECT_EQ(ended.code, 2);
    EXPECT_FALSE(ended.err.empty());
    EXPECT_EQ(ended.out, "");
  }
  EXPECT_FALSE(exists("results"));
}

TEST_F(Commands, CheckDescribesTheCaseAndWritesNothing) {
  const auto ended = run({"check", "case.toml"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const std::string word : {"left", "right", "128 particles", "16 hexahedra"})
    EXPECT_NE(ended.out.find(word), std::string::npos) << ended.out;
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_), {}), 3);  // the case and our two outputs
}

TEST_F(Commands, CheckReportsEveryErrorWithItsPlace) {
  write("bad.toml", testing::beam + "[output]\nfeilds = 1\n[coupling]\ntype = \"glue\"\n");
  const auto ended = run({"check", "bad.toml"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("bad.toml:30:"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("bad.toml:32:"), std::string::npos) << ended.err;
}

TEST_F(Commands, SchemaIsJsonAndTheReferenceMarkdown) {
  const auto schema = run({"schema"});
  EXPECT_EQ(schema.code, 0);
  EXPECT_TRUE(nlohmann::json::parse(schema.out).contains("properties"));
  const auto reference = run({"reference"});
  EXPECT_EQ(reference.code, 0);
  EXPECT_EQ(reference.out.rfind("# ", 0), 0u);
}

}  // namespace
}  // namespace geist
