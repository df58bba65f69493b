#include "app/ros/dds_node.h"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <stdexcept>
#include <vector>

#include "app/ros/dds_bytes.h"
#include "app/ros/ros_name.h"

namespace pedicel::app {

namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

constexpr int newest_kept = 10, reliable_kept = 100;
constexpr std::uint32_t neighbours = 10;         // participants of this machine that are looked for
constexpr int first_own = 30, own_numbers = 70;  // numbers of our own participants

/// "typehash=...;", which ROS 2 looks for from Iron on.
template <class Qos>
void say_hash(Qos& qos, const std::string& hash) {
  if (hash.empty()) return;
  const std::string text = "typehash=" + hash + ";";
  qos.user_data().data_vec({text.begin(), text.end()});
}

template <class Qos>
void set_delivery(Qos& qos, Delivery delivery) {
  qos.reliability().kind = delivery == Delivery::sensor ? dds::BEST_EFFORT_RELIABILITY_QOS
                                                        : dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = delivery == Delivery::latched ? dds::TRANSIENT_LOCAL_DURABILITY_QOS
                                                        : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = delivery == Delivery::latched  ? 1
                        : delivery == Delivery::sensor ? newest_kept
                                                       : reliable_kept;
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
}

dds::DomainParticipantQos participant_qos(const NodeOptions& options) {
  dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
  qos.name("pedicel");
  const std::string enclave = "enclave=/;";
  qos.user_data().data_vec({enclave.begin(), enclave.end()});
  if (options.interface == "any") return qos;
  const std::string address = options.interface.empty() ? "127.0.0.1" : options.interface;
  qos.transport().use_builtin_transports = false;
  const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {address};
  udp->maxInitialPeersRange = neighbours;
  qos.transport().user_transports.push_back(udp);
  // As ROS 2 does with ROS_LOCALHOST_ONLY: memory that programs of one machine share.
  if (options.interface.empty())
    qos.transport().user_transports.push_back(
        std::make_shared<eprosima::fastdds::rtps::SharedMemTransportDescriptor>());
  // Who listens on another interface of this machine hears no multicast of the loopback one, so
  // each place where a participant of this machine may be is told of us, too.
  rtps::Locator_t multicast, own;
  rtps::IPLocator::setIPv4(multicast, "239.255.0.1");
  multicast.port =
      qos.wire_protocol().port.getMulticastPort(static_cast<std::uint32_t>(options.domain));
  rtps::IPLocator::setIPv4(own, address);
  qos.wire_protocol().builtin.initialPeersList.push_back(multicast);
  qos.wire_protocol().builtin.initialPeersList.push_back(own);
  // The low numbers are those of participants that count theirs from 0: on one port the kernel
  // would hand what is theirs to us, whose address is the narrower one.
  qos.wire_protocol().participant_id = first_own + static_cast<int>(::getpid()) % own_numbers;
  return qos;
}

RequestId id_of(const rtps::GUID_t& writer, const rtps::SequenceNumber_t& number) {
  RequestId id;
  std::copy(std::begin(writer.guidPrefix.value), std::end(writer.guidPrefix.value),
            id.writer.begin());
  std::copy(std::begin(writer.entityId.value), std::end(writer.entityId.value),
            id.writer.begin() + rtps::GuidPrefix_t::size);
  id.number = static_cast<std::int64_t>(number.to64long());
  return id;
}

rtps::SampleIdentity identity_of(const RequestId& id) {
  rtps::SampleIdentity identity;
  rtps::GUID_t writer;
  std::copy_n(id.writer.begin(), rtps::GuidPrefix_t::size, std::begin(writer.guidPrefix.value));
  std::copy_n(id.writer.begin() + rtps::GuidPrefix_t::size, rtps::EntityId_t::size,
              std::begin(writer.entityId.value));
  identity.writer_guid(writer);
  identity.sequence_number(
      rtps::SequenceNumber_t(static_cast<std::int32_t>(id.number >> 32),
                             static_cast<std::uint32_t>(id.number & 0xffffffff)));
  return identity;
}

/// Hands on what a reader gets.
class Listener : public dds::DataReaderListener {
 public:
  using Take = std::function<void(const dds::SampleInfo&, std::string)>;
  Listener(Take take, std::atomic<std::uint64_t>& refused)
      : take_(std::move(take)), refused_(refused) {}

  void on_data_available(dds::DataReader* reader) override {
    DdsBytes::Value value;
    dds::SampleInfo info;
    while (reader->take_next_sample(&value, &info) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      if (value.bytes.empty())
        ++refused_;
      else
        take_(info, std::move(value.bytes));
      value.bytes.clear();
    }
  }

 private:
  Take take_;
  std::atomic<std::uint64_t>& refused_;
};

}  // namespace

