#pragma once

#include <memory>
#include <vector>

#include "app/draw/pictures.h"
#include "app/topics/topic_source.h"

namespace pedicel::app {

struct TopicRates {
  double states = 100.0;  ///< Hz, of simulated time: frames, forces, the clock
  double joints = 100.0;  ///< Hz, of joint states and commands
  double markers = 10.0;  ///< Hz, of what RViz draws
};

/// Of a file that keeps a run: the scene's log_rate; joints at each step, so that the run can be
/// led along them again.
TopicRates rates_of_log(const simulation::Simulation& simulation);

/// Everything that a simulation tells on topics, to one sink.
class SimulationTopics {
 public:
  /// All must outlive it. `taker`: for the cameras of the scene; null, or one that takes no
  /// pictures: there are none.
  SimulationTopics(simulation::Simulation& simulation, TopicSink& sink, const TopicRates& rates,
                   PictureTaker* taker = nullptr);

  /// Before the first step: what stays as it is, and how all things stand.
  void begin();
  /// After every step: what is due.
  void after_step();

 private:
  struct Due {
    std::unique_ptr<TopicSource> source;
    double rate = 0.0;  // Hz
    long last = 0;
  };
  simulation::Simulation& simulation_;
  TopicSink& sink_;
  std::vector<Due> all_;
};

}  // namespace pedicel::app
