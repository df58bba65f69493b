#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/parameter.h"
#include "engine/io/yaml.h"
#include "engine/world/scene.h"

namespace pedicel::world {

/// A setting that is a word ("solver: direct"). `value` receives the index of the word.
struct WordSetting {
  std::string name;
  std::vector<std::string> words;
  int* value = nullptr;
};

/// Applies a settings section to the parameters that its owner describes. Every unknown key and
/// every refused value goes to `diagnostics` with its place; `section` names it ("rods").
void apply_settings(const std::vector<Setting>& settings, const std::string& section,
                    const std::vector<Parameter>& parameters, const std::vector<WordSetting>& words,
                    Diagnostics& diagnostics);

/// The number that a text is, as it is written in our files; nothing where it is none.
std::optional<double> to_number(const std::string& text);

/// Width and height of a text as "1280x720", px. Throws UsageError, where `asked` names it.
std::array<int, 2> to_picture_size(const std::string& text, const std::string& asked);

/// Hz, that a video may have, wherever that is said.
inline constexpr io::Bounds video_rates{1.0, 240.0};

/// m/s2, that a component of gravity may have, wherever that is said.
inline constexpr double most_gravity = 100.0;

/// A number of the scene itself, wherever it comes from (its file, `--set`, an option): its one
/// description.
struct SceneNumber {
  std::string_view key, unit;
  double minimum, maximum;
  std::string_view sentence;
  std::variant<double Scene::*, int Scene::*> member;

  bool whole() const { return member.index() == 1; }
};
std::span<const SceneNumber> scene_numbers();

/// Its bounds. Asserts that there is such a key.
io::Bounds scene_bounds(std::string_view key);

/// Changes a scene as `--set key=value` does: dt, duration, gravity (x,y,z), seed, threads,
/// log_rate, rods.KEY, coupling.KEY, robot.gripper_force, plants.NAME.KEY (one plant), those of
/// place_settings.h, and any other KEY that is an override of every plant (detach.stretch). Of
/// equal keys the last one counts, and what is set varies no more. `asked` comes before the key in
/// the place that a fault names ("--set "). Throws UsageError where the key or the value is
/// impossible.
void apply_override(Scene& scene, const std::string& key, const std::string& value,
                    const std::string& asked = "");

/// With the numbers of its `vary` in place, drawn from its seed, and nothing more that varies.
/// Throws InvalidFile where one is impossible.
Scene drawn_scene(const Scene& scene);

/// Splits "key=value". Throws UsageError where there is no "=" or no key.
std::pair<std::string, std::string> split_assignment(const std::string& text);

}  // namespace pedicel::world
