#include "app/help/manual_rows.h"

#include <cctype>
#include <cmath>

#include "app/help/manual_cells.h"
#include "app/session/commands/command_table.h"
#include "engine/core/exit_code.h"
#include "engine/core/joined.h"
#include "engine/core/parameter.h"
#include "engine/world/settings.h"
#include "plugins/cosserat/solver/rod_solver.h"
#include "plugins/coupling/coupling_settings.h"
#include "plugins/discrepancy/settings/scene_settings.h"
#include "plugins/effects/registry/effect_definition.h"
#include "plugins/plant/plant_numbers.h"
#include "plugins/plant/plant_shape.h"

namespace pedicel::app {

namespace {

std::string range_of(const effects::EffectParameter& parameter) {
  if (parameter.size == 3)
    return std::isfinite(parameter.bounds.minimum) ? "three numbers " + range_cell(parameter.bounds)
                                                   : "`[x, y, z]`";
  if (parameter.size > 1)
    return std::to_string(parameter.size) + " numbers, " + range_cell(parameter.bounds);
  if (parameter.size > 0) return range_cell(parameter.bounds);
  const std::string words =
      joined(parameter.words, [&](const std::string& word) { return code(word); });
  return words.empty() ? "a name" : words;
}

void add_effects(std::vector<ManualRow>& rows) {
  for (const effects::EffectDefinition& one : effects::effect_definitions()) {
    rows.push_back({"effects", 1, {code(one.name), one.needs_place ? "needed" : "", one.sentence}});
    for (const effects::EffectParameter& parameter : one.parameters)
      rows.push_back(
          {"effects",
           2,
           {code(one.name), code(parameter.name), parameter.size == 0 ? "" : parameter.unit,
            parameter.required ? "needed" : parameter.otherwise, range_of(parameter),
            parameter.sentence}});
  }
}

// `settings` are those of a default-constructed section, so that values are defaults.
void add_parameters(std::vector<ManualRow>& rows, const std::vector<Parameter>& settings,
                    const char* page = "settings") {
  for (const Parameter& one : settings) {
    const bool flag = std::holds_alternative<bool*>(one.value);
    const bool whole = std::holds_alternative<int*>(one.value);
    const std::string bounds = number_cell(one.minimum) + " to " + number_cell(one.maximum);
    rows.push_back({page,
                    1,
                    {code(one.name), one.unit, number_cell(one.get()),
                     flag ? "0, 1" : (whole ? "whole, " : "") + bounds, phrase(one.sentence)}});
  }
}

void add_settings(std::vector<ManualRow>& rows) {
  for (const world::SceneNumber& one : world::scene_numbers())
    rows.push_back({"settings",
                    1,
                    {code(std::string(one.key)), std::string(one.unit), "the scene's",
                     (one.whole() ? "whole, " : "") + number_cell(one.minimum) + " to " +
                         number_cell(one.maximum),
                     phrase(std::string(one.sentence))}});
  cosserat::RodSettings rods;
  add_parameters(rows, cosserat::parameters_of(rods));
  coupling::CouplingSettings contact;
  add_parameters(rows, coupling::parameters_of(contact));
  for (const plant::PlantNumber& one : plant::plant_numbers())
    rows.push_back({"settings",
                    1,
                    {code(std::string(one.key)), std::string(one.unit), "the plant's",
                     range_cell(one.bounds), phrase(std::string(one.sentence))}});
}

void add_sensors(std::vector<ManualRow>& rows) {
  for (const plant::ShapeFactor& one : plant::shape_factors())
    rows.push_back({"settings",
                    1,
                    {code(std::string(one.key)), "1", "1", range_cell(plant::shape_bounds),
                     phrase(std::string(one.sentence))}});
  world::SceneLook look;
  add_parameters(rows, look.parameters());
  world::CameraNoise camera;
  add_parameters(rows, camera.parameters(), "cameras");
  for (const world::InstrumentKind& kind : world::instrument_kinds())
    add_parameters(rows, world::InstrumentNoise(kind).parameters(), "cameras");
}

std::string default_cell(const discrepancy::DiagnosisSetting& one) {
  return number_cell(one.get()) + (one.unit == "1" ? "" : " " + one.unit);
}

std::string meaning_cell(const discrepancy::DiagnosisSetting& one) {
  std::string twice = phrase(one.doubled);
  if (!twice.starts_with("It cannot")) {
    twice.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(twice.front())));
    twice = "Doubled: " + twice;
  }
  return one.sentence + " " + twice;
}

// The page says once what stands behind a kind without a source.
std::string origin_cell(const discrepancy::DiagnosisSetting& one) {
  const std::string kind(discrepancy::to_string(one.kind));
  const std::string source = one.source.substr(0, one.source.find("; no figure was kept"));
  const bool usual = source == "bench of hidden effects" ||
                     source == "scenes with a known answer" || source.starts_with("time against");
  return usual ? kind : kind + ": " + source;
}

// `defaults` is default-constructed.
template <class Settings>
void add_diagnosis_settings(std::vector<ManualRow>& rows, const char* page, Settings defaults) {
  for (const discrepancy::DiagnosisSetting& one : discrepancy::described(defaults))
    rows.push_back(
        {page, 1, {code(one.name), default_cell(one), meaning_cell(one), origin_cell(one)}});
}

void add_commands(std::vector<ManualRow>& rows) {
  for (const CommandDescription& one : command_table()) {
    std::string arguments;
    for (const ArgumentDescription& argument : one.arguments)
      arguments += (arguments.empty() ? "" : "; ") + code(argument.name) +
                   (argument.needed ? "" : " (optional)") + ": " + argument.sentence;
    rows.push_back({"scripts", 1, {code(one.verb), arguments, one.sentence}});
  }
}

}  // namespace

std::vector<ManualRow> manual_rows() {
  std::vector<ManualRow> rows;
  add_effects(rows);
  add_settings(rows);
  add_sensors(rows);
  add_diagnosis_settings(rows, "diagnosis_settings", discrepancy::DiagnosisSettings{});
  add_diagnosis_settings(rows, "scene_settings", discrepancy::SceneSettings{});
  add_commands(rows);
  for (const ExitCodeDescription& one : exit_codes())
    rows.push_back({"command_line", 1, {one.code, one.meaning}});
  return rows;
}

}  // namespace pedicel::app
