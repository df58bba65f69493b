#include "engine/io/described_map.h"

#include <algorithm>

#include "engine/core/check.h"

namespace pedicel::io {

const Key* KeyList::find(std::string_view key) const {
  const auto found = std::ranges::find(keys, key, &Key::name);
  if (found != keys.end()) return &*found;
  for (const KeyList* other : also)
    if (const Key* one = other->find(key)) return one;
  return nullptr;
}

DescribedMap::DescribedMap(const YamlNode& node, const KeyList& keys, const std::string& what)
    : keys_(keys), map_(node, what.empty() ? keys.what : what) {}

const Key& DescribedMap::key(const std::string& name) const {
  const Key* found = keys_.find(name);
  PEDICEL_ASSERT(found);  // a key that is read and has no description
  return *found;
}

const Key& DescribedMap::key(const std::string& name, KeyType type) const {
  const Key& found = key(name);
  PEDICEL_ASSERT(found.type == type);
  return found;
}

template <class Value>
const Value& DescribedMap::otherwise(const Key& key) const {
  static const Value none{};  // after "missing key"
  if (std::holds_alternative<Needed>(key.otherwise)) return none;
  PEDICEL_ASSERT(std::holds_alternative<Value>(key.otherwise));
  return std::get<Value>(key.otherwise);
}

bool DescribedMap::has(const std::string& name) const {
  return map_.has(key(name).name);
}

std::optional<YamlNode> DescribedMap::optional(const std::string& name) {
  return map_.optional(key(name).name);
}

std::optional<YamlNode> DescribedMap::required(const std::string& name) {
  return map_.required(key(name).name);
}

std::optional<YamlNode> DescribedMap::asked(const std::string& name) {
  return std::holds_alternative<Needed>(key(name).otherwise) ? map_.required(name)
                                                             : map_.optional(name);
}

std::optional<YamlNode> DescribedMap::misplaced(const std::string& name) {
  return map_.optional(name);
}

double DescribedMap::number(const std::string& name) {
  const Key& described = key(name, KeyType::number);
  const auto node = asked(name);
  return node ? node->number(name, described.bounds) : otherwise<double>(described);
}

int DescribedMap::integer(const std::string& name) {
  const Key& described = key(name, KeyType::whole);
  const auto node = asked(name);
  return node ? node->integer(name, static_cast<int>(described.bounds.minimum),
                              static_cast<int>(described.bounds.maximum))
              : static_cast<int>(otherwise<double>(described));
}

bool DescribedMap::boolean(const std::string& name) {
  const Key& described = key(name, KeyType::flag);
  const auto node = asked(name);
  return node ? node->boolean(name) : otherwise<bool>(described);
}

std::string DescribedMap::text(const std::string& name) {
  const Key& described = key(name);
  PEDICEL_ASSERT(described.type == KeyType::text || described.type == KeyType::path);
  const auto node = asked(name);
  if (!node && std::holds_alternative<Told>(described.otherwise)) return {};
  return node ? node->text(name) : otherwise<std::string>(described);
}

std::string DescribedMap::choice(const std::string& name) {
  const Key& described = key(name, KeyType::word);
  const auto node = asked(name);
  return node ? node->choice(name, described.words) : otherwise<std::string>(described);
}

Vec3 DescribedMap::vector(const std::string& name) {
  const Key& described = key(name, KeyType::vector);
  const auto node = asked(name);
  if (node) return node->vector(name);
  const Vec3* otherwise = std::get_if<Vec3>(&described.otherwise);
  return otherwise ? *otherwise : Vec3(Vec3::Zero());
}

Quat DescribedMap::quaternion(const std::string& name) {
  key(name, KeyType::rotation);
  const auto node = asked(name);
  return node ? node->quaternion(name) : Quat::Identity();
}

std::vector<YamlNode> DescribedMap::list(const std::string& name) {
  const auto node = asked(name);
  return node ? node->list(name) : std::vector<YamlNode>{};
}

std::optional<double> DescribedMap::optional_number(const std::string& name) {
  const Key& described = key(name, KeyType::number);
  const auto node = optional(name);
  return node ? std::optional(node->number(name, described.bounds)) : std::nullopt;
}

double DescribedMap::required_number(const std::string& name) {
  const Key& described = key(name, KeyType::number);
  const auto node = required(name);
  return node ? node->number(name, described.bounds) : 0.0;
}

bool DescribedMap::has_format() {
  return check_format(map_, key("format", KeyType::word).words.front(),
                      static_cast<int>(key("version", KeyType::whole).bounds.maximum));
}

}  // namespace pedicel::io
