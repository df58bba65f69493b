#include "engine/world/scene_fields.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <string_view>

#include "engine/core/check.h"
#include "engine/core/joined.h"
#include "engine/io/yaml_words.h"
#include "engine/world/scene_writer.h"
#include "engine/world/settings.h"

namespace pedicel::world::fields {

namespace {

FlowMap shape(const BodyPart& part) {
  FlowMap map;
  map.add("radius", part.radius);
  if (part.kind != BodyPart::Kind::sphere) map.add("length", part.length);
  return map;
}

void add_shape(FlowMap& map, const BodyDescription& body) {
  Vec3 size;
  double wall = 0.0;
  if (is_tray(body, size, wall)) {
    map.add("tray", FlowMap().add("size", size).add("wall", wall).text());
    return;
  }
  const bool plain_part = body.parts.size() == 1 && body.parts[0].pose.position.isZero() &&
                          body.parts[0].pose.rotation.isApprox(Quat::Identity());
  if (!plain_part)
    throw UsageError("body \"" + body.name +
                     "\" is made of several parts, expected a box, sphere, cylinder, capsule or "
                     "tray");
  const BodyPart& part = body.parts[0];
  if (part.kind == BodyPart::Kind::box) map.add("box", Vec3(2.0 * part.half_extents));
  if (part.kind == BodyPart::Kind::sphere) map.add("sphere", shape(part).text());
  if (part.kind == BodyPart::Kind::cylinder) map.add("cylinder", shape(part).text());
  if (part.kind == BodyPart::Kind::capsule) map.add("capsule", shape(part).text());
}

void add_source(FlowMap& map, const ScenePlant& plant, const std::filesystem::path& folder) {
  if (plant.source == ScenePlant::Source::built_in)
    map.add("built_in", io::yaml_word(plant.built_in));
  else if (!plant.file.empty())
    map.add(plant.source == ScenePlant::Source::mtg ? "mtg" : "file",
            path_from(folder, plant.file));
  if (plant.unit > 0.0) map.add("unit", plant.unit);
  if (plant.optional) map.add("optional", "true");
  if (!plant.fallback.empty()) map.add("fallback", path_from(folder, plant.fallback));
}

}  // namespace

FlowMap& FlowMap::add(const std::string& key, const std::string& value) {
  text_ += (text_.empty() ? "" : ", ") + key + ": " + value;
  return *this;
}
FlowMap& FlowMap::add(const std::string& key, double value) {
  return add(key, io::yaml_number(value));
}
FlowMap& FlowMap::add(const std::string& key, const Vec3& value) {
  return add(key, vector(value));
}
FlowMap& FlowMap::add_unless(const std::string& key, double value, double otherwise) {
  return value == otherwise ? *this : add(key, value);
}
FlowMap& FlowMap::add_unless(const std::string& key, const Vec3& value, const Vec3& otherwise) {
  return value == otherwise ? *this : add(key, value);
}
FlowMap& FlowMap::add_pose(const Pose& pose) {
  add_unless("position", pose.position, Vec3::Zero());
  if (pose.rotation.coeffs() == Quat::Identity().coeffs()) return *this;
  const Quat& q = pose.rotation;
  return add("orientation", number_list({q.x(), q.y(), q.z(), q.w()}));
}

std::string number_list(const std::vector<double>& values) {
  const std::string text = joined(values, io::yaml_number);
  return "[" + text + "]";
}

std::string vector(const Vec3& v) {
  return number_list({v.x(), v.y(), v.z()});
}

std::string plain(const std::string& text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("_-./+").find(c) != std::string_view::npos;
  };
  const bool begins_well = !text.empty() && (std::isalnum(static_cast<unsigned char>(text[0])) ||
                                             text[0] == '.' || text[0] == '/' || to_number(text));
  return begins_well && std::ranges::all_of(text, is_plain) ? text : io::yaml_word(text);
}

std::string path_from(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code none;
  const auto whole = std::filesystem::absolute(file).lexically_normal();
  const auto seen = folder.empty() ? whole : std::filesystem::relative(file, folder, none);
  return plain((none || seen.empty() ? whole : seen).generic_string());
}

FlowMap settings(const std::vector<Setting>& settings) {
  std::map<std::string, std::string> values;
  for (const Setting& one : settings) values[one.key] = one.text;
  FlowMap map;
  for (const auto& [key, value] : values) map.add(key, plain(value));
  return map;
}

