// Reading a case.
#include "case/read.hpp"

#include <algorithm>
#include <tuple>

#include "case/check.hpp"
#include "case/document.hpp"
#include "case/extract.hpp"
#include "case/rules.hpp"
#include "case/set.hpp"
#include "case/write.hpp"

namespace geist {

namespace {

/// Problems in the order of the file, those of --set options after them.
[[noreturn]] void fail(std::vector<Diagnostic> problems) {
  std::stable_sort(problems.begin(), problems.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::make_tuple(a.line == 0, a.line, a.column) < std::make_tuple(b.line == 0, b.line, b.column);
  });
  throw CaseError(std::move(problems));
}

Case read(Document document, const std::vector<std::string>& set) {
  apply_sets(document, set);
  drop_outvoted(document);
  check(document);
  fill_defaults(document.root, key_table().front());
  check_rules(document);
  if (!document.problems.empty()) fail(std::move(document.problems));
  Case result = extract(document);
  result.toml = write_toml(document);
  return result;
}

}  // namespace

Case read_case(const std::string& path, const std::vector<std::string>& set) {
  return read(open_document(path), set);
}

Case read_case_text(const std::string& text, const std::string& file, const std::vector<std::string>& set) {
  return read(parse_document(text, file), set);
}

}  // namespace geist
