#include "app/verbs/import_words.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "engine/core/check.h"
#include "engine/core/diagnostics.h"
#include "engine/io/number_text.h"
#include "engine/io/unit_text.h"

namespace pedicel::app {

namespace {

std::optional<double> number_of_word(const std::string& text) {
  const io::NumberText number = io::number_of(text);
  if (number.kind != io::NumberText::Kind::number) return std::nullopt;
  return number.value;
}

void add_word_list(CLI::App& verb, const std::string& option, std::vector<std::string>& list,
                   const std::string& help) {
  verb.add_option(option, list, help + "; may be repeated")->allow_extra_args(false);
}

}  // namespace

void add_frame_options(CLI::App& verb, ImportArguments& a) {
  verb.add_option("--units", a.units, "of lengths in the recordings: m, cm, mm or metres");
  verb.add_option("--rate", a.rate, "of the recordings' frames, Hz")
      ->check(CLI::Range(1.0e-9, 1.0e9));
  auto* up = verb.add_option("--up", a.up, "the axis of the recordings that points up")
                 ->check(CLI::IsMember({"x", "y", "z"}));
  verb.add_option("--axes", a.axes, "the recordings' axes along the world's x, y and z: x,-z,y")
      ->excludes(up);
  verb.add_option("--origin", a.origin, "the recordings' origin in the world, m (default: 0,0,0)");
  verb.add_option("--scale", a.scale, "of points in pixels, m a pixel")
      ->check(CLI::Range(1.0e-9, 1.0e9));
  verb.add_option("--origin-pixel", a.origin_pixel, "pixel of the recordings' origin: u,v");
  verb.add_option("--camera", a.camera,
                  "file of the camera that saw the pixels: position, orientation, focal, centre");
  verb.add_option("--plane", a.plane, "in which points in pixels move, with --camera: y=0.02 (m)");
  verb.add_option("--likelihood", a.likelihood, "less likely points were not seen")
      ->check(CLI::Range(0.0, 1.0));
}

void add_place_options(CLI::App& verb, ImportArguments& a) {
  add_word_list(verb, "--place", a.places, "POINT=CURVE:AT, where a point sits on the plant");
  add_word_list(verb, "--map", a.names,
                "POINT=NAME, its name in the experiment; of a log its map (a file)");
  add_word_list(verb, "--hold", a.holds, "POINT=CURVE:AT, a point that leads the plant there");
  verb.add_option("--lead", a.lead, "CURVE:AT, where the machine of --force leads the plant");
  verb.add_option("--stiffness", a.stiffness, "of what leads, N/m (default: rigid)")
      ->check(CLI::Range(1.0e-9, 1.0e9));
  add_word_list(
      verb, "--begin", a.begins,
      "[TRIAL=]S, when the trial begins on the recording's clock (default: first sample)");
  add_word_list(verb, "--release", a.releases, "[TRIAL=]S, when what leads lets go");
}

void add_force_options(CLI::App& verb, ImportArguments& a) {
  add_word_list(verb, "--force", a.forces, "[TRIAL=]FILE, a table of the force on the plant");
  add_word_list(verb, "--force-begin", a.force_begins,
                "[TRIAL=]S, when the trial begins on the force table's clock");
  auto* direction = verb.add_option("--force-direction", a.force_direction,
                                    "of the pull where the force is positive: x, -z or 0.6,0,0.8");
  verb.add_option("--force-axes", a.force_axes, "the sensor's axes along the world's: x,-z,y")
      ->excludes(direction);
  verb.add_option("--force-column", a.force_column, "column of the force");
  verb.add_option("--force-unit", a.force_unit, "of the force: N, mN or gf");
  verb.add_option("--time-unit", a.time_unit, "of the force table's time: s or ms");
  verb.add_option("--extension-column", a.extension,
                  "column of the machine's displacement, for --lead");
}

double length_of_text(const std::string& text, const std::string& option) {
  if (const auto unit = io::length_unit(text)) return *unit;
  throw UsageError(option + " " + in_quotes(text) + ": expected " + io::expected_length_units());
}

double factor_of_text(const std::string& text, io::Quantity quantity, const std::string& option) {
  const auto unit = io::unit_of(text);
  if (unit && unit->quantity == quantity) return unit->factor;
  throw UsageError(option + " " + in_quotes(text) + ": expected " + io::units_of(quantity));
}

void refuse_missing(const std::vector<std::string>& missing) {
  if (missing.empty()) return;
  std::vector<std::string> once;
  std::string text;
  for (const std::string& sentence : missing) {
    if (std::ranges::find(once, sentence) != once.end()) continue;
    once.push_back(sentence);
    text += (text.empty() ? "" : "\nerror: ") + sentence;
  }
  throw UsageError(text);
}

std::pair<std::string, std::string> split_words(const std::string& text, char mark,
                                                const std::string& option,
                                                const std::string& expected) {
  const std::size_t at = text.rfind(mark);
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw UsageError(option + " " + in_quotes(text) + ": expected " + expected);
  return {text.substr(0, at), text.substr(at + 1)};
}

plant::CurvePlace curve_place(const std::string& text, const std::string& option) {
  const auto [curve, at] = split_words(text, ':', option, "CURVE:AT, as stem:0.5");
  const auto fraction = number_of_word(at);
  if (!fraction || !(*fraction >= 0.0 && *fraction <= 1.0))
    throw UsageError(option + " " + in_quotes(text) + ": " + in_quotes(at) +
                     " is no place, expected a fraction of the curve, 0 to 1");
  return {curve, *fraction, {}};
}

std::pair<std::string, plant::CurvePlace> placed_point(const std::string& text,
                                                       const std::string& option) {
  const auto [point, place] = split_words(text, '=', option, "POINT=CURVE:AT, as m1=stem:0.5");
  return {point, curve_place(place, option)};
}

void check_marker_name(const std::string& name, const std::vector<discrepancy::PlacedPoint>& places,
                       std::size_t index) {
  if (name.find_first_of(",;|\"#\t") != std::string::npos)
    throw UsageError("--place: the name " + in_quotes(name) +
                     " cannot head a column, expected another one by --map POINT=NAME");
  for (std::size_t i = 0; i < index; ++i)
    if (places[i].name == name)
      throw UsageError("--place: marker " + in_quotes(name) + " comes twice, expected it once");
}

TrialWords::TrialWords(const std::vector<std::string>& texts,
                       const std::vector<std::string>& trials, const std::string& option)
    : option_(option) {
  for (const std::string& text : texts) {
    const auto trial = std::ranges::find_if(
        trials, [&](const std::string& name) { return text.starts_with(name + "="); });
    if (trial != trials.end())
      by_trial_.emplace_back(*trial, text.substr(trial->size() + 1));
    else if (!for_all_)
      for_all_ = text;
    else
      throw UsageError(option + " " + in_quotes(text) + ": a second one for all trials, expected " +
                       "TRIAL=..., where a trial is named as its file without the ending");
  }
}

std::optional<std::string> TrialWords::of(const std::string& trial) const {
  const auto found =
      std::ranges::find(by_trial_, trial, &std::pair<std::string, std::string>::first);
  return found != by_trial_.end() ? found->second : for_all_;
}

std::optional<double> TrialWords::number(const std::string& trial) const {
  const auto text = of(trial);
  if (!text) return std::nullopt;
  if (const auto number = number_of_word(*text)) return number;
  throw UsageError(option_ + " " + in_quotes(*text) + ": expected a time in s, or TRIAL=S");
}

}  // namespace pedicel::app
