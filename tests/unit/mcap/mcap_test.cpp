// MCAP files: written, read back, cut off, damaged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <zstd.h>

#include <csignal>
#include <sstream>

#include "engine/core/diagnostics.h"
#include "engine/io/atomic_file.h"
#include "engine/io/output_check.h"
#include "engine/mcap/reader.h"
#include "engine/mcap/writer.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::mcap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Every message as "topic type time data".
std::vector<std::string> messages_of(const std::string& bytes, ReadEnd* end = nullptr) {
  std::vector<std::string> all;
  std::istringstream file(bytes);
  const ReadEnd found = read(file, "log.mcap", [&](const Message& message) {
    all.push_back(message.channel.topic + " " + message.schema.name + " " +
                  std::to_string(message.log_time) + " " + std::string(message.data));
  });
  if (end) *end = found;
  EXPECT_EQ(found.messages, all.size());
  return all;
}

std::string failure_of(const std::string& bytes) {
  try {
    messages_of(bytes);
  } catch (const InvalidFile& fault) {
    return fault.what();
  }
  return "";
}

class McapFile : public ::testing::Test {
 protected:
  /// Ten messages on each of two topics, two a chunk and topic.
  std::string written() {
    WriterOptions options;
    options.library = "a test";
    options.chunk_time = 20;
    Writer writer(folder_ / "log.mcap", options);
    const auto a = writer.add_channel("/a", {"std_msgs/msg/String", "ros2msg", "string data\n"});
    const auto b = writer.add_channel("/b", {"std_msgs/msg/String", "ros2msg", "string data\n"});
    for (std::uint64_t i = 0; i < 10; ++i) {
      writer.write(a, 10 * i, "x" + std::to_string(i));
      writer.write(b, 10 * i + 1, std::string(100, 'y'));
    }
    writer.close();
    return io::read_file(folder_ / "log.mcap");
  }
  TemporaryFolder folder_;
};

TEST_F(McapFile, ReadsBackWhatWasWritten) {
  ReadEnd end;
  const auto all = messages_of(written(), &end);
  EXPECT_TRUE(end.whole);
  ASSERT_EQ(all.size(), 20U);
  EXPECT_EQ(all[0], "/a std_msgs/msg/String 0 x0");
  EXPECT_EQ(all[18], "/a std_msgs/msg/String 90 x9");
}

TEST_F(McapFile, SummaryAndCrcsAreThoseOfTheSpecification) {
  const std::string bytes = written();
  EXPECT_EQ(bytes.substr(0, 8), magic);
  EXPECT_EQ(bytes.substr(bytes.size() - 8), magic);
  // The footer: op, length 20, start of the summary, of its offsets, CRC.
  Fields footer(std::string_view(bytes).substr(bytes.size() - 8 - 29));
  EXPECT_EQ(footer.number<Op>(), Op::footer);
  EXPECT_EQ(footer.number<std::uint64_t>(), 20U);
  const auto start = footer.number<std::uint64_t>(), offsets = footer.number<std::uint64_t>();
  const auto crc = footer.number<std::uint32_t>();
  EXPECT_EQ(crc, crc_of(std::string_view(bytes).substr(start, bytes.size() - 8 - 4 - start)));
  // Before the summary the data's end, with the CRC of all bytes before it.
  const std::size_t data_end = start - record_head - 4;
  Fields end(std::string_view(bytes).substr(data_end));
  EXPECT_EQ(end.number<Op>(), Op::data_end);
  EXPECT_EQ(end.number<std::uint64_t>(), 4U);
  EXPECT_EQ(end.number<std::uint32_t>(), crc_of(std::string_view(bytes).substr(0, data_end)));
  // Each summary offset leads to a record of its group, and the groups fill the summary.
  std::uint64_t covered = start;
  Fields groups(std::string_view(bytes).substr(offsets, bytes.size() - 8 - 29 - offsets));
  while (!groups.empty()) {
    EXPECT_EQ(groups.number<Op>(), Op::summary_offset);
    groups.number<std::uint64_t>();
    const auto op = groups.number<Op>();
    const auto at = groups.number<std::uint64_t>(), length = groups.number<std::uint64_t>();
    EXPECT_EQ(at, covered);
    EXPECT_EQ(static_cast<Op>(bytes[at]), op);
    covered += length;
  }
  EXPECT_TRUE(groups.good());
  EXPECT_EQ(covered, offsets);
}

