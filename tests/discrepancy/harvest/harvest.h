#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/discrepancy/scene_cases/scene_case.h"

/// The paper's own comparison with numbers: a real harvest, made by MuJoCo with something hidden in
/// it, beside what scenes foretell of it.
namespace pedicel::harvest {

using scene_case::Vec3;

struct Options {
  std::uint64_t seed = 1;
  int trials = 3;  ///< 2 or 3; the second one is held out
  std::vector<scene_case::Hidden> hidden;
};
/// Less friction than the scene says, a log of the arm that comes late, and a stalk that breaks
/// sooner.
std::vector<scene_case::Hidden> hidden_by_default();

/// The harvest with its truss; sizes are drawn from the seed.
scene_case::Setting setting_of(const Options& options);

/// What one scene, or the real plant, did in a trial.
struct Course {
  std::optional<double> came_off;              ///< s
  std::vector<Vec3> shape;                     ///< m, W: points just before
  double peak_force = 0.0, peak_moment = 0.0;  ///< N and N m, of the wrist
  std::vector<double> force;                   ///< N, its size, at Trial::time
  double rms_apart = 0.0, most_apart = 0.0;    ///< m, of the shape from the real one
  double misfit = 1.0;                         ///< noise units, RMS; 1 is noise alone
  bool healthy = true;
};

struct Trial {
  std::string name;
  bool check = false;
  double taken = 0.0;        ///< s, when the finger took the fruit
  std::vector<double> time;  ///< s, of the wrist's samples
  std::size_t stem = 0;      ///< points of the shapes on the stem; the others are on the truss
  Course real, nominal;
  std::optional<Course> extended;  ///< by the diagnosis' scene, where there is one
  Course hidden;                   ///< the nominal scene with what is hidden
  /// 1, share of the misfit above the noise that a scene removes from the nominal one's; nothing
  /// where there is hardly any.
  std::optional<double> gain(const Course& course) const;
};

struct Comparison {
  scene_case::Setting setting;
  std::vector<Trial> trials;
  const Trial& held_out() const;
};

/// What `pedicel diagnose` says of the experiment in a folder, and the scene that it writes.
struct Diagnosed {
  std::string verdict, findings;   ///< texts of verdict.json and findings.txt
  std::filesystem::path extended;  ///< the scene's file; empty: the files' own is as good
  bool is_believed = false;        ///< false: `unknown`; the scene is what came nearest
};
/// Writes into `out`. Throws InvalidFile.
Diagnosed diagnose(const std::filesystem::path& folder, const std::filesystem::path& out,
                   int threads);

/// `folder`: the experiment as make_case() wrote it; `extended`: extended.scene.yaml of its
/// diagnosis, or empty; `runs`: what really happened. Throws InvalidFile and SceneFailed.
Comparison compare(const std::filesystem::path& folder, const std::filesystem::path& extended,
                   const scene_case::Setting& setting, const std::vector<scene_case::Run>& runs,
                   int threads);

/// Of one hidden number, what a verdict says of it.
struct Said {
  std::string name, parameter;
  double truth = 0.0;
  bool named = false;                         ///< its cause is among those named
  double value = 0.0;                         ///< where it is named
  std::optional<double> low = {}, high = {};  ///< 95 %; open ends are left out
};
/// `verdict`: the text of verdict.json.
std::vector<Said> said_of(const scene_case::Setting& setting, const std::string& verdict);

/// Tables in Markdown. `extended`: how the diagnosis' scene is called.
std::string tables(const Comparison& comparison, const std::string& extended);
std::string tables(const std::vector<Said>& said, const std::string& verdict);

/// The force at the wrist of a trial over time, and two views of the plant just before the fruit
/// comes off, as SVG.
std::string force_picture(const Trial& trial);
std::string shape_picture(const Trial& trial, bool from_side);

}  // namespace pedicel::harvest
