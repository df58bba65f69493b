#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/frames.h"
#include "plugins/cosserat/model/joint_law.h"
#include "plugins/cosserat/model/section.h"

namespace pedicel::cosserat {

/// One rigid segment of a rod. It carries its child node (its far end) and an orientation whose
/// third axis points along the segment from its parent's node to its own. The joint at its near end
/// (bend and twist) and the strain along it (stretch and shear) are elastic. A place on it is given
/// by `back`: the distance from the child node towards the parent, in metres.
struct Element {
  int parent = -1;  ///< index of the element whose child node it starts from; -1: the root clamp
  int organ = 0;    ///< index into RodModel::organs
  double length = 0.0;       ///< m
  double radius_near = 0.0;  ///< m, at the parent's node (contact and drawing)
  double radius_far = 0.0;   ///< m, at the child node
  Section section;
  double damping_time = 0.0;  ///< s, Kelvin-Voigt
  double mass_damping = 0.0;  ///< 1/s, force = -rate * mass * velocity

  // The shape as drawn.
  Vec3 drawn_position = Vec3::Zero();      ///< m, W, child node
  Quat drawn_rotation = Quat::Identity();  ///< E to W

  // Filled in by finish() and stand_as_drawn().
  Vec3 stretch_stiffness = Vec3::Zero();  ///< N, (kGA1, kGA2, EA), in E
  Vec3 bend_stiffness = Vec3::Zero();     ///< N m/rad of the joint, about E's axes 1, 2, 3
  Vec3 rest_strain = Vec3::Zero();        ///< 1, stretch and shear of the unloaded segment, in E
  Quat rest_rotation = Quat::Identity();  ///< parent frame to E, unloaded
  double mass = 0.0;                      ///< kg, with everything that is fixed to it
  double com_back = 0.0;                  ///< m, `back` of its centre of mass
  Vec3 inertia = Vec3::Zero();            ///< kg m2 about the centre of mass, E's axes
};

/// A mass fixed to a segment: a hung weight, a sensor (radius 0), a fruit (a solid sphere).
struct PointMass {
  int element = 0;
  double back = 0.0;    ///< m
  double mass = 0.0;    ///< kg
  double radius = 0.0;  ///< m
};

/// When a fruit comes off. Infinite: never for that cause.
struct Thresholds {
  static constexpr double never = std::numeric_limits<double>::infinity();
  double stretch = never;  ///< 1, C_s^max: |stretch and shear strain| from the unloaded rest shape
  double bend = never;     ///< rad, C_b^max: |rotation| from the unloaded rest shape
  double force = never;    ///< N
  double moment = never;   ///< N m, bending
  double torsion = never;  ///< N m
};

/// A fruit comes off where (N/force)^a + (M/moment)^b + (T/torsion)^c reaches 1, with the joint's
/// force, bending moment and torsion; an infinite scale leaves its term out.
struct DetachmentLaw {
  double force = Thresholds::never;    ///< N
  double moment = Thresholds::never;   ///< N m
  double torsion = Thresholds::never;  ///< N m
  Vec3 exponents = Vec3(2, 2, 2);      ///< 1, a, b, c
};

/// A sphere on a segment that the thresholds of the joint under it hold. It is centred on the
/// centreline. At a rod's tip the carrying segment goes with it when it comes off, as the stub of
/// its stalk; elsewhere only the fruit goes.
struct Fruit {
  std::string name;
  int element = 0;
  double back = 0.0;     ///< m
  double radius = 0.0;   ///< m
  double density = 0.0;  ///< kg/m3
  Thresholds thresholds;
  std::optional<DetachmentLaw> law = {};  ///< in place of the thresholds
};

/// A point of the plant that is held to a pose of the world by stiff springs: a stem hung from a
/// beam, a tied stake.
struct Support {
  int element = 0;
  double back = 0.0;                       ///< m
  Vec3 position = Vec3::Zero();            ///< m, W, of the held point
  Quat rotation = Quat::Identity();        ///< E to W at which the rotational springs are unloaded;
                                           ///< finish() sets it to the drawn one
  double position_stiffness = 0.0;         ///< N/m
  Vec3 rotation_stiffness = Vec3::Zero();  ///< N m/rad about E's axes
};

/// Closes a loop of segments (leaves): the child nodes of two elements are one node, and their
/// frames keep their drawn relative rotation elastically.
struct Weld {
  int a = 0, b = 0;
  double position_stiffness = 0.0;        ///< N/m
  Vec3 bend_stiffness = Vec3::Zero();     ///< N m/rad about b's axes
  Quat rest_rotation = Quat::Identity();  ///< a's frame to b's, unloaded
};

/// A string between two places: it pulls both where it is longer than `length`, and bears no
/// pressure. Only the model that plants were joined to has any (JoinedModel).
struct Strand {
  int a = 0, b = 0;                   ///< elements, two of them
  double back_a = 0.0, back_b = 0.0;  ///< m
  double length = 0.0;                ///< m, where it becomes taut
  double stiffness = 0.0;             ///< N/m
};

/// A tapered capsule between two places of a segment (a sphere where they are the same), which may
/// touch other things.
struct CollisionShape {
  int element = 0;
  double back_near = 0.0, back_far = 0.0;      ///< m
  double radius_near = 0.0, radius_far = 0.0;  ///< m
  int fruit = -1;                              ///< index of the fruit that it is, -1: a stem
};

/// The air about a segment, and its drag: a force per metre of 1/2 rho drag_area |u| u, where u is
/// the air's velocity less the segment's (in its middle) without the part along the segment.
struct SegmentAir {
  static constexpr double density = 1.2;  ///< kg/m3, of air
  double drag_area = 0.0;                 ///< m2/m, drag coefficient included
  Vec3 velocity = Vec3::Zero();           ///< m/s, W, of the air, in the mean
  Vec3 gust = Vec3::Zero();               ///< m/s, W, times sin(2 pi gust_frequency t)
  /// A plate on it: beside that drag, 1/2 rho area |v| v of each of two parts v of the air's whole
  /// velocity less the segment's, along the plate's normal and across it.
  double plate_normal = 0.0, plate_tangential = 0.0;  ///< m2/m, areas, drag coefficients included
  Vec3 plate = Vec3::Zero();                          ///< E, its normal, unit
  bool has_plate() const { return plate_normal > 0.0 || plate_tangential > 0.0; }
};

/// The constants of one plant: a tree of segments (with welds: a graph). What changes is RodState.
struct RodModel {
  std::string name;
  Pose root;                        ///< X_W of the clamp; segments with parent -1 start there
  std::vector<Element> elements;    ///< a parent stands before its children
  std::vector<std::string> organs;  ///< "plant/stem", "plant/truss", "plant/leaf_1"
  std::vector<PointMass> masses;
  std::vector<Fruit> fruits;
  std::vector<Support> supports;
  std::vector<Weld> welds;
  std::vector<Strand> strands;
  std::vector<CollisionShape> shapes;  ///< made by finish(): one a segment, then one a fruit

