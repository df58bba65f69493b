#include "app/topics/simulation_topics.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/topics/camera_topics.h"
#include "app/topics/frame_topics.h"
#include "app/topics/plant_topics.h"
#include "app/topics/robot_topics.h"
#include "app/topics/wrench_topic.h"
#include "plugins/simulation/instrument.h"

namespace pedicel::app {

namespace {

/// /clock: simulated time, for nodes with use_sim_time.
class ClockTopic : public TopicSource {
 public:
  explicit ClockTopic(TopicSink& sink) : clock_(sink, "/clock", Delivery::sensor) {}
  void tell(double time) override { clock_.tell(time, {ros::stamp_of(time)}); }

 private:
  Teller<ros::Clock> clock_;
};

/// /NAME/KIND of the scene's instruments, each at its own rate, with its noise. The stamp is the
/// sample's.
class InstrumentTopics : public TopicSource {
 public:
  InstrumentTopics(const simulation::Simulation& simulation, TopicSink& sink) : sink_(sink) {
    for (const auto& one : simulation.instruments())
      all_.push_back({*one,
                      sink.add({"/" + topic_part(one->scene().name) + "/" + one->kind().name,
                                one->message_type(),
                                Delivery::sensor,
                                {}}),
                      one->samples()});
  }
  void after_step(double time) override {
    for (Known& one : all_)
      if (one.instrument.samples() != std::exchange(one.told, one.instrument.samples()))
        sink_.write(one.topic, time, one.instrument.message());
  }

 private:
  struct Known {
    const simulation::Instrument& instrument;
    int topic = 0;
    long told = 0;  // samples
  };
  TopicSink& sink_;
  std::vector<Known> all_;
};

/// How many times something of this rate was due by a time. The small addition keeps a time such
/// as 0.1 from falling short of its own multiple.
long due_by(double time, double rate) {
  return static_cast<long>(std::floor(time * rate + 1e-9));
}

}  // namespace

TopicRates rates_of_log(const simulation::Simulation& simulation) {
  return {.states = simulation.scene().log_rate, .joints = 1.0 / simulation.world().dt()};
}

SimulationTopics::SimulationTopics(simulation::Simulation& simulation, TopicSink& sink,
                                   const TopicRates& rates, PictureTaker* taker)
    : simulation_(simulation), sink_(sink) {
  const auto add = [&](std::unique_ptr<TopicSource> source, double rate) {
    all_.push_back({std::move(source), rate, 0});
  };
  // First, so that what follows finds its time told.
  add(std::make_unique<ClockTopic>(sink), rates.states);
  if (simulation::RobotControl* robot = simulation.robot()) {
    add(std::make_unique<DescriptionTopic>(*robot, sink), rates.states);
    add(std::make_unique<JointTopics>(simulation, sink), rates.joints);
    // A sensor of the scene that is called so takes its place.
    const bool own = std::ranges::any_of(simulation.instruments(), [](const auto& one) {
      return one->kind().name == "wrench" && topic_part(one->scene().name) == "wrist";
    });
    if (!own && wrist_link(*robot) >= 0)
      add(std::make_unique<WrenchTopic>(simulation, sink), rates.states);
  }
  if (!simulation.instruments().empty())
    add(std::make_unique<InstrumentTopics>(simulation, sink), rates.states);
  add(std::make_unique<FrameTopics>(simulation, sink), rates.states);
  add(std::make_unique<OrganTopic>(simulation, sink), rates.states);
  add(std::make_unique<EventTopic>(simulation, sink), rates.states);
  add(std::make_unique<MarkerTopics>(simulation, sink), rates.markers);
  if (taker && taker->available() && has_sensing_camera(simulation.scene()))
    add(std::make_unique<CameraTopics>(simulation, sink, *taker), rates.states);
}

void SimulationTopics::begin() {
  const double time = simulation_.world().time();
  for (Due& one : all_) {
    one.source->begin(time);
    one.source->tell(time);
    one.last = due_by(time, one.rate);
  }
  sink_.flush();
}

void SimulationTopics::after_step() {
  const double time = simulation_.world().time();
  for (Due& one : all_) {
    one.source->after_step(time);
    const long due = due_by(time, one.rate);
    if (due == one.last) continue;
    one.last = due;
    one.source->tell(time);
  }
  sink_.flush();
}

}  // namespace pedicel::app
