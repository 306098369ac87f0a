// Diagnostics: how they are printed.
#include "case/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace geist {

namespace {

constexpr std::size_t most_printed = 50;      // diagnostics in what()
constexpr std::size_t longest_excerpt = 160;  // characters

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return !continues(c); }));
}

/// Is the text well-formed enough (UTF-8 lead and continuation bytes) to be printed as it is?
bool well_formed(const std::string& text) {
  int expected = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (expected > 0 ? !continues(c) : byte >= 0x80 && (byte < 0xC2 || byte > 0xF4)) return false;
    expected = expected > 0 ? expected - 1 : byte >= 0xF0 ? 3 : byte >= 0xE0 ? 2 : byte >= 0xC2 ? 1 : 0;
  }
  return expected == 0;
}

/// The line, and below it a caret and tildes under the offending text.
std::string marked(const Diagnostic& d) {
  std::string indent;
  int column = 1;
  for (std::size_t i = 0; i < d.excerpt.size() && column < d.column; ++i) {
    if (continues(d.excerpt[i])) continue;
    indent += d.excerpt[i] == '\t' ? '\t' : ' ';
    ++column;
  }
  const std::size_t room = characters(d.excerpt) + 1 - std::min(characters(d.excerpt), indent.size());
  const std::size_t length = std::clamp<std::size_t>(characters(d.offending), 1, room);
  return fmt::format("\n{:>6} | {}\n       | {}^{}", d.line, d.excerpt, indent, std::string(length - 1, '~'));
}

std::string together(const std::vector<Diagnostic>& all) {
  std::string text;
  for (std::size_t i = 0; i < std::min(all.size(), most_printed); ++i)
    text += (i > 0 ? "\n" : "") + all[i].describe();
  if (all.size() > most_printed) text += fmt::format("\n… and {} more", all.size() - most_printed);
  return text;
}

}  // namespace

std::string Diagnostic::describe() const {
  if (file.rfind("--set ", 0) == 0) return fmt::format("{}: {}", printable(file, 200), message);
  if (line == 0) return fmt::format("{}: error: {}", file, message);
  const std::string head = fmt::format("{}:{}:{}: error: {}", file, line, column, message);
  return excerpt.empty() || characters(excerpt) > longest_excerpt ? head : head + marked(*this);
}

CaseError::CaseError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(together(diagnostics)), diagnostics_(std::move(diagnostics)) {}

CaseError error_at(const Case& input, const Source& source, const std::string& message) {
  if (source.line == 0 && !source.origin.empty())
    return CaseError({{source.origin, 0, 0, source.text, message}});
  const std::string by = source.origin.empty() ? "" : fmt::format(" (changed by {})", source.origin);
  const std::string excerpt = line_of(input.original, source.line);
  return CaseError({{input.file, source.line, source.column, source.text, message + by, excerpt}});
}

std::string printable(const std::string& text, std::size_t most) {
  const std::string first = text.substr(0, text.find_first_of("\r\n"));
  const bool plain = well_formed(first);
  std::string result;
  std::size_t count = 0;
  for (const char c : first) {
    if (!continues(c) && ++count > most) break;
    const auto byte = static_cast<unsigned char>(c);
    const bool harmless = c == '\t' || (byte >= 0x20 && byte != 0x7F && (plain || byte < 0x80));
    result += harmless ? c : '?';
  }
  return count > most || first.size() < text.size() ? result + "…" : result;
}

std::string line_of(const std::string& text, int line) {
  std::size_t begin = text.rfind("\xEF\xBB\xBF", 0) == 0 ? 3 : 0;  // byte-order mark
  for (int i = 1; i < line && begin != std::string::npos; ++i) {
    begin = text.find('\n', begin);
    if (begin != std::string::npos) ++begin;
  }
  if (line < 1 || begin == std::string::npos) return {};
  std::string whole = text.substr(begin, text.find('\n', begin) - begin);
  while (!whole.empty() && whole.back() == '\r') whole.pop_back();
  return printable(whole, std::string::npos);
}

}  // namespace geist