  // Extensions (direct solver only). Empty: none; else one entry an element.
  std::vector<JointLaw> laws;
  std::vector<SegmentAir> air;
  double gust_frequency = 0.0;   ///< Hz
  double stiffness_drift = 0.0;  ///< 1/s: E (1 + stiffness_drift (clock + t))
  double clock = 0.0;            ///< s, at t = 0

  int size() const { return static_cast<int>(elements.size()); }
  /// Drawn position of the near end of an element.
  Vec3 drawn_start(int element) const;
};

/// Adds a segment from its parent's node to `end_W`. Its frame's third axis is along it; its first
/// axis is the projection of `normal_W` where that is not zero (sections with two extents), else
/// the parent's first axis carried over with the least rotation. Returns its index. Throws
/// UsageError where the segment has no length.
int add_element(RodModel& model, int parent, const Vec3& end_W, const Section& section,
                const Vec3& normal_W = Vec3::Zero());

/// Computes joint stiffnesses, inertias (with masses and fruits), shapes, and a rest shape that is
/// the drawn one, unloaded. Call it once everything is added.
///
/// Joint compliance per axis is l_p / (2 EI_p) + l_c / (2 EI_c), and l / (2 EI) at a clamp: each of
/// the two half segments that meet at a joint bends by itself.
void finish(RodModel& model);

/// Recomputes mass, centre of mass and inertia of one segment, leaving out fruits that are marked
/// as gone (`fruit_gone` empty: none is).
void lump_inertia(RodModel& model, int element, const std::vector<bool>& fruit_gone = {});

/// Elements whose nodes are welded together, each by the first of them; the others by themselves.
std::vector<int> first_of_welded(const RodModel& model);

/// Whether two finished models are one plant with other constants: the same elements (parents,
/// organs, lengths, drawn shape), organs, fruits (names and places), welds and shapes, without
/// joint laws. A welded node is drawn where its weld's first one is: the gap through which the weld
/// carries its load in the plant as it stands is no shape.
bool differs_in_constants_only(const RodModel& a, const RodModel& b);

/// Mass and volume of a fruit.
double fruit_mass(const Fruit& fruit);

}  // namespace pedicel::cosserat
