// View: a table of a document through the key table.
#include "case/view.hpp"

#include "case/check.hpp"

namespace geist {

View::View(const Document& document) : View(document, document.root, key_table().front(), "") {}

View::View(const Document& document, const toml::table& table, const Table& kind, std::string name)
    : document_(&document), table_(&table), kind_(&kind), name_(std::move(name)) {}

bool View::has(std::string_view key) const {
  return !keys_named(*kind_, key).empty() && table_->contains(key);
}

std::optional<View> View::table(std::string_view key) const {
  const toml::node* node = acceptable_node(key);
  if (!node) return {};
  return View(*document_, *node->as_table(), kind_of(key), "");
}

std::vector<View> View::tables(std::string_view key) const {
  std::vector<View> result;
  if (const toml::node* node = acceptable_node(key))
    for (const toml::node& element : *node->as_array())
      result.push_back(View(*document_, *element.as_table(), kind_of(key), ""));
  return result;
}

std::vector<View> View::named(std::string_view key) const {
  std::vector<View> result;
  if (const toml::node* node = acceptable_node(key))
    for (const auto& [name, element] : in_order(*document_, *node->as_table()))
      result.push_back(View(*document_, *element->as_table(), kind_of(key), name));
  return result;
}

std::vector<std::string> View::keys() const {
  std::vector<std::string> given;
  for (const std::string& name : key_names(*kind_))
    if (table_->contains(name)) given.push_back(name);
  return given;
}

toml::source_region View::place(std::string_view key) const {
  const toml::node* node = has(key) ? table_->get(key) : nullptr;
  return node && node->source().begin ? node->source() : table_->source();
}

bool View::set(std::string_view key) const {
  const toml::node* node = has(key) ? table_->get(key) : nullptr;
  return node && !source_of(*document_, *node, node->source()).origin.empty();
}

const toml::node* View::acceptable_node(std::string_view name) const {
  if (!has(name)) return nullptr;
  const toml::node* node = table_->get(name);
  const Key* key = applicable(*table_, *kind_, name);
  return key && geist::acceptable(*key, *node) ? node : nullptr;
}

const Table& View::kind_of(std::string_view key) const {
  return table_of(applicable(*table_, *kind_, key)->of);
}

}  // namespace geist
