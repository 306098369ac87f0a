// Document: a case file as TOML, with the place of everything; nothing of its meaning.
#pragma once
#include <toml++/toml.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "case/diagnostic.hpp"

namespace geist {

/// A parsed case file. The source path of each of its nodes is a key of `texts`: the file, or a --set option.
/// Nodes filled in as defaults have no place (line 0).
struct Document {
  std::string file;
  toml::table root;
  std::map<std::string, std::string, std::less<>> texts;
  std::vector<Diagnostic> problems;

  /// Note a problem at a place.
  void report(const toml::source_region& place, const std::string& message);
};

/// Read and parse; CaseError if the file cannot be read or is not TOML.
Document open_document(const std::string& path);
Document parse_document(const std::string& text, const std::string& file);

/// What the parser found, worded to stand after a colon.
std::string toml_message(const toml::parse_error& error);

/// Does the place lie in a --set option?
bool from_set(const Document& document, const toml::source_region& place);

/// The text at a place, cut to a length fit for messages.
std::string text_at(const Document& document, const toml::source_region& place);

/// The place of a node for later messages, and the --set option that changed it or something in it.
Source source_of(const Document& document, const toml::node& node, const toml::source_region& place);

/// The entries of a table in the order of the file, --set options after it.
std::vector<std::pair<std::string, const toml::node*>> in_order(const Document& document,
                                                                const toml::table& table);

}  // namespace geist