std::string anchor(const Anchor& anchor) {
  switch (anchor.kind) {
    case Anchor::Kind::none:
      return "";
    case Anchor::Kind::tool:
      return "{tool: true}";
    case Anchor::Kind::fruit:
      return FlowMap().add("fruit", plain(anchor.name)).text();
    case Anchor::Kind::body:
      return FlowMap().add("body", plain(anchor.name)).text();
    case Anchor::Kind::plant:
      return FlowMap().add("plant", plain(anchor.name)).text();
  }
  return "";
}

std::string plant(const ScenePlant& plant, const std::filesystem::path& folder) {
  FlowMap map;
  map.add("name", io::yaml_word(plant.name));
  add_source(map, plant, folder);
  map.add_pose(plant.pose);
  if (plant.repeat != std::array<int, 2>{1, 1} || !plant.vary.empty()) {
    FlowMap repeat, vary;
    repeat.add("count", number_list({double(plant.repeat[0]), double(plant.repeat[1])}))
        .add("spacing", number_list({plant.spacing.x(), plant.spacing.y()}));
    for (const VariedNumber& one : plant.vary) vary.add(one.key, varied(one));
    if (!plant.vary.empty()) repeat.add("vary", vary.text());
    map.add("repeat", repeat.text());
  }
  const FlowMap set = settings(plant.set);
  if (!set.empty()) map.add("set", set.text());
  return map.text();
}

std::string body(const BodyDescription& body) {
  const BodyDescription plain_body;
  FlowMap map;
  map.add("name", io::yaml_word(body.name));
  add_shape(map, body);
  map.add_unless("mass", body.mass, 0.0).add_pose(body.pose);
  map.add_unless("friction", body.friction, plain_body.friction);
  map.add_unless("restitution", body.restitution, plain_body.restitution);
  if (body.look != plain_body.look) map.add("look", body.look);
  return map.text();
}

std::string waypoint(const SceneWaypoint& waypoint) {
  FlowMap map;
  map.add("time", waypoint.time);
  const bool anchored = waypoint.at.kind != Anchor::Kind::none;
  if (anchored) map.add("at", anchor(waypoint.at));
  map.add(anchored ? "offset" : "position", waypoint.position);
  if (waypoint.orientation) {
    const Quat& q = *waypoint.orientation;
    map.add("orientation", number_list({q.x(), q.y(), q.z(), q.w()}));
  }
  if (waypoint.gripper) map.add("gripper", *waypoint.gripper);
  return map.text();
}

std::string load(const SceneLoad& load) {
  FlowMap map;
  map.add("fruit", plain(load.target)).add("force", load.force);
  map.add_unless("from", load.from, 0.0).add("to", load.to);
  if (load.ramp) map.add("ramp", "true");
  return map.text();
}

namespace {

/// Those numbers that are not as they are without the key.
template <class Described>
void add_described(FlowMap& map, const char* key, Described now, Described otherwise) {
  FlowMap inner;
  const std::vector<Parameter> plain_numbers = otherwise.parameters();
  for (const Parameter& one : now.parameters())
    inner.add_unless(one.name, one.get(), find_parameter(plain_numbers, one.name)->get());
  if (!inner.empty()) map.add(key, inner.text());
}

/// With an upper edge that is not level a camera is written by the turn of its frame.
void add_view(FlowMap& map, const SceneCamera& camera) {
  if (camera.up == Vec3(Vec3::UnitZ())) {
    map.add("eye", camera.eye).add_unless("target", camera.target, Vec3::Zero());
    return;
  }
  const Vec3 forward = (camera.target - camera.eye).normalized();
  const Vec3 right = forward.cross(camera.up).normalized();
  Mat3 axes;
  axes << right, forward.cross(right), forward;
  const Quat q(axes);
  map.add("position", camera.eye);
  map.add("orientation", number_list({q.x(), q.y(), q.z(), q.w()}));
}

}  // namespace
std::string tie(const SceneTie& tie) {
  FlowMap map;
  map.add("organ", plain(tie.organ)).add_unless("at", tie.at, SceneTie{}.at);
  if (tie.to_organ.empty())
    map.add(tie.is_offset ? "offset" : "to", tie.to);
  else
    map.add("to_organ", plain(tie.to_organ));
  if (tie.to_at) map.add("to_at", *tie.to_at);
  if (tie.length) map.add("length", *tie.length);
  map.add_unless("stiffness", tie.stiffness, SceneTie{}.stiffness);
  return map.text();
}

std::string wind(const SceneWind& wind) {
  const SceneWind plain;
  FlowMap map;
  map.add("velocity", wind.velocity).add_unless("height", wind.height, plain.height);
  map.add_unless("roughness", wind.roughness, plain.roughness);
  map.add_unless("intensity", wind.intensity, plain.intensity);
  map.add_unless("length", wind.length, plain.length).add_unless("rise", wind.rise, plain.rise);
  if (wind.shelter != plain.shelter) map.add("shelter", wind.shelter ? "true" : "false");
  return map.text();
}

