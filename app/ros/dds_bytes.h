#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>
#include <string>

namespace pedicel::app {

/// A type of DDS of which only the name is known: its values are the bytes as they are sent.
class DdsBytes : public eprosima::fastdds::dds::TopicDataType {
 public:
  struct Value {
    std::string bytes;  ///< empty where what came was too long
  };

  DdsBytes(const std::string& name, std::size_t longest);

  using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;
  bool serialize(void* data, Payload* payload) override;
  bool deserialize(Payload* payload, void* data) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override;
  void* createData() override { return new Value; }
  void deleteData(void* data) override { delete static_cast<Value*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
  bool is_bounded() const override { return false; }
  bool is_plain() const override { return false; }

 private:
  std::size_t longest_;
};

}  // namespace pedicel::app
