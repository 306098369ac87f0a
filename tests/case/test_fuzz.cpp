// Damaged cases: whatever is done to the text, it is read or refused with a place, and nothing worse.
#include <gtest/gtest.h>

#include <random>

#include "case/everything.hpp"
#include "case/malformed.hpp"
#include "case/read.hpp"

namespace geist {

namespace {

/// Read it; every diagnostic must have a place in the text.
void survive(const std::string& text, const std::vector<std::string>& set = {}) {
  try {
    const Case result = read_case_text(text, "case.toml", set);
    EXPECT_FALSE(result.regions.empty());
  } catch (const CaseError& error) {
    ASSERT_FALSE(error.diagnostics().empty());
    const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
    for (const Diagnostic& diagnostic : error.diagnostics()) {
      if (diagnostic.file == "case.toml" && diagnostic.message != "is not a text file") {
        EXPECT_GE(diagnostic.line, 1) << error.what();
        EXPECT_LE(diagnostic.line, lines + 1) << error.what();
        EXPECT_GE(diagnostic.column, 1) << error.what();
      }
      EXPECT_FALSE(diagnostic.message.empty());
    }
  }
}

/// One random change: a byte, a piece left out, doubled or moved, or a number or word replaced.
std::string damaged(const std::string& text, std::mt19937& random) {
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  static const std::vector<std::string> pieces{
      "0",       "-1",        "1e308",    "1e-308", "nan", "-inf", "99999999999999999999", "\"\"",
      "\"x\"",   "[]",        "{}",       "[[",     "]]",  "true", "2020-01-01",           "\n",
      "=",       ".",         "'''",      "\"\"\"", "#",   "0x",   "\xF0\x9F\x91\xBB",     "\xC3",
      "[a.b]\n", "a.b.c=1\n", "{ x = 0 }"};
  std::string result = text;
  const std::size_t at = below(result.size()),
                    length = 1 + below(std::min<std::size_t>(30, result.size() - at));
  switch (below(5)) {
    case 0:
      result[at] = static_cast<char>(below(256));
      break;
    case 1:
      result.erase(at, length);
      break;
    case 2:
      result.insert(below(result.size()), result.substr(at, length));
      break;
    case 3:
      result.replace(at, length, pieces[below(pieces.size())]);
      break;
    default:
      result.insert(at, pieces[below(pieces.size())]);
      break;
  }
  return result;
}

/// Replace one value of the case (the text after a "=") by something of another kind.
std::string revalued(const std::string& text, std::mt19937& random) {
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  static const std::vector<std::string> values{"0",
                                               "-1",
                                               "1e308",
                                               "5e-324",
                                               "\"x\"",
                                               "[]",
                                               "{}",
                                               "true",
                                               "[[1, 2], [3, 4]]",
                                               "[1, 2, 3]",
                                               "[[0, 0, 0], [1e300, 1e300, 1e300]]",
                                               "[{ x = 1 }]",
                                               "\"lattice\"",
                                               "[[0, 0, 0], [1e-300, 1, 1]]",
                                               "9223372036854775807",
                                               "\"polymer\""};
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n' && text.rfind(" = ", i) != std::string::npos) ends.push_back(i);
  const std::size_t end = ends[below(ends.size())], begin = text.rfind(" = ", end) + 3;
  return text.substr(0, begin) + values[below(values.size())] + text.substr(end);
}

TEST(Damage, EveryTruncation) {
  for (const std::string text : {good_case, everything})
    for (std::size_t length = 0; length <= text.size(); ++length) survive(text.substr(0, length));
}

TEST(Damage, EveryLineLeftOut) {
  const std::string text = everything;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin) + 1;
    survive(text.substr(0, begin) + text.substr(end));
    begin = end;
  }
}

TEST(Damage, RandomChanges) {
  std::mt19937 random(20240501);
  for (int i = 0; i < 6000; ++i) {
    std::string text = i % 2 ? everything : good_case;
    for (int changes = 1 + i % 4; changes > 0; --changes) text = damaged(text, random);
    survive(text);
  }
}

TEST(Damage, RandomValues) {
  std::mt19937 random(7);
  for (int i = 0; i < 4000; ++i) {
    std::string text = i % 2 ? everything : good_case;
    for (int changes = 1 + i % 3; changes > 0; --changes) text = revalued(text, random);
    survive(text);
  }
}

TEST(Damage, RandomOptions) {
  std::mt19937 random(11);
  for (int i = 0; i < 3000; ++i)
    survive(good_case, {damaged("regions.middle.box=[[2, 0, 0], [4, 2, 2]]", random)});
}

std::string repeated(const std::string& piece, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += piece;
  return text;
}

TEST(Damage, DeepNesting) {
  constexpr int deep = 100000;
  survive("a" + repeated(".a", deep) + " = 1");
  survive("[a" + repeated(".a", deep) + "]");
  survive("\"=\"" + repeated(".\",\".a", deep) + " = 1");
  survive("x = { '' = \"\"\"\n\"\"\", b" + repeated(".'#'.b", deep) + " = 1 }");
  survive("a = " + repeated("[", deep) + repeated("]", deep));
  survive("a = " + repeated("{a=", deep) + "1" + repeated("}", deep));
  survive("a" + repeated(".a", 990) + " = 1");
  survive(repeated("[[a]]\n", deep / 10));
  survive(repeated("[", deep));
}

TEST(Damage, LongLinesOfNumbersAreFine) {
  std::string text = good_case;
  std::string points = "[0.0, 0.0]";
  for (int i = 1; i < 3000; ++i) points += ", [" + std::to_string(i) + ".5, 0.5]";
  text.replace(text.find("[0, 0], [1, 1]"), 14, points);
  EXPECT_EQ(read_case_text(text, "case.toml").curves.at("ramp").points.size(), 3000u);
}

TEST(Damage, ManyProblems) {
  std::string text = good_case;
  for (int i = 0; i < 20000; ++i) text += "unknown" + std::to_string(i) + " = 1\n";
  survive(text);
}

}  // namespace

}  // namespace geist
