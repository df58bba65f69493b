#include "app/session/session_tuning.h"

#include "app/session/document/plant_parameters.h"
#include "app/session/session.h"
#include "app/session/session_files.h"
#include "engine/core/check.h"
#include "plugins/simulation/plants/plant_overrides.h"

namespace pedicel::app {

namespace {

using Texts = SessionFiles::Settings;

/// Null where it is not set.
const std::string* text_of(const Texts& settings, const std::string& key) {
  for (const auto& [held, text] : settings)
    if (held == key) return &text;
  return nullptr;
}

bool differs(const Texts& a, const Texts& b, const std::string& key) {
  const std::string *in_a = text_of(a, key), *in_b = text_of(b, key);
  return in_a && in_b ? *in_a != *in_b : in_a != in_b;
}

}  // namespace

std::vector<SessionParameter> SessionTuning::parameters() const {
  const Document& document = core_.editor.document();
  const Texts& saved = session_.files().saved_settings();
  Document plain = document;
  plain.settings = saved;
  std::vector<SessionParameter> all = document_parameters(document, plain);
  for (SessionParameter& one : all) one.changed = differs(document.settings, saved, one.key);
  return all;
}

Result SessionTuning::reset(const std::string& key) {
  const std::string* saved = text_of(session_.files().saved_settings(), key);
  return session_.run(saved ? Command("set", {{"key", key}, {"value", *saved}})
                            : Command("unset", {{"key", key}}));
}

// Overrides of one plant, or of all, become the plant's own numbers; what belongs to the solver
// stays a setting.
Result SessionTuning::keep() {
  DocumentEditor& editor = core_.editor;
  editor.begin_gesture();
  const world::Scene scene = scene_of(editor.document());
  int kept = 0;
  for (std::size_t p = 0; p < editor.document().plants.size(); ++p) {
    const DocumentPlant one = editor.document().plants[p];
    if (!one.file || scene.plants[p].set.size() == one.entry.set.size()) continue;
    plant::PlantFile changed = *one.file;
    Diagnostics diagnostics;
    simulation::apply_plant_overrides(changed, scene.plants[p].set, diagnostics);
    if (diagnostics.has_errors()) {
      editor.cancel_gesture();
      return {false, sentences(diagnostics.all())};
    }
    editor.change(
        Command("set plant", {{"plant", one.entry.name}, {"text", plant::plant_text(changed)}}));
    ++kept;
  }
  const auto settings = editor.document().settings;
  for (const auto& [key, text] : settings)
    if (is_plant_key(key)) editor.change(Command("unset", {{"key", key}}));
  editor.end_gesture();
  return {true, std::to_string(kept) + (kept == 1 ? " plant changed" : " plants changed")};
}

Result SessionTuning::discard() {
  DocumentEditor& editor = core_.editor;
  const Texts& saved = session_.files().saved_settings();
  editor.begin_gesture();
  const Texts settings = editor.document().settings;
  for (const auto& [key, text] : settings)
    if (!text_of(saved, key)) editor.change(Command("unset", {{"key", key}}));
  for (const auto& [key, text] : saved)
    if (differs(editor.document().settings, saved, key))
      editor.change(Command("set", {{"key", key}, {"value", text}}));
  editor.end_gesture();
  return {};
}

}  // namespace pedicel::app
