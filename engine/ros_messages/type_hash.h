#pragma once

#include "engine/ros_messages/definition.h"

namespace pedicel::ros {

/// "RIHS01_" and 64 hexadecimal digits: what ROS 2 tells a message's definition by (REP 2016), of
/// the first definition with all that it holds.
std::string type_hash(const std::vector<Definition>& definitions);

/// The same of a message; `name` where it has another one than its struct says, as all parts of
/// actions have.
template <Message M>
std::string type_hash_of(const std::string& name = M::name) {
  std::vector<Definition> definitions = definitions_of<M>();
  definitions.front().name = name;
  return type_hash(definitions);
}

/// SHA-256 as hexadecimal digits.
std::string sha256(const std::string& bytes);

}  // namespace pedicel::ros
