#include "app/session/commands/measured_commands.h"

#include <array>

#include "app/session/commands/command_table.h"
#include "app/session/document/document.h"
#include "app/session/measured/measured_data.h"
#include "app/session/measured/measured_scene.h"
#include "app/session/session.h"
#include "app/session/session_measured.h"
#include "engine/core/check.h"
#include "engine/io/yaml.h"
#include "plugins/effects/registry/effect_definition.h"
#include "plugins/plant/effect_reader.h"

/// Commands about measured data, and the effects that a diagnosis brings into the document.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

void set_effects(Document& document, const Command& c) {
  Diagnostics diagnostics;
  auto effects = parse_effects(c.word("text"), diagnostics);
  if (!effects) throw UsageError(sentences(diagnostics.all()));
  const plant::PlantFile& before = document.plant(c.word("plant"));
  for (const plant::Effect& effect : *effects)
    if (effect.place && before.curve_index(effect.place->curve) < 0)
      throw UsageError(effect.name + " is at a place on \"" + effect.place->curve +
                       "\", expected a stem of the plant");
  document.edit_plant(c.word("plant")).effects = std::move(*effects);
}

void set_scene_effects(Document& document, const Command& c) {
  Diagnostics diagnostics;
  std::vector<io::YamlPiece> effects = parse_scene_effects(c.word("text"), diagnostics);
  if (diagnostics.has_errors()) throw UsageError(sentences(diagnostics.all()));
  document.edit_scene().effects = std::move(effects);
}

Result cancel_diagnosis(Session& session, const Command&) {
  session.measured().data().cancel_diagnosis();
  session.measured().scene().cancel_diagnosis();
  return {};
}

}  // namespace

bool is_experiment(const std::filesystem::path& path) {
  return path.filename() == "experiment.yaml" || std::filesystem::exists(path / "experiment.yaml");
}

std::string effects_text(const std::vector<plant::Effect>& effects) {
  std::string text = "[";
  for (const plant::Effect& effect : effects)
    text += (text.size() > 1 ? ", " : "") + plant::effect_text(effect);
  return text + "]";
}

std::string scene_effects_text(const std::vector<io::YamlPiece>& pieces,
                               const std::vector<plant::Effect>& more) {
  std::string text = "[";
  const auto add = [&](const std::string& one) { text += (text.size() > 1 ? ", " : "") + one; };
  for (const io::YamlPiece& piece : pieces) add(io::piece_text(piece));
  for (const plant::Effect& effect : more) add(plant::effect_text(effect));
  return text + "]";
}

std::vector<io::YamlPiece> parse_scene_effects(const std::string& text, Diagnostics& diagnostics) {
  std::vector<io::YamlPiece> pieces;
  try {
    const io::YamlNode all = io::parse_yaml(text, "effects", diagnostics);
    for (const io::YamlNode& node : all.list("effects")) pieces.push_back(io::piece_of(node));
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
  }
  return pieces;
}

std::optional<std::vector<plant::Effect>> parse_effects(const std::string& text,
                                                        Diagnostics& diagnostics) {
  std::vector<plant::Effect> effects;
  try {
    for (const io::YamlNode& node : io::parse_yaml(text, "effects", diagnostics).list("effects"))
      effects.push_back(plant::read_effect(node, effects::EffectFile::plant));
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
  }
  if (diagnostics.has_errors()) return std::nullopt;
  return effects;
}

std::vector<CommandDescription> measured_commands() {
  return {
      {"set effects",
       {{"plant", Kind::word, true, "name of the plant in the scene"},
        {"text", Kind::text, true,
         "as in a plant file: [{name: base_compliance, stiffness: 0.8}]"}},
       "Gives a plant these model extensions in place of the ones it has.",
       set_effects},
      {"set scene effects",
       {{"text", Kind::text, true, "as in a scene file: [{name: NAME, ...}]"}},
       "Gives the scene these effects of contact, arm, sensors and plants in place of its own.",
       set_scene_effects},
      {"open experiment",
       {{"folder", Kind::text, true, "path of the experiment"}},
       "Opens data measured at a plant or with a robot in a scene, and simulates them as the files "
       "say.",
       [](Session& session, const Command& c) {
         return session.measured().open(c.word("folder"));
       }},
      {"cancel reading",
       {},
       "Drops the experiment that is being read.",
       [](Session& session, const Command&) { session.measured().cancel_reading(); }},
      {"close experiment",
       {},
       "Leaves the measured data.",
       [](Session& session, const Command&) { session.measured().close(); }},
      {"diagnose",
       {{"threads", Kind::whole, false, "that work on it (all cores but one)"},
        {"seed", Kind::whole, false, "of the bootstrap (1)"}},
       "Begins to find out what the simulation of the measured data gets wrong.",
       [](Session& session, const Command& c) {
         return session.measured().diagnose(c.whole_or("threads", 0),
                                            static_cast<std::uint64_t>(c.whole_or("seed", 1)));
       }},
      {"cancel diagnosis", {}, "Ends a diagnosis without a result.", cancel_diagnosis},
      {"accept diagnosis",
       {},
       "Gives the plant or the scene the effects that the diagnosis found; undo takes them away.",
       [](Session& session, const Command&) { return session.measured().accept_diagnosis(); }},
      {"write report",
       {{"folder", Kind::text, true, "path"}},
       "Writes the diagnosis as report.html, verdict.json and extended.plant.yaml or "
       "extended.scene.yaml.",
       [](Session& session, const Command& c) {
         return session.measured().write_report(c.word("folder"));
       }},
  };
}

}  // namespace pedicel::app
