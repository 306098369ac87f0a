// Every malformed case is answered with one clear message at the right place; docs/malformed-cases.md shows
// them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <set>

#include "case/generated.hpp"
#include "case/malformed.hpp"
#include "case/read.hpp"

namespace geist {

namespace {

std::vector<Diagnostic> diagnostics_of(const Malformed& malformed) {
  try {
    read_case_text(malformed_text(malformed), "case.toml", malformed_options(malformed));
  } catch (const CaseError& error) {
    return error.diagnostics();
  }
  return {};
}

class MalformedCase : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedCase, IsRefused) {
  const Malformed& expected = GetParam();
  const std::vector<Diagnostic> found = diagnostics_of(expected);
  ASSERT_EQ(found.size(), expected.problems) << (found.empty() ? "" : CaseError(found).what());
  EXPECT_EQ(found[0].line, expected.line) << found[0].describe();
  EXPECT_EQ(found[0].column, expected.column) << found[0].describe();
  EXPECT_EQ(found[0].file, expected.line > 0 ? "case.toml" : std::string("--set ") + expected.by);
  for (const char* fragment : expected.fragments)
    EXPECT_TRUE(!fragment || found[0].message.find(fragment) != std::string::npos) << found[0].describe();
}

INSTANTIATE_TEST_SUITE_P(Table, MalformedCase, testing::ValuesIn(malformed_cases()),
                         [](const auto& test) { return std::string(test.param.name); });

/// "NegativeRadius" → "negative radius".
std::string in_words(const std::string& name) {
  std::string words;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z' && !words.empty()) words += ' ';
    words += words.empty() ? c : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return words;
}

/// Code in a cell of a Markdown table.
std::string cell(const std::string& text) {
  std::string code;
  for (const char c : printable(text, 110)) code += c == '|' ? "\\|" : std::string(1, c);
  return fmt::format("<code>{}</code>", code.empty() ? " " : code);
}

/// The changed lines of a case, or its --set option.
std::string written(const Malformed& malformed, const Diagnostic& diagnostic) {
  if (std::string(malformed.replace) == "--set") return cell(std::string("--set ") + malformed.by);
  return diagnostic.excerpt.empty() ? "" : cell(diagnostic.excerpt);
}

std::string document() {
  std::string text =
      "# Malformed cases\n\n<!-- Made from the table of tests/case/malformed*.cpp by its test; do not edit. "
      "-->\n\n"
      "What Geist answers to cases that are wrong in one way. All of them are changes of this good one, "
      "`case.toml`:\n\n```toml\n";
  text += good_case;
  text += "```\n\n| what is wrong | the line that is blamed | message |\n|---|---|---|\n";
  for (const Malformed& malformed : malformed_cases()) {
    const Diagnostic first = diagnostics_of(malformed).at(0);
    const std::string place = first.line > 0 ? fmt::format("{}:{}: ", first.line, first.column) : "";
    text += fmt::format("| {} | {} | {}{} |\n", in_words(malformed.name), written(malformed, first), place,
                        first.message);
  }
  return text;
}

TEST(MalformedCases, AreManyAndDifferent) {
  const std::vector<Malformed> all = malformed_cases();
  std::set<std::string> names;
  for (const Malformed& malformed : all) names.insert(malformed.name);
  EXPECT_EQ(names.size(), all.size());
  EXPECT_GE(all.size(), 70u);
}

TEST(MalformedCases, GoodCaseIsGood) { EXPECT_NO_THROW(read_case_text(good_case, "case.toml")); }

TEST(MalformedCases, AreDocumented) { expect_generated("docs/malformed-cases.md", document()); }

}  // namespace

}  // namespace geist