TEST_F(McapFile, IsReadUpToWhereItWasCutOff) {
  const std::string bytes = written();
  std::size_t last = 0;
  for (std::size_t size = magic.size(); size < bytes.size(); size += 7) {
    ReadEnd end;
    const auto all = messages_of(bytes.substr(0, size), &end);
    EXPECT_GE(all.size(), last);
    EXPECT_EQ(all.size() % 4, 0U) << "whole chunks";
    last = all.size();
  }
  EXPECT_EQ(last, 20U);
  ReadEnd end;
  messages_of(bytes.substr(0, 400), &end);
  EXPECT_FALSE(end.whole);
}

TEST_F(McapFile, IsWholeOnDiskChunkByChunk) {
  Writer writer(folder_ / "log.mcap", {"ros2", "a test", 100, 1000000});
  const auto a = writer.add_channel("/a", {"T", "ros2msg", ""});
  for (int i = 0; i < 3; ++i) writer.write(a, 0, std::string(100, 'x'));
  // Without close(): as a killed program leaves it, but for the chunk at hand.
  EXPECT_EQ(messages_of(io::read_file(folder_ / "log.mcap")).size(), 2U);
}

TEST_F(McapFile, DamageIsSeen) {
  std::string bytes = written();
  EXPECT_THAT(failure_of("no log at all"), HasSubstr("log.mcap: error: at byte 0: no MCAP file"));
  EXPECT_EQ(failure_of(bytes), "");
  // A chunk that is not compressed, with a byte that fell over.
  const std::string content = schema_record(1, {"T", "ros2msg", ""}) +
                              channel_record(0, {1, "/a", "cdr", {}}) +
                              record(Op::message, std::string(22, '\0') + "hello");
  const auto file = [&](const std::string& in, const std::string& compression, std::uint64_t size,
                        std::uint32_t crc) {
    return std::string(magic) + record(Op::chunk, Bytes()
                                                      .number(std::uint64_t{0})
                                                      .number(std::uint64_t{0})
                                                      .number(size)
                                                      .number(crc)
                                                      .text(compression)
                                                      .number(std::uint64_t{in.size()})
                                                      .raw(in)
                                                      .all());
  };
  EXPECT_THAT(messages_of(file(content, "", content.size(), crc_of(content))),
              ElementsAre("/a T 0 hello"));
  EXPECT_THAT(messages_of(file(content, "", content.size(), 0)), ElementsAre("/a T 0 hello"));
  EXPECT_THAT(failure_of(file(content, "", content.size(), 1)),
              HasSubstr("its CRC does not agree"));
  EXPECT_THAT(failure_of(file(content, "br", content.size(), 0)),
              HasSubstr("compressed with \"br\", expected zstd, lz4 or none"));
  EXPECT_THAT(failure_of(file(content, "lz4", content.size(), 0)), HasSubstr("chunk"));
  EXPECT_THAT(failure_of(file(content, "zstd", content.size(), 0)), HasSubstr("no zstd"));
  EXPECT_THAT(failure_of(file(content, "", std::uint64_t{1} << 60, 0)),
              HasSubstr("a chunk of 1152921504606846976 bytes, expected at most 268435456"));
}

// An LZ4 frame of one block that is not packed, put together after the format's description.
TEST(McapLz4, IsReadWhereItIsBuiltIn) {
  const std::string content = schema_record(1, {"T", "ros2msg", ""}) +
                              channel_record(0, {1, "/a", "cdr", {}}) +
                              record(Op::message, std::string(22, '\0') + "hello");
  const auto log = [&](std::uint64_t size) {
    const std::string frame = std::string("\x04\x22\x4d\x18\x60\x40\x82", 7) +
                              Bytes()
                                  .number(static_cast<std::uint32_t>(content.size() | 0x80000000U))
                                  .raw(content)
                                  .number(std::uint32_t{0})
                                  .all();
    return std::string(magic) + record(Op::chunk, Bytes()
                                                      .number(std::uint64_t{0})
                                                      .number(std::uint64_t{0})
                                                      .number(size)
                                                      .number(crc_of(content))
                                                      .text("lz4")
                                                      .number(std::uint64_t{frame.size()})
                                                      .raw(frame)
                                                      .all());
  };
  if (const std::string fault = failure_of(log(content.size())); !fault.empty()) {
    EXPECT_THAT(fault, HasSubstr("built without it"));
    GTEST_SKIP() << fault;
  }
  EXPECT_THAT(messages_of(log(content.size())), ElementsAre("/a T 0 hello"));
  EXPECT_THAT(failure_of(log(10)), HasSubstr("longer than its head says"));
  EXPECT_THAT(failure_of(log(5000)), HasSubstr("its head says 5000"));
}

