#include "engine/ros_messages/definition.h"

namespace pedicel::ros {

namespace {

/// "std_msgs/msg/Header" as .msg files write it: "std_msgs/Header".
std::string short_name(const std::string& name) {
  const std::size_t middle = name.find("/msg/");
  return middle == std::string::npos ? name : name.substr(0, middle) + name.substr(middle + 4);
}

}  // namespace

bool is_message(const std::string& type) {
  return type.find('/') != std::string::npos;
}

std::string field_text(const FieldDefinition& field) {
  std::string text = short_name(field.type);
  if (field.count == FieldDefinition::Count::sequence) text += "[]";
  if (field.count == FieldDefinition::Count::array) text += "[" + std::to_string(field.size) + "]";
  return text + " " + field.name;
}

std::string schema_text(const std::vector<Definition>& definitions) {
  std::string text;
  for (std::size_t i = 0; i < definitions.size(); ++i) {
    if (i > 0) text += std::string(80, '=') + "\nMSG: " + short_name(definitions[i].name) + "\n";
    for (const FieldDefinition& field : definitions[i].fields) text += field_text(field) + "\n";
  }
  return text;
}

}  // namespace pedicel::ros
