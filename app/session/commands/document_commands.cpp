#include <algorithm>

#include "app/session/commands/command_table.h"
#include "app/session/commands/scene_things.h"
#include "app/session/document/document.h"
#include "app/session/document/settings_check.h"
#include "engine/core/check.h"
#include "engine/io/thing_bounds.h"
#include "plugins/coupling/coupling_settings.h"
#include "plugins/simulation/plants/plant_overrides.h"
#include "plugins/simulation/plants/rod_options.h"

/// Plants as a whole and settings as commands.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

const ArgumentDescription plant_name{"plant", Kind::word, true, "name of the plant in the scene"};

void add(Document& document, const std::string& name, plant::PlantFile file, const Command& c) {
  DocumentPlant one;
  one.entry.name = name;
  one.entry.pose = read_pose(c);
  if (c.has("file")) one.entry.file = c.word("file");
  one.file = std::make_shared<const plant::PlantFile>(std::move(file));
  document.plants.push_back(std::move(one));
}

/// A herb's green stem: the order of magnitude of turgid stems (Niklas, Plant Biomechanics, 1992,
/// table 2.1); what a drawing says later replaces it.
void new_plant(Document& document, const Command& c) {
  check_new_name(document, ThingKind::plant, c.word("plant"));
  plant::PlantFile file;
  file.name = c.word("plant");
  file.material = {2.0e8, 0.35, 800.0, 0.02};
  file.connect = 0.01;
  file.distance = 0.02;
  add(document, c.word("plant"), std::move(file), c);
}

void add_plant(Document& document, const Command& c) {
  check_new_name(document, ThingKind::plant, c.word("plant"));
  Diagnostics diagnostics;
  auto file = plant::parse_plant(c.word("text"), c.word("plant"), diagnostics);
  if (!file) throw UsageError(sentences(diagnostics.all()));
  add(document, c.word("plant"), std::move(*file), c);
}

/// For texts that were edited by hand, and journals.
void set_plant(Document& document, const Command& c) {
  const int index = document.plant_index(c.word("plant"));
  if (index < 0) return add_plant(document, c);
  document.plant(c.word("plant"));  // it must be one that can be edited
  Diagnostics diagnostics;
  auto file = plant::parse_plant(c.word("text"), c.word("plant"), diagnostics);
  if (!file) throw UsageError(sentences(diagnostics.all()));
  DocumentPlant& one = document.plants[index];
  one.file = std::make_shared<const plant::PlantFile>(std::move(*file));
  one.entry.pose = read_pose(c, one.entry.pose);
}

void set(Document& document, const Command& c) {
  const std::string &key = c.word("key"), &value = c.word("value");
  const auto held = std::find_if(document.settings.begin(), document.settings.end(),
                                 [&](const auto& one) { return one.first == key; });
  if (held == document.settings.end())
    document.settings.emplace_back(key, value);
  else
    held->second = value;
  check_settings(document);
}

void unset(Document& document, const Command& c) {
  if (std::erase_if(document.settings,
                    [&](const auto& one) { return one.first == c.word("key"); }) == 0)
    throw UsageError("\"" + c.word("key") + "\" is as the files say already");
}

}  // namespace

std::vector<CommandDescription> document_commands() {
  const ArgumentDescription position{"position", Kind::point, false, "m, in the world (the origin)",
                                     io::place_bounds};
  const ArgumentDescription turn{"turn", Kind::numbers, false,
                                 "x,y,z,w, or roll,pitch,yaw in rad (none)"};
  const ArgumentDescription file{"file", Kind::text, false,
                                 "plant file that it came from and is saved to (none)"};
  return {
      {"new plant",
       {plant_name, position, turn},
       "Adds a plant without stems, to draw.",
       new_plant},
      {"add plant",
       {plant_name,
        {"text", Kind::text, true, "of a plant file, lines ended by \\n"},
        position,
        turn,
        file},
       "Adds a plant as a plant file says it.",
       add_plant},
      {"set plant",
       {plant_name,
        {"text", Kind::text, true, "of a plant file, lines ended by \\n"},
        position,
        turn,
        file},
       "Makes a plant what a plant file says; adds it where it is new.",
       set_plant},
      {"set",
       {{"key", Kind::word, true, "rods.KEY, coupling.KEY, plants.NAME.KEY, dt, ..."},
        {"value", Kind::text, true, "of the key"}},
       "Sets a described number or word of the scene, as --set does.",
       set},
      {"unset",
       {{"key", Kind::word, true, "that was set"}},
       "Sets a number back to what the files say.",
       unset},
  };
}

}  // namespace pedicel::app
