#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/frames.h"
#include "engine/core/parameter.h"
#include "engine/core/state_hash.h"
#include "engine/world/bodies.h"
#include "engine/world/step.h"

class btMultiBodyDynamicsWorld;

namespace pedicel::world {

struct WorldSettings {
  double dt = 1.0 / 240.0;           ///< s, of every step
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< m/s2, W
  int solver_iterations = 50;        ///< 1, of Bullet's contact and motor solver
};
std::vector<Parameter> parameters_of(WorldSettings& settings);

/// Bullet's world with the one step in it (see step()). It owns the rigid bodies; robots are put
/// into bullet() by their own code; plants are participants. Two worlds in one program do not touch
/// each other.
class SimWorld {
 public:
  /// Throws UsageError where a setting is outside its bounds.
  explicit SimWorld(const WorldSettings& settings);
  ~SimWorld();
  SimWorld(const SimWorld&) = delete;
  SimWorld& operator=(const SimWorld&) = delete;

  const WorldSettings& settings() const { return settings_; }
  double dt() const { return settings_.dt; }
  double time() const { return static_cast<double>(steps_) * settings_.dt; }  ///< s
  long steps() const { return steps_; }

  /// Everything that takes part is added at set-up, in the order in which it acts within its phase,
  /// and must outlive the world's last step. Throws UsageError where a participant declares a phase
  /// that is not open to participants.
  void add(Participant& participant);
  void add(Observer& observer);
  /// Comes after all observers.
  void set_recorder(Observer* recorder) { recorder_ = recorder; }

  /// commands -> control -> Bullet -> plants -> observers -> recorder.
  const WorldReport& step();
  const WorldReport& report() const { return report_; }

  /// Adds a body; returns its index. May be called from within a step (a fruit that came off): it
  /// then moves from the next one on. Throws UsageError where it has no parts, a part without size,
  /// or a name that is taken.
  int add_body(const BodyDescription& body);
  void set_ground(const GroundPlane& ground);
  int body_count() const { return static_cast<int>(bodies_.size()); }
  /// -1 where there is none of that name.
  int body_index(std::string_view name) const;
  const BodyDescription& body(int index) const;
  Pose body_pose(int index) const;              ///< X_W of the body's frame
  Vec3 body_velocity(int index) const;          ///< m/s, W, of its centre of mass
  Vec3 body_angular_velocity(int index) const;  ///< rad/s, W
  /// Acts during the next step only. N, at a point of the world, m.
  void push_body(int index, const Vec3& force_W, const Vec3& point_W);

  /// A force (N, at a point, m) and a moment (N m) on a body that belong to the step which is
  /// ending: from within the plants phase. Velocities change by what they do in dt, the pose by dt
  /// times that.
  void add_body_reaction(int index, const Vec3& force_W, const Vec3& point_W, const Vec3& moment_W);
  /// 1/kg: at most what a unit impulse at a point of the body changes that point's velocity by.
  double body_inverse_inertia(int index, const Vec3& point_W) const;

  /// For robots. Its callback slots belong to this class.
  btMultiBodyDynamicsWorld& bullet();

  /// Time and all rigid bodies.
  void add_to(StateHash& hash) const;

 private:
  struct Bullet;
  struct Body;
  void run(Phase phase);
  void check_bodies();

  WorldSettings settings_;
  std::unique_ptr<Bullet> bullet_;
  std::vector<std::unique_ptr<Body>> bodies_;
  std::vector<Participant*> participants_;
  std::vector<Observer*> observers_;
  Observer* recorder_ = nullptr;
  WorldReport report_;
  long steps_ = 0;
};

}  // namespace pedicel::world
