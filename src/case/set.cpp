// --set PATH=VALUE.
#include "case/set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "case/keys.hpp"

namespace geist {

namespace {

constexpr std::size_t longest_path = 32;  // words

struct Problem {
  std::string message;
};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// The words of a dotted path; a word may be in quotes.
std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> words(1);
  for (const char c : path) {
    if (c == '.')
      words.emplace_back();
    else
      words.back() += c;
  }
  for (std::string& word : words) {
    word = trimmed(word);
    if (word.size() > 1 && (word[0] == '"' || word[0] == '\'') && word.back() == word[0])
      word = word.substr(1, word.size() - 2);
    if (word.empty()) throw Problem{fmt::format("'{}' is no path of a case: a word is missing", path)};
  }
  if (words.size() > longest_path) throw Problem{"the path is too long"};
  return words;
}

/// The document "value = …", every node of which knows that it comes from this option.
toml::table parse_value(const std::string& source, const std::string& value) {
  const std::string snippet = "value = " + value;
  toml::table parsed = toml::parse(std::string_view(snippet), std::string_view(source));
  if (parsed.size() != 1 || snippet.find_first_of("\r\n") != std::string::npos)
    throw Problem{"the value must be one TOML value in one line"};
  return parsed;
}

/// Printable ASCII without anything that TOML gives a meaning: may be taken as text.
bool is_plain(const std::string& value) {
  return std::all_of(value.begin(), value.end(), [](char c) { return c >= ' ' && c < 0x7F; }) &&
         value.find_first_of("[]{}\"'\\=#") == std::string::npos;
}

toml::table read_value(Document& document, const std::string& source, const std::string& value) {
  if (value.empty()) throw Problem{"a value is missing after '='"};
  if (value.size() > 1u << 16) throw Problem{"the value is too long"};
  std::string& text = document.texts[source];
  try {
    text = "value = " + value;
    return parse_value(source, value);
  } catch (const toml::parse_error& error) {
    if (!is_plain(value))
      throw Problem{fmt::format("{} is not a TOML value: {}", printable(value, 60), toml_message(error))};
  }
  text = "value = '" + value + "'";
  return parse_value(source, "'" + value + "'");
}

std::optional<std::size_t> index_of(const std::string& word) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
  if (error != std::errc{} || end != word.data() + word.size()) return {};
  return index;
}

/// Where in a list a word points; one beyond the end appends.
std::size_t place_in(const toml::array& list, const std::string& word) {
  const auto index = index_of(word);
  if (!index || *index > list.size())
    throw Problem{fmt::format("'{}' must count the entries of a list that has {}, from 0",
                              printable(word, 60), list.size())};
  return *index;
}

/// Insert or replace a node; a key that is new belongs to the option.
void put(toml::node& parent, const std::string& word, toml::node& value) {
  value.visit([&](auto& concrete) {
    if (toml::table* table = parent.as_table()) {
      table->insert_or_assign(toml::key(word, toml::source_region(concrete.source())), std::move(concrete));
      return;
    }
    toml::array& list = *parent.as_array();
    const std::size_t at = place_in(list, word);
    if (at == list.size())
      list.push_back(std::move(concrete));
    else
      list.replace(list.cbegin() + static_cast<std::ptrdiff_t>(at), std::move(concrete));
  });
}

/// What to make for a key that is not there: a list if its first entry is meant, otherwise a table.
std::string container_for(const std::string& word, const std::string& next) {
  for (const Key& key : key_table().front().keys)
    if (key.name == word && key.type == Type::named) return "{}";
  return next == "0" ? "[]" : "{}";
}

/// The node that a word of the path leads to, made if it is not there.
toml::node& step(toml::node& parent, const std::string& word, toml::table empty) {
  if (toml::array* list = parent.as_array()) {
    const std::size_t at = place_in(*list, word);
    if (at == list->size()) put(parent, word, *empty.get("value"));
    return *list->get(at);
  }
  if (!parent.as_table()->contains(word)) put(parent, word, *empty.get("value"));
  return *parent.as_table()->get(word);
}

void require_container(const toml::node& node, const std::string& word) {
  if (!node.is_table() && !node.is_array())
    throw Problem{fmt::format("'{}' is a single value: nothing can be set inside it", printable(word, 60))};
}

void apply(Document& document, const std::string& option) {
  const std::size_t equals = option.find('=');
  if (equals == std::string::npos) throw Problem{"must be PATH=VALUE"};
  const std::vector<std::string> words = split(option.substr(0, equals));
  const std::string source = "--set " + option;
  toml::table value = read_value(document, source, trimmed(option.substr(equals + 1)));
  toml::node* node = &document.root;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    node = &step(*node, words[i], parse_value(source, container_for(words[i], words[i + 1])));
    require_container(*node, words[i]);
  }
  put(*node, words.back(), *value.get("value"));
}

}  // namespace

void apply_sets(Document& document, const std::vector<std::string>& options) {
  for (const std::string& option : options) {
    try {
      apply(document, option);
    } catch (const Problem& problem) {
      document.problems.push_back({"--set " + option, 0, 0, option, problem.message, ""});
    }
  }
}

}  // namespace geist
