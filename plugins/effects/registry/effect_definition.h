#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/io/bounds.h"
#include "plugins/effects/registry/effect_start.h"
#include "plugins/effects/registry/model_change.h"

namespace pedicel::io {
class YamlNode;
}

/// Everything that Pedicel knows of an effect, in one place. Readers, builders, fits, verdicts,
/// reports, the window and the manual all ask the definition; none of them knows a name.
namespace pedicel::effects {

/// The kind of file in which an effect stands.
enum class EffectFile { plant, experiment };

/// What an effect changes.
enum class Home {
  material,  ///< a number of the plant's material
  joint,     ///< the law of the joints between elements, or the stiffness of some
  element,   ///< masses of elements
  whole,     ///< the plant as a whole
  base,      ///< the joint at the root
  air,       ///< what the air does
  stalk,     ///< when a fruit comes off
  grip,      ///< how a hand holds the plant
  sensor,    ///< what the instruments report
};

/// Effects of one kind: where one of them acts, another law of the same kind takes up what two
/// honest implementations of the first differ by.
enum class Family { alone, memory, mass, softness, nonlinearity, air, grip, frame };

/// What a parameter says: how large the effect is, of what shape, or when it happens (s).
enum class Role { size, shape, time };

struct EffectParameter {
  std::string name;
  std::string unit = "1";
  io::Bounds bounds = io::any_number;
  std::string sentence;  ///< what it is
  int size = 1;          ///< numbers it has; 0: it is a word
  bool required = true;
  std::string otherwise = {};           ///< what holds where it is left out, for the manual
  bool offered = true;                  ///< one that is not required: a new effect has it
  std::vector<std::string> words = {};  ///< that it may be; empty: any
  Vanishes vanishes = Vanishes::never;  ///< where the effect does nothing
  Role role = Role::size;
  std::vector<double> first = {0.0};  ///< what a new effect begins with
};

/// How a hand holds the plant.
struct GripState {
  double stiffness = 0.0;                                      ///< N/m
  double slip_distance = 0.0;                                  ///< m along the stem
  double slip_time = std::numeric_limits<double>::infinity();  ///< s, when it slips
};

/// What stands between the plant and what the instruments say of it.
struct SensorState {
  std::vector<std::string> markers;  ///< names
  std::vector<Vec3> offset;          ///< m, of each marker, turning with its element
  double delay = 0.0;                ///< s, by which markers come late
  double marker_lag = 0.0;           ///< s, y' = (x - y)/lag of marker places, at rest at time 0
  double force_lag = 0.0;            ///< s, the same of forces
  Mat3 frame = Mat3::Identity();     ///< of positions, about the world's origin
  double gain = 1.0;                 ///< of forces
  Vec3 force_offset = Vec3::Zero();  ///< N, W
};

struct GripChange {
  void (*apply)(const plant::Effect&, GripState&) = nullptr;
};
struct SensorChange {
  void (*apply)(const plant::Effect&, SensorState&) = nullptr;
};
/// Nothing is simulated: it is found in the data before any physics.
struct NoChange {};

/// What in the data speaks for an effect: a symptom by its name, and how strongly, 1 first.
struct Sign {
  std::string symptom;
  int rank = 1;
  /// The parameter whose value the symptom's own number gives, to first order; empty: the symptom
  /// says which effect it may be, and not how large.
  std::string parameter = {};
  /// That value from the symptom's, which is in the unit in which the symptom is told.
  double (*value)(double symptom, const StartContext&) = nullptr;
  std::string word = {};  ///< of the starts that this is about; empty: of all
};

/// A bound of a parameter at which the effect is, or goes over into, another one: relaxation with a
/// time longer than the longest trial is creep, a weak stretch of no length is a hinge.
struct Limit {
  std::string parameter;
  bool high = false;  ///< the upper bound; else the lower one
  std::string becomes;
};

struct EffectDefinition {
  std::string name;        ///< as files say it
  std::string plain_name;  ///< "a root that turns elastically", for sentences
  std::string sentence;    ///< what it does, for the manual and the window
  EffectFile file = EffectFile::plant;
  Home home = Home::joint;
  Family family = Family::alone;
  bool needs_place = false;
  std::vector<EffectParameter> parameters;
  /// Faults of what was read beyond each parameter's bounds go to the node.
  void (*check)(const io::YamlNode&, const plant::Effect&) = nullptr;
  std::variant<NoChange, ModelChange, GripChange, SensorChange> change;

  // For the diagnosis.
  /// From where fits of it start; null: it is never fitted. Home::material: part of every baseline.
  std::vector<Start> (*starts)(const StartContext&) = nullptr;
  bool is_candidate = true;  ///< false: a diagnosis does not try it; it is fitted where asked for
  std::vector<Sign> speaks_for;
  std::string tells_apart;  ///< an experiment that parts it from its look-alikes; may be empty
  std::vector<std::string> special_cases;  ///< effects that it has as special cases
  std::vector<Limit> limits;
  std::string instead_of;      ///< a number of the material that it may stand for
  bool has_threshold = false;  ///< it does nothing while it is small
  /// An effect that does nearly the same in a single straight stem, and what it multiplies the
  /// modulus by; null: there is none.
  plant::Effect (*twin)(const plant::Effect&, double& modulus) = nullptr;
  const plant::MaterialKey* material = nullptr;  ///< the number that the factor is on
  std::string less, more;                        ///< than the file says: "softer", "stiffer"
  /// For the one effect that is what two honest solvers differ by where a branch leaves its stem:
  /// it at the junction of `curve`, with sizes that nobody would name. `softest`, N m/rad, is the
  /// most that a discretisation can make of it.
  Start (*at_junction)(const std::string& curve, double softest) = nullptr;

  const EffectParameter* find(const std::string& parameter) const;
};

/// Every known effect, in the order of the list in plugins/effects/CMakeLists.txt.
const std::vector<EffectDefinition>& effect_definitions();
/// Null where there is none of that name.
const EffectDefinition* find_effect(const std::string& name);
/// Null where there is no such effect, or it has no such parameter.
const EffectParameter* find_parameter(const std::string& effect, const std::string& parameter);

/// "a root that turns elastically"; the name itself where nothing is known of it.
std::string plain_name(const std::string& effect);
/// Unit of an effect's parameter, "1" where it has none.
std::string unit_of(const std::string& effect, const std::string& parameter);
/// Whether a parameter says when something happens, or how much later (s).
bool is_time(const std::string& effect, const std::string& parameter);
/// The effects that are factors on the material's numbers, in the order of all.
const std::vector<const EffectDefinition*>& material_factors();
/// The one on the number of that role, which is not none.
const EffectDefinition& material_factor(plant::MaterialRole role);
bool same_family(const std::string& a, const std::string& b);
/// Pairs of effects, of which the second has the first as a special case: a wind of no speed is
/// drag.
std::vector<std::pair<std::string, std::string>> special_cases();
bool is_special_case(const std::string& special, const std::string& general);
/// Names of the effects that a symptom speaks for, the strongest first.
std::vector<std::string> spoken_for(const std::string& symptom);

/// Those of the effects that change the grip, or the instruments, applied in their order.
void apply_to_grip(const plant::Effect& effect, GripState& grip);
void apply_to_sensor(const plant::Effect& effect, SensorState& sensor);

/// What plugins/effects/CMakeLists.txt makes of its list.
std::vector<EffectDefinition> make_effect_definitions();

}  // namespace pedicel::effects
