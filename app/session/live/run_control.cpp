#include "app/session/live/run_control.h"

#include <cmath>

#include "app/session/live/pull.h"
#include "app/session/live/run_thread.h"

namespace pedicel::app {

struct RunControl::Impl {
  mutable RunThread thread;
};

RunControl::RunControl() : impl_(std::make_unique<Impl>()) {}
RunControl::~RunControl() = default;

void RunControl::build(MakeAssets make, std::uint64_t document_hash, bool restart) {
  impl_->thread.ask_build({std::move(make), document_hash, restart});
}
void RunControl::play() {
  impl_->thread.ask([](RunPlayer& player) { player.play(); });
}
void RunControl::pause() {
  impl_->thread.ask([](RunPlayer& player) { player.pause(); });
}
void RunControl::step(long count) {
  impl_->thread.ask([count](RunPlayer& player) { player.advance(count); });
}
void RunControl::run_for(double duration) {
  impl_->thread.ask([duration](RunPlayer& player) {
    if (player.run())
      player.advance(std::lround(duration / player.run()->simulation().world().dt()));
  });
}
void RunControl::step_back(long count) {
  impl_->thread.ask([count](RunPlayer& player) { player.go_to(player.position() - count); });
}
void RunControl::go_to_step(long step) {
  impl_->thread.ask([step](RunPlayer& player) { player.go_to(step); });
}
void RunControl::take_back_to(long step) {
  impl_->thread.ask([step](RunPlayer& player) {
    player.go_to(step);
    player.act([](LiveRun&) {});  // nothing is done from here on
  });
}
void RunControl::reset() {
  impl_->thread.ask([](RunPlayer& player) { player.reset(); });
}
void RunControl::set_speed(double speed) {
  impl_->thread.ask([speed](RunPlayer& player) { player.set_speed(speed); });
}

void RunControl::hold_at(std::optional<double> time) {
  impl_->thread.ask([time](RunPlayer& player) { player.hold_at(time); });
}

void RunControl::begin_pull(const PullPlace& place, const Vec3& target_W) {
  impl_->thread.ask([place, target_W](RunPlayer& player) {
    player.act([place, target_W](LiveRun& run) { run.pull().begin(place, target_W); });
  });
}
void RunControl::move_pull(const Vec3& target_W) {
  impl_->thread.ask([target_W](RunPlayer& player) {
    player.act([target_W](LiveRun& run) { run.pull().move(target_W); });
  });
}
void RunControl::end_pull() {
  impl_->thread.ask([](RunPlayer& player) { player.act([](LiveRun& run) { run.pull().end(); }); });
}

void RunControl::cut(const std::string& organ, double at) {
  impl_->thread.ask([organ, at](RunPlayer& player) {
    player.act([organ, at](LiveRun& run) {
      if (run.simulation().cutting().can_cut(organ, at)) run.simulation().cutting().cut(organ, at);
    });
  });
}

void RunControl::move_robot(const Eigen::VectorXd& q) {
  impl_->thread.ask([q](RunPlayer& player) {
    player.act([q](LiveRun& run) {
      if (simulation::RobotControl* robot = run.simulation().robot()) robot->go_to(q);
    });
  });
}

void RunControl::play_trajectory(robot::Trajectory trajectory) {
  impl_->thread.ask([trajectory = std::move(trajectory)](RunPlayer& player) {
    player.act([trajectory](LiveRun& run) {
      if (simulation::RobotControl* robot = run.simulation().robot())
        robot->set_trajectory(trajectory, run.simulation().world().time());
    });
  });
}

void RunControl::play_loop(robot::Trajectory lead, robot::Trajectory lap) {
  impl_->thread.ask([lead = std::move(lead), lap = std::move(lap)](RunPlayer& player) {
    player.act([lead, lap](LiveRun& run) {
      if (simulation::RobotControl* robot = run.simulation().robot())
        robot->set_program({lead, lap, run.simulation().world().time()});
    });
  });
}

void RunControl::stop_robot() {
  impl_->thread.ask([](RunPlayer& player) {
    player.act([](LiveRun& run) {
      if (simulation::RobotControl* robot = run.simulation().robot()) robot->stop();
    });
  });
}

std::shared_ptr<const Snapshot> RunControl::snapshot() const {
  return impl_->thread.snapshot();
}
double RunControl::building_for() const {
  return impl_->thread.building_for();
}
std::vector<BuildNews> RunControl::take_news() {
  return impl_->thread.take_news();
}
RunLog& RunControl::log() {
  return impl_->thread.log();
}
const RunLog& RunControl::log() const {
  return impl_->thread.log();
}
void RunControl::wait() const {
  impl_->thread.wait();
}

std::uint64_t RunControl::state_hash() const {
  std::uint64_t hash = 0;
  impl_->thread.ask([&hash](RunPlayer& player) {
    hash = player.run() ? player.run()->simulation().state_hash() : 0;
  });
  impl_->thread.wait();
  return hash;
}

}  // namespace pedicel::app
