#include "engine/ros_messages/cdr.h"
#include "engine/ros_messages/common_messages.h"
#include "plugins/simulation/instrument.h"
#include "plugins/simulation/link_wrench.h"
#include "plugins/simulation/scene_assets.h"

namespace pedicel::simulation {

namespace {

/// As the scene's effects have it; plain of a sensor that the scene does not have.
Gauge gauge_of(const Simulation& simulation, const world::SceneInstrument& scene) {
  Gauge gauge;
  if (!simulation.assets()->effects) return gauge;
  auto of_effects = simulation.assets()->effects->state.gauges.begin();
  for (const world::SceneInstrument& one : of_kind(simulation.scene(), scene.kind())) {
    if (one.name == scene.name) {
      gauge = {of_effects->gain, Eigen::VectorXd(6)};
      gauge.bias << of_effects->force, of_effects->moment;
    }
    ++of_effects;
  }
  return gauge;
}

/// A force sensor at a link: in a wrist, or in a fingertip.
class WrenchSensor : public Instrument {
 public:
  WrenchSensor(Simulation& simulation, const world::SceneInstrument& scene)
      : Instrument(scene, simulation.scene().seed, scene.name, gauge_of(simulation, scene)),
        wrench_(simulation, link_of(simulation, scene)) {}

  std::vector<ros::Definition> message_type() const override {
    return ros::definitions_of<ros::WrenchStamped>();
  }
  std::string message() const override {
    const Eigen::VectorXd& now = reading();
    return ros::to_cdr(ros::WrenchStamped{{ros::stamp_of(reading_time()), scene().link},
                                          {{now[0], now[1], now[2]}, {now[3], now[4], now[5]}}});
  }

 protected:
  void measure(world::SimWorld&, Eigen::VectorXd& exact) override {
    exact = scene().touch ? wrench_.touch() : wrench_.carried();
  }

 private:
  LinkWrench wrench_;
};

}  // namespace

std::unique_ptr<Instrument> make_wrench(Simulation& simulation,
                                        const world::SceneInstrument& scene) {
  return std::make_unique<WrenchSensor>(simulation, scene);
}

}  // namespace pedicel::simulation
