#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "engine/io/key.h"

namespace pedicel::io {

/// A JSON object that is written as its keys are described. A key without a description, a value of
/// another type or one that is none of its words is our own bug (an assertion), and so is a key
/// that is missing, unless its absence is told. Keys stand in the order in which they are set.
class DescribedObject {
 public:
  using Json = nlohmann::ordered_json;

  /// `keys` outlives the object.
  explicit DescribedObject(const KeyList& keys) : keys_(keys) {}

  /// Null stands for what was not measured, whatever the type.
  DescribedObject& set(const std::string& name, Json value);
  /// A key that is described elsewhere: a name that a user chose, a parameter of an effect.
  DescribedObject& set_other(const std::string& name, Json value);
  /// Once all is set.
  Json json() const;

 private:
  const KeyList& keys_;
  Json json_ = Json::object();
};

}  // namespace pedicel::io
