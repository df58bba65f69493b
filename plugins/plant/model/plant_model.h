#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/core/frames.h"
#include "plugins/plant/model/plant_key.h"

namespace pedicel::plant {

/// Where something stands in its file. Takes no part in comparisons: two plants are equal when they
/// say the same, wherever they say it.
struct Where : SourcePosition {
  Where() = default;
  Where(SourcePosition position) : SourcePosition(std::move(position)) {}
  friend bool operator==(const Where&, const Where&) { return true; }
};

/// Folders in which the files that a plant names are looked for, first come first. Takes no part in
/// comparisons, as Where.
struct SearchPath : std::vector<std::filesystem::path> {
  using std::vector<std::filesystem::path>::vector;
  friend bool operator==(const SearchPath&, const SearchPath&) { return true; }
};

enum class Shape { drawn, rest };
inline constexpr std::string_view shape_words[] = {"drawn", "rest"};
/// What bark, leaves and fruits look like. Says nothing about the mechanics.
enum class Look { tomato, apple };
inline constexpr std::string_view look_words[] = {"tomato", "apple"};
enum class Interpolation { smooth, linear };
inline constexpr std::string_view interpolation_words[] = {"smooth", "linear"};
enum class SectionKind { circle, ellipse, rectangle };
inline constexpr std::string_view section_words[] = {"circle", "ellipse", "rectangle"};

/// How well numbers of a material are known: relative standard deviations, > 0.
struct MaterialKnowledge {
  std::optional<double> youngs_modulus, density, damping_time;
  bool operator==(const MaterialKnowledge&) const = default;
};

/// Material as the file gives it; what a curve leaves out comes from the plant.
struct MaterialValues {
  std::optional<double> youngs_modulus;  ///< Pa, > 0
  std::optional<double> poisson_ratio;   ///< 1, in (-1, 0.5]
  std::optional<double> density;         ///< kg/m3, > 0
  std::optional<double> damping_time;    ///< s, >= 0
  MaterialKnowledge known_to = {};
  bool operator==(const MaterialValues&) const = default;
};

/// What a number of the material does to motions. Diagnoses search factors on those with a role;
/// the effect of that name (plugins/effects) is the factor.
enum class MaterialRole { none, stiffness, mass, damping };

struct MaterialKey : PlantKey<MaterialValues> {
  MaterialRole role = MaterialRole::none;
  std::optional<double> MaterialKnowledge::*known_to = nullptr;  ///< how well it is known
  bool needed = true;  ///< a curve has to have it in the end, from its own map or the plant's
};
inline constexpr MaterialKey material_keys[] = {
    {{.name = "youngs_modulus",
      .unit = "Pa",
      .bounds = io::positive,
      .sentence = "Stiffness of the stems (those with their own keep their ratio to it); a green "
                  "stem 1e7 to 1e9, wood 1e10.",
      .label = "Modulus",
      .tip = "Stiffness of this stem",
      .slider = {1.0e5, 1.0e11, true},
      .member = &MaterialValues::youngs_modulus},
     MaterialRole::stiffness,
     &MaterialKnowledge::youngs_modulus},
    {{.name = "poisson_ratio",
      .bounds = {-1.0, 0.5, true},
      .sentence = "Decides the shear and twist stiffness; 0.3 to 0.4 for tissue.",
      .label = "Poisson ratio",
      .tip = "Shear and twist of this stem",
      .slider = {-0.9, 0.5},
      .member = &MaterialValues::poisson_ratio}},
    {{.name = "density",
      .unit = "kg/m3",
      .bounds = io::positive,
      .sentence = "Mass of the stems (those with their own keep their ratio to it); fresh tissue "
                  "700 to 1000.",
      .label = "Density",
      .tip = "Mass of this stem",
      .slider = {50.0, 3000.0},
      .member = &MaterialValues::density},
     MaterialRole::mass,
     &MaterialKnowledge::density},
    {{.name = "damping_time",
      .unit = "s",
      .bounds = io::not_negative,
      .sentence = "Kelvin-Voigt: damping ratio = pi * frequency * this; 0.01 calms a stem within "
                  "seconds. Stems with their own keep their ratio to it.",
      .label = "Damping",
      .tip = "Kelvin-Voigt time of this stem",
      .slider = {0.0, 1.0},
      .member = &MaterialValues::damping_time},
     MaterialRole::damping,
     &MaterialKnowledge::damping_time}};

/// The number of the material that has a role other than none.
constexpr const MaterialKey& material_key(MaterialRole role) {
  const MaterialKey* found = material_keys;
  while (found->role != role) ++found;
  return *found;
}
/// How well a number is known, 1, a relative standard deviation; 0: the file does not say.
inline double stated_knowledge(const MaterialValues& material, const MaterialKey& key) {
  return key.known_to ? (material.known_to.*key.known_to).value_or(0.0) : 0.0;
}
/// Numbers of the material that have a role.
constexpr int count_roles() {
  int count = 0;
  for (const MaterialKey& key : material_keys) count += key.role != MaterialRole::none ? 1 : 0;
  return count;
}

/// Cross-section of a curve; `normal` is the direction of the smaller extent.
struct SectionShape {
  SectionKind kind = SectionKind::circle;
  double ratio = 1.0;          ///< 1, ellipse: minor over major axis
  double width = 0.0;          ///< m, rectangle
  double height = 0.0;         ///< m, rectangle
  Vec3 normal = Vec3::Zero();  ///< P; zero for a circle
  bool operator==(const SectionShape&) const = default;
};
inline constexpr PlantKey<SectionShape> section_keys[] = {
    {.name = "kind",
     .sentence = "Shape of the cross-section.",
     .member = one_of<&SectionShape::kind>(section_words, true)},
    {.name = "ratio",
     .bounds = {0.0, 1.0, true},
     .sentence = "Of an ellipse: its minor over its major axis.",
     .stands = [](const SectionShape& s) { return s.kind == SectionKind::ellipse; },
     .member = &SectionShape::ratio},
    {.name = "width",
     .unit = "m",
     .bounds = io::positive,
     .sentence = "Of a rectangle: its larger extent.",
     .stands = [](const SectionShape& s) { return s.kind == SectionKind::rectangle; },
     .member = &SectionShape::width},
    {.name = "height",
     .unit = "m",
     .bounds = io::positive,
     .sentence = "Of a rectangle: its smaller extent, along the normal.",
     .stands = [](const SectionShape& s) { return s.kind == SectionKind::rectangle; },
     .member = &SectionShape::height},
    {.name = "normal",
     .sentence = "Direction of the smaller extent.",
     .stands = [](const SectionShape& s) { return s.kind != SectionKind::circle; },
     .member = &SectionShape::normal}};

struct PlantCurve {
  std::string name;
  Interpolation interpolation = Interpolation::smooth;
  std::vector<Vec3> points;    ///< m, P, at least two
  std::vector<double> radius;  ///< m, one number or one a point; may be empty with a rectangle
  SectionShape section;
  MaterialValues material;  ///< overrides of the plant's
  Where where;
  bool operator==(const PlantCurve&) const = default;
};
/// Beside its name, its points, its radius (one number or a list), its section and its material.
inline constexpr PlantKey<PlantCurve> curve_keys[] = {
    {.name = "interpolation",
     .sentence = "What lies between two points: a smooth curve, or a straight line.",
     .member = one_of<&PlantCurve::interpolation>(interpolation_words, true)}};

/// A place on a curve: the fraction of its drawn arc length from its first point.
struct CurvePlace {
  std::string curve;
  double at = 0.0;  ///< 1, in [0, 1]
  Where where;
  bool operator==(const CurvePlace&) const = default;
};

/// Limits of the joint that carries a fruit; what is absent never breaks it.
struct DetachLimits {
  std::optional<double> stretch;  ///< 1, C_s^max
  std::optional<double> bend;     ///< rad, C_b^max
  std::optional<double> force;    ///< N
  std::optional<double> moment;   ///< N m
  std::optional<double> torsion;  ///< N m
  bool operator==(const DetachLimits&) const = default;
};
/// In the order of cosserat::stalk_limits.
inline constexpr PlantKey<DetachLimits> detach_keys[] = {
    {.name = "stretch",
     .bounds = io::positive,
     .sentence = "Strain of its stalk at which a fruit comes off.",
     .label = "Off at strain of",
     .tip = "strain at which it comes off",
     .slider = {1.0e-3, 2.0, true},
     .member = &DetachLimits::stretch},
    {.name = "bend",
     .unit = "rad",
     .bounds = io::positive,
     .sentence = "Bending of its stalk's joint at which a fruit comes off.",
     .label = "or bent by",
     .tip = "at which it comes off",
     .slider = {1.0e-3, 3.2, true},
     .member = &DetachLimits::bend},
    {.name = "force",
     .unit = "N",
     .bounds = io::positive,
     .sentence = "Force in its stalk at which a fruit comes off.",
     .label = "or at a force of",
     .tip = "at which it comes off",
     .slider = {1.0e-3, 1.0e3, true},
     .member = &DetachLimits::force},
    {.name = "moment",
     .unit = "N m",
     .bounds = io::positive,
     .sentence = "Bending moment in its stalk at which a fruit comes off.",
     .label = "or a moment of",
     .tip = "at which it comes off",
     .slider = {1.0e-5, 1.0e2, true},
     .member = &DetachLimits::moment},
    {.name = "torsion",
     .unit = "N m",
     .bounds = io::positive,
     .sentence = "Torsion in its stalk at which a fruit comes off.",
     .label = "or a torsion of",
     .tip = "at which it comes off",
     .slider = {1.0e-5, 1.0e2, true},
     .member = &DetachLimits::torsion}};

struct PlantFruit {
  std::string name;
  CurvePlace place;
  double radius = 0.0;   ///< m
  double density = 0.0;  ///< kg/m3
  DetachLimits detach;
  Where where;
  bool operator==(const PlantFruit&) const = default;
};
/// kg/m3, of a fruit that is added without a density of its own: a ripe tomato's, which just
/// floats.
inline constexpr double usual_fruit_density = 950.0;
/// Beside its name, its place and its detach.
inline constexpr PlantKey<PlantFruit> fruit_keys[] = {{.name = "radius",
                                                       .unit = "m",
                                                       .bounds = io::positive,
                                                       .sentence = "Of the sphere.",
                                                       .label = "Radius",
                                                       .member = &PlantFruit::radius},
                                                      {.name = "density",
                                                       .unit = "kg/m3",
                                                       .bounds = io::positive,
                                                       .sentence = "Of the sphere.",
                                                       .label = "Density",
                                                       .usual = usual_fruit_density,
                                                       .member = &PlantFruit::density}};

struct PlantLeaf {
  std::string name;
  CurvePlace place;
  std::string leaf_template;      ///< name of a file <template>.leaf.yaml
  double size = 0.0;              ///< m, from the foot of the petiole to the tip
  Vec3 normal = Vec3::UnitZ();    ///< P, the way the blade's upper face looks
  std::optional<Vec3> direction;  ///< P, the way the midrib points (an optional key of ours);
                                  ///< absent: see leaf_frame()
  Where where;
  bool operator==(const PlantLeaf&) const = default;
};
/// Beside its name and its place.
inline constexpr PlantKey<PlantLeaf> leaf_keys[] = {
    {.name = "template",
     .sentence = "Name of a file NAME.leaf.yaml.",
     .member = &PlantLeaf::leaf_template},
    {.name = "size",
     .unit = "m",
     .bounds = io::positive,
     .sentence = "From the foot of the petiole to the tip.",
     .label = "Size",
     .member = &PlantLeaf::size},
    {.name = "normal",
     .sentence = "The way the blade's upper face looks.",
     .member = &PlantLeaf::normal},
    {.name = "direction",
     .sentence = "The way the midrib points.",
     .member = &PlantLeaf::direction}};

struct PlantMass {
  CurvePlace place;
  double mass = 0.0;  ///< kg
  bool operator==(const PlantMass&) const = default;
};
/// Beside its place.
inline constexpr PlantKey<PlantMass> mass_keys[] = {{.name = "mass",
                                                     .unit = "kg",
                                                     .bounds = io::positive,
                                                     .sentence = "Of the point.",
                                                     .member = &PlantMass::mass}};

/// A model extension by its name in plugins/effects: its numbers (scalars have one entry)
/// and its words, by parameter name.
struct Effect {
  std::string name;
  std::optional<CurvePlace> place;
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::string> words;
  Where where;
  bool operator==(const Effect&) const = default;

