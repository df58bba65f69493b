#include <cmath>

#include "app/plant_overrides.h"
#include "app/rod_options.h"
#include "core/check.h"
#include "io/csv.h"
#include "session/plant_parameters.h"
#include "session/session.h"

/// Described numbers that may be changed while the plant moves.
namespace pedicel::app {

namespace {

/// The settings that the scene and the document make of the solver and the contacts.
struct Settings {
  cosserat::RodSettings rods;
  coupling::CouplingSettings coupling;
};

Settings settings_of(const world::Scene& scene) {
  Settings settings;
  Diagnostics diagnostics;
  apply_rod_settings(scene.rods, settings.rods, diagnostics);
  apply_coupling_settings(scene.coupling, settings.coupling, diagnostics);
  return settings;
}

SessionParameter described(const std::string& group, const Parameter& now,
                           const Parameter& initial) {
  SessionParameter one;
  one.key = group + "." + now.name;
  one.group = group;
  one.unit = now.unit;
  one.sentence = now.sentence;
  one.value = now.get();
  one.initial = initial.get();
  one.minimum = now.minimum;
  one.maximum = now.maximum;
  one.flag = std::holds_alternative<bool*>(now.value);
  one.whole = std::holds_alternative<int*>(now.value);
  one.logarithmic = !one.flag && one.maximum > 1.0e3 * std::max(one.minimum, 1.0e-12);
  one.restarts = now.name == "margin" || now.name == "two_way" || now.name == "self_contact";
  return one;
}

void add(std::vector<SessionParameter>& all, const std::string& group,
         const std::vector<Parameter>& now, const std::vector<Parameter>& initial) {
  for (std::size_t i = 0; i < now.size(); ++i) all.push_back(described(group, now[i], initial[i]));
}

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

std::vector<SessionParameter> document_parameters(const Document& document, const Document& plain) {
  std::vector<SessionParameter> all;
  const world::Scene scene = scene_of(document), files = scene_of(plain);
  Settings now = settings_of(scene), initial = settings_of(files);
  add(all, "rods", cosserat::parameters_of(now.rods), cosserat::parameters_of(initial.rods));
  add(all, "coupling", coupling::parameters_of(now.coupling),
      coupling::parameters_of(initial.coupling));
  for (std::size_t p = 0; p < document.plants.size(); ++p)
    if (document.plants[p].file)
      add_plant_parameters(all, document.plants[p].entry.name, *document.plants[p].file,
                           scene.plants[p].set, files.plants[p].set);
  return all;
}

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
