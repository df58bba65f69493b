// A client of Fast DDS and Fast CDR that calls services and writes topics as ROS 2's middleware for
// Fast DDS does: topics rq/... and rr/..., and a request names the reader that waits for its reply.
#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace fdds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

namespace ros2_client {

class Raw : public fdds::TopicDataType {
 public:
  explicit Raw(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 65536;
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<std::string*>(data);
    if (bytes.size() > payload->max_size) return false;
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    static_cast<std::string*>(data)->assign(reinterpret_cast<char*>(payload->data),
                                            payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<std::string*>(data)->size()); };
  }
  void* createData() override { return new std::string; }
  void deleteData(void* data) override { delete static_cast<std::string*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

inline std::string bytes_of(const std::function<void(Cdr&)>& fill) {
  FastBuffer buffer;
  Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  fill(cdr);
  return {cdr.getBufferPointer(), cdr.getSerializedDataLength()};
}

inline void read(std::string& bytes, const std::function<void(Cdr&)>& take) {
  FastBuffer buffer(bytes.data(), bytes.size());
  Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  cdr.read_encapsulation();
  take(cdr);
}

inline int failures = 0;
inline void expect(bool holds, const std::string& what) {
  std::printf("%s: %s\n", holds ? "ok" : "FAILED", what.c_str());
  failures += !holds;
}

class Client {
 public:
  explicit Client(int domain) {
    participant_ = fdds::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<std::uint32_t>(domain), fdds::PARTICIPANT_QOS_DEFAULT);
    publisher_ = participant_->create_publisher(fdds::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(fdds::SUBSCRIBER_QOS_DEFAULT);
  }

  fdds::DataReader* reader(const std::string& topic, const std::string& type) {
    fdds::DataReaderQos qos = fdds::DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = fdds::RELIABLE_RELIABILITY_QOS;
    qos.history().depth = 100;
    return subscriber_->create_datareader(topic_of(topic, type), qos);
  }

  fdds::DataWriter* writer(const std::string& topic, const std::string& type) {
    fdds::DataWriterQos qos = fdds::DATAWRITER_QOS_DEFAULT;
    qos.reliability().kind = fdds::RELIABLE_RELIABILITY_QOS;
    qos.history().depth = 100;
    // Soon asked whether it arrived.
    qos.reliable_writer_qos().times.heartbeatPeriod = {0, 20'000'000};
    qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::DYNAMIC_RESERVE_MEMORY_MODE;
    return publisher_->create_datawriter(topic_of(topic, type), qos);
  }

  /// Writes messages one after the other, and waits until all have arrived. False where they have
  /// not in time.
  bool write(const std::string& topic, const std::string& type,
             const std::vector<std::string>& messages, double patience = 20.0) {
    fdds::DataWriter* out = writer(topic, type);
    const Clock::time_point end = after(patience);
    wait_until(
        [&] {
          fdds::PublicationMatchedStatus there;
          out->get_publication_matched_status(there);
          return there.current_count > 0;
        },
        end);
    bool all = true;
    for (std::string bytes : messages) {
      all = out->write(&bytes) && all;
      // One at a time: what does not fit any more would fall out of the history.
      all = out->wait_for_acknowledgments({5, 0}) ==
                eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK &&
            all;
    }
    publisher_->delete_datawriter(out);
    return all;
  }

  /// Empty where no reply comes in time.
  std::string call(const std::string& service, const std::string& type, std::string request,
                   double patience = 30.0) {
    fdds::DataReader* replies = reader("rr" + service + "Reply", type + "_Response_");
    fdds::DataWriter* requests = writer("rq" + service + "Request", type + "_Request_");
    const Clock::time_point end = after(patience);
    const auto wait = [&](const std::function<bool()>& over) { wait_until(over, end); };
    wait([&] {
      fdds::PublicationMatchedStatus there;
      fdds::SubscriptionMatchedStatus here;
      requests->get_publication_matched_status(there);
      replies->get_subscription_matched_status(here);
      return there.current_count > 0 && here.current_count > 0;
    });
    rtps::WriteParams params;
    params.related_sample_identity().writer_guid() = replies->guid();
    requests->write(&request, params);
    const auto number = params.sample_identity().sequence_number();
    std::string reply;
    wait([&] {
      std::string bytes;
      fdds::SampleInfo info;
      while (replies->take_next_sample(&bytes, &info) ==
             eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK)
        if (info.valid_data && info.related_sample_identity.writer_guid() == replies->guid() &&
            info.related_sample_identity.sequence_number() == number)
          reply = bytes;
      return !reply.empty();
    });
    publisher_->delete_datawriter(requests);
    subscriber_->delete_datareader(replies);
    return reply;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static Clock::time_point after(double seconds) {
    return Clock::now() +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }
  static void wait_until(const std::function<bool()>& over, Clock::time_point end) {
    while (!over() && Clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  fdds::Topic* topic_of(const std::string& name, const std::string& type) {
    if (auto* known = dynamic_cast<fdds::Topic*>(participant_->lookup_topicdescription(name)))
      return known;
    participant_->register_type(fdds::TypeSupport(new Raw(type)));
    return participant_->create_topic(name, type, fdds::TOPIC_QOS_DEFAULT);
  }
  fdds::DomainParticipant* participant_;
  fdds::Publisher* publisher_;
  fdds::Subscriber* subscriber_;
};

/// Of a response that begins with a Result; 255 where none came.
inline int result_of(std::string reply) {
  if (reply.empty()) return 255;
  std::uint8_t result = 255;
  std::string text;
  read(reply, [&](Cdr& cdr) { cdr >> result >> text; });
  return result;
}

}  // namespace ros2_client
