#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/cosserat/model/rod_state.h"

namespace pedicel::cosserat {

/// The record of a fruit that came off, taken at the end of the step in which it broke.
struct DetachEvent {
  double time = 0.0;     ///< s
  int fruit = -1;        ///< index into RodModel::fruits
  std::string cause;     ///< stretch | bend | force | moment | torsion | law
  double stretch = 0.0;  ///< 1, |C_s| at the break
  double bend = 0.0;     ///< rad, |C_b| at the break
  double force = 0.0;    ///< N, |force| in the joint
  double moment = 0.0;   ///< N m, |bending moment|
  double torsion = 0.0;  ///< N m
  double angle = 0.0;    ///< rad, between the stalk's axis and the vertical

  // The rigid body that goes on.
  Vec3 position_W = Vec3::Zero();          ///< m, fruit centre
  Quat orientation = Quat::Identity();     ///< E to W
  Vec3 velocity_W = Vec3::Zero();          ///< m/s, at the fruit's centre
  Vec3 angular_velocity_W = Vec3::Zero();  ///< rad/s
  double mass = 0.0;                       ///< kg, fruit and stub
  double stub_length = 0.0;                ///< m, of the stalk's stub that goes with it; 0: none
  double stub_radius = 0.0;                ///< m
};

/// What can break a stalk, by its place in stalk_limits. The first two are strains from the
/// unloaded shape, as the paper's are; loads follow.
enum StalkLoad { stalk_stretch, stalk_bend, stalk_force, stalk_moment, stalk_torsion };

/// One of them: its name as files and events say it, and where its threshold and its value at the
/// break are kept. Plant files, events, break laws and diagnoses walk the list.
struct StalkLimit {
  std::string_view name, unit;
  double Thresholds::*threshold;
  double DetachEvent::*at_break;
};
inline constexpr std::array stalk_limits = {
    StalkLimit{"stretch", "1", &Thresholds::stretch, &DetachEvent::stretch},
    StalkLimit{"bend", "rad", &Thresholds::bend, &DetachEvent::bend},
    StalkLimit{"force", "N", &Thresholds::force, &DetachEvent::force},
    StalkLimit{"moment", "N m", &Thresholds::moment, &DetachEvent::moment},
    StalkLimit{"torsion", "N m", &Thresholds::torsion, &DetachEvent::torsion}};
static_assert(stalk_limits[stalk_torsion].name == "torsion");

/// One number a limit, in the units of stalk_limits.
using StalkNumbers = std::array<double, stalk_limits.size()>;
/// What the joint at the near end of an element carries.
StalkNumbers stalk_numbers(const RodModel& model, const RodState& state, int element);

/// What the stalks of all fruits carried when a step began, and how long it took.
struct StalkStart {
  std::vector<JointLoad> loads;  ///< one a fruit; empty: damping is left out
  double dt = 0.0;               ///< s
};
/// Loads of the stalks that have a limit of load, before a step. Reuses what `start` holds.
void begin_stalks(const RodModel& model, const RodState& state, double dt, StalkStart& start);

/// Checks the thresholds of every fruit that is still on and takes those off that pass one: at a
/// tip the element dies with its fruit, elsewhere the element only gets lighter. Appends to
/// `events`. Force, moment and torsion are those that the stalk passes on, damping included, as a
/// load cell would see them; strains and laws know the elastic part alone.
void detach(RodModel& model, RodState& state, std::vector<DetachEvent>& events,
            const StalkStart& start = {});

/// Takes a fruit off that is still on, whatever its joint carries.
void take_off(RodModel& model, RodState& state, int fruit);

/// A part of a plant that was cut off, as the rigid body that goes on.
struct CutOff {
  std::vector<int> elements;               ///< all of it, ascending; they are alive no more
  std::vector<int> fruits;                 ///< that hung on it
  double mass = 0.0;                       ///< kg
  Vec3 centre_W = Vec3::Zero();            ///< m, of mass
  Vec3 velocity_W = Vec3::Zero();          ///< m/s, there
  Vec3 angular_velocity_W = Vec3::Zero();  ///< rad/s
};
/// Cuts a plant through at the near end of an element that is alive: it and all that it carries
/// come off. Linear and angular momentum go along.
CutOff cut(const RodModel& model, RodState& state, int element);

/// How near a fruit is to coming off: the largest ratio of a strain or load to its threshold, or
/// the sum of its law (1 breaks).
double margin_used(const RodModel& model, const RodState& state, int fruit);

}  // namespace pedicel::cosserat
