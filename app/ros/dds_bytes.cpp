#include "app/ros/dds_bytes.h"

#include <cstring>

namespace pedicel::app {

DdsBytes::DdsBytes(const std::string& name, std::size_t longest) : longest_(longest) {
  setName(name.c_str());
  m_typeSize = 1024;  // where memory begins; it grows
  m_isGetKeyDefined = false;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}

bool DdsBytes::serialize(void* data, Payload* payload) {
  const std::string& bytes = static_cast<Value*>(data)->bytes;
  if (bytes.size() > payload->max_size) return false;
  std::memcpy(payload->data, bytes.data(), bytes.size());
  payload->length = static_cast<std::uint32_t>(bytes.size());
  payload->encapsulation = CDR_LE;
  return true;
}

bool DdsBytes::deserialize(Payload* payload, void* data) {
  Value& value = *static_cast<Value*>(data);
  value.bytes.clear();
  if (payload->data && payload->length <= longest_)
    value.bytes.assign(reinterpret_cast<const char*>(payload->data), payload->length);
  return true;
}

std::function<std::uint32_t()> DdsBytes::getSerializedSizeProvider(void* data) {
  return [data] { return static_cast<std::uint32_t>(static_cast<Value*>(data)->bytes.size()); };
}

}  // namespace pedicel::app