struct DdsNode::Impl {
  NodeOptions options;
  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;
  std::vector<dds::DataWriter*> writers, services;
  std::vector<std::unique_ptr<Listener>> listeners;
  std::atomic<std::uint64_t> refused{0};

  ~Impl() {
    if (!participant) return;
    participant->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant);
  }

  template <class T>
  static T* there(T* entity, const std::string& what) {
    if (!entity) throw std::runtime_error("DDS refuses " + what);
    return entity;
  }

  dds::Topic* topic(const std::string& name, const std::string& type) {
    const dds::TypeSupport support(new DdsBytes(type, longest_message));
    participant->register_type(support);
    return there(participant->create_topic(name, type, dds::TOPIC_QOS_DEFAULT),
                 "the topic " + name);
  }

  dds::DataWriter* writer(dds::Topic* on, Delivery delivery, const std::string& hash) {
    dds::DataWriterQos qos = publisher->get_default_datawriter_qos();
    set_delivery(qos, delivery);
    say_hash(qos, hash);
    // A slow subscriber does not hold up the simulation.
    qos.publish_mode().kind = dds::ASYNCHRONOUS_PUBLISH_MODE;
    qos.data_sharing().off();
    return there(publisher->create_datawriter(on, qos), "to publish " + on->get_name());
  }

  void reader(dds::Topic* on, const std::string& hash, Listener::Take take) {
    dds::DataReaderQos qos = subscriber->get_default_datareader_qos();
    set_delivery(qos, Delivery::reliable);
    say_hash(qos, hash);
    qos.data_sharing().off();
    listeners.push_back(std::make_unique<Listener>(std::move(take), refused));
    there(subscriber->create_datareader(on, qos, listeners.back().get()),
          "to subscribe to " + on->get_name());
  }
};

DdsNode::DdsNode(const NodeOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
  // DDS itself says nothing: what matters is told here.
  dds::Log::ClearConsumers();
  impl_->participant =
      Impl::there(dds::DomainParticipantFactory::get_instance()->create_participant(
                      static_cast<std::uint32_t>(options.domain), participant_qos(options)),
                  "a participant of domain " + std::to_string(options.domain) +
                      (options.interface.empty() ? "" : " on the interface " + options.interface));
  impl_->publisher =
      Impl::there(impl_->participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT), "to publish");
  impl_->subscriber = Impl::there(
      impl_->participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT), "to subscribe");
}

DdsNode::~DdsNode() = default;

int DdsNode::publish(const std::string& topic, const std::string& type, const std::string& hash,
                     Delivery delivery) {
  const std::string name = dds_topic(in_namespace(impl_->options.ros_namespace, topic));
  impl_->writers.push_back(impl_->writer(impl_->topic(name, dds_type(type)), delivery, hash));
  return static_cast<int>(impl_->writers.size()) - 1;
}

void DdsNode::write(int publisher, std::string_view cdr) {
  DdsBytes::Value value{std::string(cdr)};
  impl_->writers[static_cast<std::size_t>(publisher)]->write(&value);
}

void DdsNode::subscribe(const std::string& topic, const std::string& type, const std::string& hash,
                        std::function<void(std::string)> take) {
  const std::string name = dds_topic(in_namespace(impl_->options.ros_namespace, topic));
  impl_->reader(impl_->topic(name, dds_type(type)), hash,
                [take = std::move(take)](const dds::SampleInfo&, std::string bytes) {
                  take(std::move(bytes));
                });
}

int DdsNode::serve(const std::string& service, const std::string& type, const ServiceHashes& hashes,
                   std::function<void(RequestId, std::string)> take) {
  const std::string name = in_namespace(impl_->options.ros_namespace, service);
  dds::Topic* replies = impl_->topic(dds_reply_topic(name), dds_type(type + "_Response"));
  impl_->services.push_back(impl_->writer(replies, Delivery::reliable, hashes.response));
  dds::Topic* requests = impl_->topic(dds_request_topic(name), dds_type(type + "_Request"));
  impl_->reader(requests, hashes.request,
                [take = std::move(take)](const dds::SampleInfo& info, std::string bytes) {
                  // A client of ROS says the reader that waits for the answer.
                  const rtps::GUID_t& reader = info.related_sample_identity.writer_guid();
                  const bool said = reader != rtps::GUID_t::unknown();
                  take(id_of(said ? reader : info.sample_identity.writer_guid(),
                             info.sample_identity.sequence_number()),
                       std::move(bytes));
                });
  return static_cast<int>(impl_->services.size()) - 1;
}

void DdsNode::reply(int service, const RequestId& to, std::string_view cdr) {
  DdsBytes::Value value{std::string(cdr)};
  rtps::WriteParams params;
  params.related_sample_identity(identity_of(to));
  impl_->services[static_cast<std::size_t>(service)]->write(&value, params);
}

std::uint64_t DdsNode::refused() const {
  return impl_->refused;
}

}  // namespace pedicel::app
