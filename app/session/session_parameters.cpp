#include "pedicel/app/run/plant_overrides.h"
#include "pedicel/app/session/document/document_parameters.h"
#include "pedicel/app/session/document/plant_parameters.h"
#include "pedicel/app/session/session.h"
#include "pedicel/core/check.h"

/// Described numbers that may be changed while the plant moves.
namespace pedicel::app {

namespace {

using Texts = std::vector<std::pair<std::string, std::string>>;

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

std::vector<SessionParameter> Session::parameters() const {
  Document plain = document_;
  plain.settings = saved_settings_;
  std::vector<SessionParameter> all = document_parameters(document_, plain);
  for (SessionParameter& one : all)
    one.changed = differs(document_.settings, saved_settings_, one.key);
  return all;
}

Result Session::reset_parameter(const std::string& key) {
  const std::string* saved = text_of(saved_settings_, key);
  return run(saved ? Command("set", {{"key", key}, {"value", *saved}})
                   : Command("unset", {{"key", key}}));
}

// Overrides of one plant, or of all, become the plant's own numbers; what belongs to the solver
// stays a setting.
Result Session::keep_parameters() {
  begin_gesture();
  const world::Scene scene = scene_of(document_);
  int kept = 0;
  for (std::size_t p = 0; p < document_.plants.size(); ++p) {
    const DocumentPlant one = document_.plants[p];
    if (!one.file || scene.plants[p].set.size() == one.entry.set.size()) continue;
    plant::PlantFile changed = *one.file;
    Diagnostics diagnostics;
    apply_plant_overrides(changed, scene.plants[p].set, diagnostics);
    if (diagnostics.has_errors()) {
      cancel_gesture();
      return {false, sentences(diagnostics.all())};
    }
    change_document(
        Command("set plant", {{"plant", one.entry.name}, {"text", plant::plant_text(changed)}}));
    ++kept;
  }
  const auto settings = document_.settings;
  for (const auto& [key, text] : settings)
    if (is_plant_key(key)) change_document(Command("unset", {{"key", key}}));
  end_gesture();
  return {true, std::to_string(kept) + (kept == 1 ? " plant changed" : " plants changed")};
}

Result Session::discard_parameters() {
  begin_gesture();
  const Texts settings = document_.settings;
  for (const auto& [key, text] : settings)
    if (!text_of(saved_settings_, key)) change_document(Command("unset", {{"key", key}}));
  for (const auto& [key, text] : saved_settings_)
    if (differs(document_.settings, saved_settings_, key))
      change_document(Command("set", {{"key", key}, {"value", text}}));
  end_gesture();
  return {};
}

}  // namespace pedicel::app
