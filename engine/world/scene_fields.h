#pragma once

#include <filesystem>
#include <string>

#include "engine/world/scene.h"

/// The parts of the scene writer, one a section of the file (scene_writer.cpp calls them): each is
/// a map in one line, {key: value, ...}.
namespace pedicel::world::fields {

/// A map in one line that grows.
class FlowMap {
 public:
  FlowMap& add(const std::string& key, const std::string& value);
  FlowMap& add(const std::string& key, double value);
  FlowMap& add(const std::string& key, const Vec3& value);
  /// Only where it is not what is taken without the key.
  FlowMap& add_unless(const std::string& key, double value, double otherwise);
  FlowMap& add_unless(const std::string& key, const Vec3& value, const Vec3& otherwise);
  FlowMap& add_pose(const Pose& pose);
  bool empty() const { return text_.empty(); }
  std::string text() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

std::string number_list(const std::vector<double>& values);
std::string vector(const Vec3& v);
/// Numbers, words and paths as people write them, without quotes where they need none.
std::string plain(const std::string& text);
std::string path_from(const std::filesystem::path& folder, const std::filesystem::path& file);
/// Of settings that come twice the last one counts; sorted by their keys.
FlowMap settings(const std::vector<Setting>& settings);
std::string anchor(const Anchor& anchor);

std::string plant(const ScenePlant& plant, const std::filesystem::path& folder);
std::string body(const BodyDescription& body);
std::string waypoint(const SceneWaypoint& waypoint);
std::string load(const SceneLoad& load);
std::string tie(const SceneTie& tie);
std::string wind(const SceneWind& wind);
std::string cut(const SceneCut& cut);
std::string camera(const SceneCamera& camera);
std::string instrument(const SceneInstrument& one);
/// A line "look: {...}"; empty where everything looks as it does by itself.
std::string look(const SceneLook& look);
std::string varied(const VariedNumber& number);
std::string picture(const ScenePicture& picture);
std::string expectation(const Expectation& expectation);

}  // namespace pedicel::world::fields
