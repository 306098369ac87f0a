// Document: reading a file, and finding text in it.
#include "case/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <tuple>

namespace geist {

namespace {

constexpr std::uintmax_t largest_file = 16u << 20;  // bytes
constexpr int most_dots = 1000;                     // a.b.c…: the parser would recurse without a limit
constexpr std::size_t most_problems = 1000;
constexpr std::size_t longest_text = 60;  // characters of offending text in a message

[[noreturn]] void fail(const std::string& file, const std::string& message) {
  throw CaseError({{file, 0, 0, "", message}});
}

std::string read_text(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) fail(path, "no such file");
  if (fs::is_directory(status)) fail(path, "is a directory, not a case file");
  if (!fs::is_regular_file(status)) fail(path, "is not an ordinary file");
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > largest_file) fail(path, "is larger than 16 MB; a case file should be small");
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) fail(path, "cannot be read to its end");
  return text;
}

/// Position of the first dotted key that may be too deep, or npos. Quoted keys may hold anything, so in a
/// line with quotes every dot counts.
std::size_t too_deep(const std::string& text) {
  int dots = 0;
  bool quotes = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    quotes = c != '\n' && (quotes || c == '"' || c == '\'');
    if (c == '.' && ++dots > most_dots) return i;
    if (c == '\n' || (!quotes && (c == '=' || c == ',' || c == '[' || c == '#'))) dots = 0;
  }
  return std::string::npos;
}

toml::source_position position(const std::string& text, std::size_t at) {
  const std::size_t begin = text.rfind('\n', at);
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
  const std::size_t column = begin == std::string::npos ? at + 1 : at - begin;
  return {static_cast<toml::source_index>(line), static_cast<toml::source_index>(column)};
}

bool changed_within(const Document& document, const toml::node& node, std::string& option) {
  if (from_set(document, node.source())) option = *node.source().path;
  if (const toml::table* table = node.as_table())
    for (const auto& entry : *table) changed_within(document, entry.second, option);
  if (const toml::array* array = node.as_array())
    for (const toml::node& element : *array) changed_within(document, element, option);
  return !option.empty();
}

}  // namespace

void Document::report(const toml::source_region& place, const std::string& message) {
  if (problems.size() >= most_problems) return;
  if (from_set(*this, place)) {
    problems.push_back({*place.path, 0, 0, text_at(*this, place), message});
    return;
  }
  const int line = std::max<int>(1, static_cast<int>(place.begin.line));
  const int column = std::max<int>(1, static_cast<int>(place.begin.column));
  problems.push_back({file, line, column, text_at(*this, place), message, line_of(texts[file], line)});
}

Document open_document(const std::string& path) { return parse_document(read_text(path), path); }

Document parse_document(const std::string& text, const std::string& file) {
  Document document{file, {}, {{file, text}}, {}};
  if (text.size() > largest_file) fail(file, "is larger than 16 MB; a case file should be small");
  if (text.find('\0') != std::string::npos) fail(file, "is not a text file");
  if (const std::size_t at = too_deep(text); at != std::string::npos) {
    const toml::source_position where = position(text, at);
    document.report({where, where, nullptr},
                    fmt::format("more than {} dots in one line; break it", most_dots));
    throw CaseError(document.problems);
  }
  try {
    document.root = toml::parse(std::string_view(text), std::string_view(file));
  } catch (const toml::parse_error& error) {
    document.report(error.source(), "not valid TOML: " + toml_message(error));
    throw CaseError(document.problems);
  }
  return document;
}

std::string toml_message(const toml::parse_error& error) {
  std::string text(error.description());
  for (const std::string start : {"Error while ", "Error: "})
    if (text.rfind(start, 0) == 0) text = (start == "Error: " ? "" : "while ") + text.substr(start.size());
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

bool from_set(const Document& document, const toml::source_region& place) {
  return place.path && *place.path != document.file;
}

std::string text_at(const Document& document, const toml::source_region& place) {
  const auto found = document.texts.find(place.path ? *place.path : document.file);
  if (!place.begin || found == document.texts.end()) return {};
  const std::string line = line_of(found->second, static_cast<int>(place.begin.line));
  const bool whole = place.end.line > place.begin.line;
  const std::size_t first = place.begin.column - 1, last = whole ? std::string::npos : place.end.column - 1;
  std::string text;
  std::size_t column = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (i > 0 && (static_cast<unsigned char>(line[i]) & 0xC0) != 0x80) ++column;
    if (column >= first && column < last) text += line[i];
  }
  return printable(whole ? text + "\n" : text, longest_text);
}

Source source_of(const Document& document, const toml::node& node, const toml::source_region& place) {
  Source source{
      static_cast<int>(place.begin.line), static_cast<int>(place.begin.column), text_at(document, place), {}};
  if (changed_within(document, node, source.origin) && from_set(document, place)) {
    source.line = source.column = 0;
    source.origin = *place.path;
  }
  return source;
}

std::vector<std::pair<std::string, const toml::node*>> in_order(const Document& document,
                                                                const toml::table& table) {
  using Entry = std::tuple<bool, std::size_t, std::size_t, std::string, const toml::node*>;
  std::vector<Entry> entries;
  for (const auto& [key, node] : table) {
    const toml::source_region& place = key.source();
    entries.emplace_back(from_set(document, place), place.begin.line, place.begin.column, key.str(), &node);
  }
  std::sort(entries.begin(), entries.end());
  std::vector<std::pair<std::string, const toml::node*>> result;
  for (const Entry& entry : entries) result.emplace_back(std::get<3>(entry), std::get<4>(entry));
  return result;
}

}  // namespace geist
