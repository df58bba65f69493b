#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pedicel/core/diagnostics.h"
#include "pedicel/core/frames.h"

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
/// What bark, leaves and fruits look like. Says nothing about the mechanics.
enum class Look { tomato, apple };
enum class Interpolation { linear, smooth };
enum class SectionKind { circle, ellipse, rectangle };

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

/// Cross-section of a curve; `normal` is the direction of the smaller extent.
struct SectionShape {
  SectionKind kind = SectionKind::circle;
  double ratio = 1.0;          ///< 1, ellipse: minor over major axis
  double width = 0.0;          ///< m, rectangle
  double height = 0.0;         ///< m, rectangle
  Vec3 normal = Vec3::Zero();  ///< P; zero for a circle
  bool operator==(const SectionShape&) const = default;
};

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

struct PlantFruit {
  std::string name;
  CurvePlace place;
  double radius = 0.0;   ///< m
  double density = 0.0;  ///< kg/m3
  DetachLimits detach;
  Where where;
  bool operator==(const PlantFruit&) const = default;
};

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

struct PlantMass {
  CurvePlace place;
  double mass = 0.0;  ///< kg
  bool operator==(const PlantMass&) const = default;
};

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

}  // namespace pedicel::plant
