#include "app/session/commands/command_table.h"
#include "app/session/commands/scene_things.h"
#include "engine/core/check.h"
#include "engine/io/thing_bounds.h"

/// Moving, turning, copying, renaming and deleting what stands in a scene, as commands.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

Pose& pose_of(Document& document, ThingKind kind, const std::string& name) {
  const std::size_t index = index_of(document, kind, name);
  if (kind == ThingKind::plant) return document.plants[index].entry.pose;
  return document.edit_scene().bodies[index].pose;
}

template <ThingKind kind>
void move(Document& document, const Command& c) {
  pose_of(document, kind, c.word(word_of(kind))).position = c.point("to");
}

template <ThingKind kind>
void turn(Document& document, const Command& c) {
  pose_of(document, kind, c.word(word_of(kind))).rotation = read_turn(c.numbers("to"));
}

/// A copy of a thing under another name, at the end of its list.
template <class Items>
auto& copy_in(Items& items, std::size_t index, const std::string& name) {
  auto copy = items[index];
  copy.name = name;
  items.push_back(std::move(copy));
  return items.back();
}

template <ThingKind kind>
void copy(Document& document, const Command& c) {
  const std::string& to = c.word("as");
  const std::size_t index = index_of(document, kind, c.word(word_of(kind)));
  check_new_name(document, kind, to);
  if constexpr (kind == ThingKind::plant) {
    DocumentPlant one = document.plants[index];
    one.entry.name = to;
    one.entry.pose = read_pose(c, one.entry.pose);
    document.plants.push_back(std::move(one));
  } else {
    auto& one = copy_in(document.edit_scene().bodies, index, to);
    one.pose = read_pose(c, one.pose);
  }
}

void copy_camera(Document& document, const Command& c) {
  const std::size_t index = index_of(document, ThingKind::camera, c.word("camera"));
  check_new_name(document, ThingKind::camera, c.word("as"));
  copy_in(document.edit_scene().cameras, index, c.word("as"));
}

template <ThingKind kind>
void rename(Document& document, const Command& c) {
  const std::string name = c.word(word_of(kind)), &to = c.word("to");
  const std::size_t index = index_of(document, kind, name);
  check_new_name(document, kind, to);
  if constexpr (kind == ThingKind::plant) document.plants[index].entry.name = to;
  if constexpr (kind == ThingKind::body) document.edit_scene().bodies[index].name = to;
  if constexpr (kind == ThingKind::camera) document.edit_scene().cameras[index].name = to;
  rename_references(document, kind, name, to);
}

/// Refused while the scene speaks of it.
void check_free(const Document& document, const std::string& name) {
  const std::string by = references_to(document, name);
  if (!by.empty())
    throw UsageError("\"" + name + "\" is meant by " + by + ", expected \"clear references " +
                     name + "\" before");
}

template <ThingKind kind>
void remove(Document& document, const Command& c) {
  const std::string& name = c.word(word_of(kind));
  const auto index = static_cast<long>(index_of(document, kind, name));
  check_free(document, name);
  if constexpr (kind == ThingKind::plant) {
    document.plants.erase(document.plants.begin() + index);
    clear_references(document, name);  // its settings
  } else {
    auto& bodies = document.edit_scene().bodies;
    bodies.erase(bodies.begin() + index);
  }
}

void remove_camera(Document& document, const Command& c) {
  const std::string& name = c.word("camera");
  const auto index = static_cast<long>(index_of(document, ThingKind::camera, name));
  world::Scene& scene = document.edit_scene();
  scene.cameras.erase(scene.cameras.begin() + index);
  std::erase_if(scene.pictures, [&](const auto& picture) { return picture.camera == name; });
  if (scene.video.camera == name) scene.video.camera.clear();
}

void clear(Document& document, const Command& c) {
  if (references_to(document, c.word("name")).empty())
    throw UsageError("nothing of the scene speaks of \"" + c.word("name") + "\"");
  clear_references(document, c.word("name"));
}

std::vector<CommandDescription> commands_of(ThingKind kind, bool has_turn) {
  const std::string word = word_of(kind);
  const ArgumentDescription name{word, Kind::word, true, "name of the " + word + " in the scene"};
  const ArgumentDescription as{"as", Kind::word, true, "the copy's name"};
  const ArgumentDescription position{"position", Kind::point, false, "m, in the world (the same)",
                                     io::place_bounds};
  const bool plant = kind == ThingKind::plant;
  std::vector<CommandDescription> table;
  if (has_turn) {
    table.push_back({"move " + word,
                     {name, {"to", Kind::point, true, "m, in the world", io::place_bounds}},
                     "Puts a " + word + " elsewhere.",
                     plant ? move<ThingKind::plant> : move<ThingKind::body>});
    table.push_back(
        {"turn " + word,
         {name, {"to", Kind::numbers, true, "x,y,z,w, or roll,pitch,yaw in rad, in the world"}},
         "Turns a " + word + ".",
         plant ? turn<ThingKind::plant> : turn<ThingKind::body>});
    table.push_back({"copy " + word,
                     {name, as, position},
                     "Puts a copy of a " + word + " beside it.",
                     plant ? copy<ThingKind::plant> : copy<ThingKind::body>});
    table.push_back({"delete " + word,
                     {name},
                     "Takes a " + word + " out of the scene.",
                     plant ? remove<ThingKind::plant> : remove<ThingKind::body>});
  }
  const auto renaming = plant                     ? rename<ThingKind::plant>
                        : kind == ThingKind::body ? rename<ThingKind::body>
                                                  : rename<ThingKind::camera>;
  table.push_back({"rename " + word,
                   {name, {"to", Kind::word, true, "its new name"}},
                   "Gives a " + word + " another name, wherever the scene says it.",
                   renaming});
  return table;
}

}  // namespace

std::vector<CommandDescription> thing_commands() {
  const ArgumentDescription camera{"camera", Kind::word, true, "name of the camera"};
  std::vector<CommandDescription> table = {
      {"copy camera",
       {camera, {"as", Kind::word, true, "the copy's name"}},
       "Adds a camera like another one.",
       copy_camera},
      {"delete camera", {camera}, "Takes a camera away.", remove_camera},
      {"clear references",
       {{"name", Kind::word, true, "PLANT, PLANT/FRUIT, a body, or robot"}},
       "Takes away what the scene says of a thing: the robot's program that goes to it, loads, "
       "expectations, cameras that follow it.",
       clear},
  };
  for (const auto& part : {commands_of(ThingKind::plant, true), commands_of(ThingKind::body, true),
                           commands_of(ThingKind::camera, false)})
    table.insert(table.end(), part.begin(), part.end());
  return table;
}

}  // namespace pedicel::app