std::string cut(const SceneCut& cut) {
  FlowMap map;
  map.add("organ", plain(cut.organ)).add_unless("at", cut.at, SceneCut{}.at);
  if (cut.time)
    map.add("time", *cut.time);
  else
    map.add("by_tool", "true");
  map.add_unless("reach", cut.reach, SceneCut{}.reach);
  return map.text();
}

std::string camera(const SceneCamera& camera) {
  const SceneCamera plain_camera;
  FlowMap map;
  map.add("name", io::yaml_word(camera.name));
  add_view(map, camera);
  map.add_unless("fov", camera.field_of_view, plain_camera.field_of_view);
  if (camera.follow.kind != Anchor::Kind::none) map.add("follow", anchor(camera.follow));
  if (camera.size != plain_camera.size)
    map.add("size", number_list({double(camera.size[0]), double(camera.size[1])}));
  const std::string sensors =
      joined(camera.sensors, [&](const Sensor sensor) { return name_of(sensor); });
  if (!sensors.empty()) map.add("sensors", "[" + sensors + "]");
  map.add_unless("rate", camera.rate, plain_camera.rate);
  add_described(map, "noise", camera.noise, {});
  return map.text();
}

std::string instrument(const SceneInstrument& one) {
  const SceneInstrument usual(one.kind());
  FlowMap map;
  map.add("name", io::yaml_word(one.name));
  if (!one.link.empty()) map.add("link", io::yaml_word(one.link));
  if (!one.organ.empty()) map.add("organ", plain(one.organ));
  map.add_unless("at", one.at, usual.at).add_pose(one.pose);
  if (one.touch) map.add("touch", "true");
  if (one.tared) map.add("tared", "true");
  map.add_unless("rate", one.rate, usual.rate);
  add_described(map, "noise", one.noise, usual.noise);
  return map.text();
}

std::string look(const SceneLook& look) {
  FlowMap map;
  add_described(map, "look", look, {});
  return map.empty() ? std::string() : map.text().substr(1, map.text().size() - 2) + "\n";
}

std::string varied(const VariedNumber& number) {
  using Distribution = VariedNumber::Distribution;
  const char* words[] = {"uniform", "normal", "lognormal", "choice"};
  FlowMap map;
  map.add("distribution", words[static_cast<int>(number.distribution)]);
  if (number.distribution == Distribution::normal || number.distribution == Distribution::lognormal)
    map.add("mean", number.mean).add("deviation", number.deviation);
  if (number.distribution != Distribution::choice) {
    if (std::isfinite(number.low)) map.add("low", number.low);
    if (std::isfinite(number.high)) map.add("high", number.high);
    return map.text();
  }
  const std::string values = joined(number.values, plain);
  return map.add("values", "[" + values + "]").text();
}

std::string picture(const ScenePicture& picture) {
  FlowMap map;
  switch (picture.when) {
    case ScenePicture::When::time:
      map.add("at", picture.time);
      break;
    case ScenePicture::When::before_detachment:
      map.add("at", "before_detachment");
      break;
    case ScenePicture::When::after_detachment:
      map.add("at", "after_detachment");
      break;
    case ScenePicture::When::end:
      map.add("at", "end");
  }
  if (!picture.camera.empty()) map.add("camera", io::yaml_word(picture.camera));
  if (picture.strain) map.add("strain", "true");
  return map.text();
}

std::string expectation(const Expectation& e) {
  FlowMap map;
  map.add("quantity", io::yaml_word(e.quantity));
  const std::pair<const char*, const std::string*> subjects[] = {
      {"fruit", &e.fruit}, {"body", &e.body}, {"plant", &e.plant}, {"link", &e.link}};
  for (const auto& [key, name] : subjects)
    if (!name->empty()) map.add(key, plain(*name));
  switch (e.test) {
    case Expectation::Test::is:
      map.add("is", e.low);
      break;
    case Expectation::Test::between:
      map.add("between", number_list({e.low, e.high}));
      break;
    case Expectation::Test::above:
      map.add("above", e.low);
      break;
    case Expectation::Test::below:
      map.add("below", e.low);
      break;
    case Expectation::Test::rises_with_sweep:
      map.add("with_sweep", "rises");
      break;
    case Expectation::Test::falls_with_sweep:
      map.add("with_sweep", "falls");
      break;
    case Expectation::Test::steady_over_sweep:
      map.add("with_sweep", "steady").add("within", e.low);
  }
  return map.text();
}

}  // namespace pedicel::world::fields
