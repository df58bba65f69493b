#include "engine/mcap/records.h"

#include <zlib.h>

namespace pedicel::mcap {

std::string record(Op op, std::string_view content) {
  return Bytes().number(op).number(std::uint64_t{content.size()}).raw(content).all();
}

std::string schema_record(std::uint16_t id, const Schema& schema) {
  return record(Op::schema,
                Bytes().number(id).text(schema.name).text(schema.encoding).text(schema.data).all());
}

std::string channel_record(std::uint16_t id, const Channel& channel) {
  Bytes pairs;
  for (const auto& [key, value] : channel.metadata) pairs.text(key).text(value);
  return record(Op::channel, Bytes()
                                 .number(id)
                                 .number(channel.schema)
                                 .text(channel.topic)
                                 .text(channel.message_encoding)
                                 .text(pairs.all())
                                 .all());
}

std::uint32_t crc_of(std::string_view bytes, std::uint32_t crc) {
  return static_cast<std::uint32_t>(
      crc32_z(crc, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

}  // namespace pedicel::mcap