TEST_F(McapFile, ASmallChunkThatGrowsIsRefusedEarly) {
  // 64 MB of zeros in some kB, and a head that says ten bytes.
  const std::string zeros(64 << 20, '\0');
  std::string small(ZSTD_compressBound(zeros.size()), '\0');
  small.resize(ZSTD_compress(small.data(), small.size(), zeros.data(), zeros.size(), 1));
  const std::string bytes =
      std::string(magic) + record(Op::chunk, Bytes()
                                                 .number(std::uint64_t{0})
                                                 .number(std::uint64_t{0})
                                                 .number(std::uint64_t{10})
                                                 .number(std::uint32_t{0})
                                                 .text("zstd")
                                                 .number(std::uint64_t{small.size()})
                                                 .raw(small)
                                                 .all());
  EXPECT_THAT(failure_of(bytes), HasSubstr("longer than its head says"));
}

TEST_F(McapFile, DamageIsNoCut) {
  std::string bytes = written();
  // The length of a record in the middle: the file goes on behind it, and has its end.
  std::size_t at = magic.size();
  for (int records = 0; records < 3; ++records)
    at += record_head + Fields(std::string_view(bytes).substr(at + 1)).number<std::uint64_t>();
  bytes[at + 7] = '\x7f';
  EXPECT_THAT(failure_of(bytes), HasSubstr("at byte " + std::to_string(at) + ": damaged: "));
  bytes.resize(bytes.size() - 4);
  EXPECT_EQ(failure_of(bytes), "") << "without its end it may be cut off";
}

/// As on a full disk: a file cannot grow beyond some bytes.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    old_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit less{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &less);
  }
  ~SmallDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, old_);
  }

 private:
  rlimit before_{};
  void (*old_)(int) = nullptr;
};

TEST_F(McapFile, AFullDiskLeavesWhatWasWholeUnderAnotherName) {
  for (const rlim_t size : {2500, 100}) {
    std::string said;
    {
      const SmallDisk disk(size);
      try {
        Writer writer(folder_ / "log.mcap", {"ros2", "a test", 1, 1000000});
        const auto a = writer.add_channel("/a", {"T", "ros2msg", ""});
        for (int i = 0; i < 1000; ++i) writer.write(a, 0, "message " + std::to_string(i));
        FAIL() << "it fits";
      } catch (const io::WriteError& fault) {
        said = fault.what();
      }
    }
    EXPECT_THAT(said, HasSubstr("log.mcap: cannot be written: File too large"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "log.mcap"));
    EXPECT_EQ(std::filesystem::exists(folder_ / "log.mcap.part"), size > 1000);
    if (size < 1000) continue;
    EXPECT_THAT(said, HasSubstr("; what was whole is in "));
    ReadEnd end;
    EXPECT_GT(messages_of(io::read_file(folder_ / "log.mcap.part"), &end).size(), 3U);
    EXPECT_FALSE(end.whole);
    EXPECT_EQ(end.at, std::filesystem::file_size(folder_ / "log.mcap.part"));
    std::filesystem::remove(folder_ / "log.mcap.part");
  }
}

TEST_F(McapFile, TwoAtOnceDoNotMix) {
  Writer first(folder_ / "log.mcap", {});
  EXPECT_THROW(Writer(folder_ / "log.mcap", {}), io::WriteError);
  EXPECT_THROW(io::check_output_file(folder_ / "log.mcap"), io::WriteError);
  first.close();
  Writer second(folder_ / "log.mcap", {});
}

TEST_F(McapFile, CannotBeWrittenWhereThereIsNoFolder) {
  io::write_file_atomically(folder_ / "file", "");
  EXPECT_THROW(Writer(folder_ / "file" / "log.mcap", {}), io::WriteError);
}

}  // namespace
}  // namespace pedicel::mcap
