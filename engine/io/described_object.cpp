#include "engine/io/described_object.h"

#include <algorithm>

#include "engine/core/check.h"

namespace pedicel::io {

namespace {

bool fits(const Key& key, const DescribedObject::Json& value) {
  if (value.is_null()) return true;
  switch (key.type) {
    case KeyType::number:  // the components of a vector may stand in a list
      return value.is_number() || value.is_array();
    case KeyType::whole:
      return value.is_number_integer();
    case KeyType::flag:
      return value.is_boolean();
    case KeyType::word:
      return value.is_string() &&
             std::ranges::find(key.words, value.get<std::string>()) != key.words.end();
    case KeyType::text:
    case KeyType::path:
      return value.is_string();
    case KeyType::map:
      return value.is_object();
    case KeyType::vector:
    case KeyType::rotation:
    case KeyType::numbers:
    case KeyType::list:
      return value.is_array();
  }
  return false;
}

}  // namespace

DescribedObject& DescribedObject::set(const std::string& name, Json value) {
  const Key* key = keys_.find(name);
  PEDICEL_ASSERT(key);  // a key that is written and has no description
  PEDICEL_ASSERT(fits(*key, value));
  json_[name] = std::move(value);
  return *this;
}

DescribedObject& DescribedObject::set_other(const std::string& name, Json value) {
  json_[name] = std::move(value);
  return *this;
}

DescribedObject::Json DescribedObject::json() const {
  for (const Key& key : keys_.keys)
    PEDICEL_ASSERT(!std::holds_alternative<Needed>(key.otherwise) || json_.contains(key.name));
  return json_;
}

}  // namespace pedicel::io
