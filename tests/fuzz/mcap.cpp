#include <sstream>

#include "engine/mcap/reader.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

// A log is read, or refused with the byte; what it hands out lies within what it read.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream file(fuzz::text_of(data, size));
  mcap::ReaderLimits limits;
  limits.record = 16u << 20;
  std::uint64_t messages = 0, bytes = 0;
  try {
    const mcap::ReadEnd end = mcap::read(
        file, "f.mcap",
        [&](const mcap::Message& message) {
          ++messages;
          for (const char byte : message.data) bytes += static_cast<unsigned char>(byte);
          bytes += message.channel.topic.size() + message.schema.data.size();
        },
        limits);
    fuzz::require(end.messages == messages, "each message is counted");
    fuzz::require(end.at <= size, "the end is in the file");
  } catch (const InvalidFile& fault) {
    fuzz::require(std::string(fault.what()).find("at byte ") != std::string::npos,
                  "the byte of the fault");
  }
  fuzz::require(bytes < (std::uint64_t{1} << 60), "all of it can be read");
  return 0;
}