  double number(const std::string& parameter) const { return numbers.at(parameter).front(); }
};

/// A plant file: plain data that mirrors the manual's page Plant file. P is the plant's own frame.
struct PlantFile {
  std::string name;
  Shape shape = Shape::drawn;
  Look look = Look::tomato;  ///< an optional key of ours
  MaterialValues material;
  double connect = 0.0;      ///< m, a curve end nearer than this to another curve is joined to it
  double distance = 0.0;     ///< m, spacing of the nodes that are kept
  Vec3 root = Vec3::Zero();  ///< m, P: the curve end nearest to it is clamped
  std::vector<CurvePlace> supports;
  std::vector<PlantCurve> curves;
  std::vector<PlantFruit> fruits;
  std::vector<PlantLeaf> leaves;
  std::vector<PlantMass> masses;
  std::vector<Effect> effects;
  SearchPath leaf_folders;  ///< of NAME.leaf.yaml: beside its file, then what is shipped
  Where where;
  bool operator==(const PlantFile&) const = default;

  /// Index of a curve by name, -1 where there is none.
  int curve_index(const std::string& curve) const;
};
/// Beside its name, and before its material, its root and its lists.
inline constexpr PlantKey<PlantFile> plant_keys[] = {
    {.name = "shape",
     .sentence = "drawn: the curves are how the plant hangs; rest: they are its unloaded shape.",
     .member = one_of<&PlantFile::shape>(shape_words, true)},
    {.name = "look",
     .sentence = "What it is drawn as; it changes no motion.",
     .member = one_of<&PlantFile::look>(look_words)}};
/// The keys of its map `sampling`.
inline constexpr PlantKey<PlantFile> sampling_keys[] = {
    {.name = "connect",
     .unit = "m",
     .bounds = io::positive,
     .sentence = "How near the end of a curve must be to another one to be joined to it.",
     .slider = {0.0, 0.0, true},
     .member = &PlantFile::connect},
    {.name = "distance",
     .unit = "m",
     .bounds = io::positive,
     .sentence = "How far apart nodes lie: finer is more exact and slower.",
     .slider = {1.0e-3, 0.5, true},
     .member = &PlantFile::distance}};

}  // namespace pedicel::plant
