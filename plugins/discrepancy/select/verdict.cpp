#include "plugins/discrepancy/select/verdict.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "engine/core/exit_code.h"
#include "engine/io/described_object.h"
#include "plugins/discrepancy/select/verdict_keys.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

// Ordered, so that keys stand in the file as the page of the manual lists them, and two verdicts
// can be compared line by line.
using Json = io::DescribedObject::Json;
using io::DescribedObject;
using io::KeyType;
using io::Told;

std::vector<std::string> outcome_words() {
  std::vector<std::string> words;
  for (int o = 0; o <= static_cast<int>(Outcome::numerical); ++o)
    words.push_back(to_string(static_cast<Outcome>(o)));
  return words;
}

const io::KeyList& verdict_list() {
  const auto list = [](const char* name, const char* sentence) {
    return io::Key{.name = name, .type = KeyType::list, .sentence = sentence};
  };
  const auto part = [](const char* name, KeyType type, const char* absent, const char* sentence) {
    return io::Key{.name = name, .type = type, .otherwise = Told{absent}, .sentence = sentence};
  };
  static const io::KeyList keys{
      "verdict",
      "a verdict",
      {{.name = "format",
        .type = KeyType::word,
        .words = {"pedicel-verdict"},
        .sentence = "says what the file is"},
       {.name = "version",
        .type = KeyType::whole,
        .bounds = {2, 2},
        .sentence = "version of the format"},
       {.name = "verdict",
        .type = KeyType::word,
        .words = outcome_words(),
        .sentence = "what was found, see below"},
       list("causes",
            "the causes that are named, what explains most first; under `ambiguous` all that the "
            "data cannot tell apart, likeliest first"),
       list("details", "what is real beside them and too small to matter: the same keys"),
       list("nearest",
            "under `unknown`, the causes that came closest; `against` says what speaks "
            "against each"),
       part("symptoms", KeyType::list, "where nothing was simulated",
            "what the data show beside the refitted model, see below"),
       list("competing", "other causes, see below"),
       {.name = "parameters",
        .type = KeyType::map,
        .sentence = "refitted numbers of the plant, by name"},
       {.name = "ratios",
        .type = KeyType::map,
        .sentence = "ratios of such numbers to the file's, where these data see a ratio far more "
                    "closely than either number: `youngs_modulus/density`, with the keys of a "
                    "number"},
       {.name = "error",
        .type = KeyType::map,
        .sentence = "misfit in units of the noise, see below"},
       {.name = "gain",
        .unit = "1",
        .sentence = "(refitted - extended) / (refitted - 1) on the trials held out; `null` where "
                    "the denominator is within the noise"},
       {.name = "gain_over_nominal",
        .unit = "1",
        .sentence = "(nominal - extended) / (nominal - 1), likewise"},
       {.name = "remainder",
        .type = KeyType::text,
        .sentence = "what is still unexplained, in words, or empty"},
       {.name = "left",
        .type = KeyType::map,
        .sentence = "how much of the misfit is still unexplained, see below"},
       list("detectable_limits",
            "effects that these data could not show, see below; empty under "
            "`unknown`, whose remainder is larger than any of them"),
       {.name = "next_experiment", .type = KeyType::text, .sentence = "one sentence, or empty"},
       {.name = "extended_plant",
        .type = KeyType::path,
        .form = "or `null`",
        .sentence = "file of the plant with its named causes"},
       {.name = "next",
        .type = KeyType::path,
        .form = "or `null`",
        .sentence = "experiment.yaml of the trial that decides, see below"},
       {.name = "simulations", .type = KeyType::whole, .sentence = "trials that were simulated"},
       {.name = "seconds", .unit = "s", .sentence = "wall time"},
       list("rivals", "old name of `competing`, written for one release"),
       list("could_hide", "old name of `detectable_limits`, written for one release"),
       part("unknown", KeyType::map, "where nothing acts from outside",
            "under `unknown`, what acts from outside on a plant of a scene, see below"),
       part("extended_scene", KeyType::path, "where the model is no scene",
            "file of the [scene](scene_experiment.md#diagnosis) with its named causes"),
       part("partial", KeyType::flag, "where the search was whole", "the search was cut short")}};
  return keys;
}

const io::KeyList& cause_list() {
  static const io::KeyList keys{
      "cause",
      "a cause",
      {{.name = "name",
        .type = KeyType::text,
        .form = "an [effect](effects.md)",
        .sentence = "what it is"},
       {.name = "parameters", .type = KeyType::map, .sentence = "its numbers by name"},
       {.name = "where",
        .type = KeyType::map,
        .form = "or `null`",
        .sentence = "`curve` and `at`, or which `plant`, `fruit`, `link`, `joint`, `camera`, "
                    "`wrench` or `marker`"},
       {.name = "because",
        .type = KeyType::text,
        .sentence = "in plain words: the clearest symptom that speaks for the cause, and what is "
                    "left with it"},
       {.name = "evidence",
        .unit = "1",
        .sentence = "nats, see [theory](theory_diagnosis.md#evidence)"},
       {.name = "share",
        .type = KeyType::map,
        .sentence = "part of the misfit that the cause takes away, see below"},
       {.name = "change",
        .type = KeyType::map,
        .sentence = "RMS of what it changes, over all trials"},
       {.name = "against",
        .type = KeyType::text,
        .otherwise = Told{"but in `nearest`"},
        .sentence = "what speaks against it"},
       {.name = "instead_of",
        .type = KeyType::text,
        .otherwise = Told{"where none is certain"},
        .sentence = "under `ambiguous`, where several causes act at once: the cause in whose place "
                    "this one would stand. Causes without it that nothing would stand in for are "
                    "certain"}}};
  return keys;
}

const io::KeyList& share_list() {
  static const io::KeyList keys{
      "share",
      "a share",
      {{.name = "fit", .unit = "1", .sentence = "in the trials that were fitted"},
       {.name = "check", .unit = "1", .sentence = "in the trials held out"}},
      "share"};
  return keys;
}

const io::KeyList& change_list() {
  const auto one = [](const char* name, const char* sentence) {
    return io::Key{.name = name,
                   .type = KeyType::map,
                   .otherwise = Told{"where none was measured"},
                   .form = "`value` and `unit`",
                   .sentence = sentence};
  };
  static const io::KeyList keys{
      "change",
      "a change",
      {one("marker", "of the markers, m"), one("force", "of the force, N"),
       one("moment", "of the moment at the root, N m"), one("pixel", "of the image points, px")},
      "change"};
  return keys;
}

const io::KeyList& number_list() {
  static const io::KeyList keys{
      "number",
      "a number",
      {{.name = "value", .unit = "its `unit`", .sentence = "the most likely value"},
       {.name = "low", .unit = "its `unit`", .sentence = "lower end of its 95 % interval"},
       {.name = "high", .unit = "its `unit`", .sentence = "upper end of it"},
       {.name = "unit", .type = KeyType::text, .sentence = "its unit"}}};
  return keys;
}

const io::KeyList& size_list() {
  static const io::KeyList keys{"size",
                                "a size",
                                {{.name = "value", .unit = "its `unit`", .sentence = "the size"},
                                 {.name = "unit", .type = KeyType::text, .sentence = "its unit"}}};
  return keys;
}

const io::KeyList& outside_list() {
  static const io::KeyList keys{
      "outside",
      "what acts from outside",
      {{.name = "position",
        .type = KeyType::vector,
        .unit = "m",
        .sentence = "in the world: the place on the plant when it begins"},
       {.name = "plant", .type = KeyType::text, .sentence = "name of that plant"},
       {.name = "curve", .type = KeyType::text, .sentence = "name of that curve"},
       {.name = "at", .unit = "1", .sentence = "that place on it"},
       {.name = "from", .unit = "s", .sentence = "when it begins to act"},
       {.name = "to", .unit = "s", .sentence = "when it ends"},
       {.name = "direction",
        .type = KeyType::vector,
        .unit = "1",
        .form = "a unit vector",
        .sentence = "in the world: where it pulls"}}};
  return keys;
}

const io::KeyList& symptom_list() {
  static const io::KeyList keys{
      "symptom",
      "a symptom",
      {{.name = "name", .type = KeyType::text, .sentence = "kind of symptom"},
       {.name = "of",
        .type = KeyType::text,
        .sentence = "the trial, marker or curve that it is about; empty: all of them"},
       {.name = "value", .unit = "its `unit`", .sentence = "the number"},
       {.name = "error", .unit = "its `unit`", .sentence = "its standard error"},
       {.name = "unit", .type = KeyType::text, .sentence = "unit of both"},
       {.name = "shows",
        .type = KeyType::flag,
        .sentence = "whether it is beyond chance: 5 standard errors, and a size that matters"},
       {.name = "speaks_for",
        .type = KeyType::list,
        .sentence = "[effects](effects.md) that would make it, the likeliest first"},
       {.name = "sentence", .type = KeyType::text, .sentence = "in words"}}};
  return keys;
}

const io::KeyList& competing_list() {
  static const io::KeyList keys{
      "competing_model",
      "a competing model",
      {{.name = "name", .type = KeyType::text, .sentence = "name of the other cause"},
       {.name = "behind",
        .unit = "1",
        .sentence = "nats by which it explains the data less well"}}};
  return keys;
}

const io::KeyList& misfits_list() {
  static const io::KeyList keys{
      "misfits",
      "the error",
      {{.name = "fit",
        .type = KeyType::map,
        .sentence = "of the trials that were fitted: `nominal`, `refitted` and `extended`"},
       {.name = "check", .type = KeyType::map, .sentence = "the same of the trials held out"},
       {.name = "unit",
        .type = KeyType::word,
        .words = {"rms residual over the noise floor"},
        .sentence = "unit of all of them"}}};
  return keys;
}

const io::KeyList& misfit_list() {
  static const io::KeyList keys{
      "misfit",
      "an error",
      {{.name = "nominal", .unit = "1", .sentence = "the model as given"},
       {.name = "refitted",
        .unit = "1",
        .sentence = "the same model with modulus, density and damping refitted"},
       {.name = "extended", .unit = "1", .sentence = "the model with the named causes"}}};
  return keys;
}

const io::KeyList& left_list() {
  static const io::KeyList keys{
      "left",
      "what is left",
      {{.name = "share",
        .type = KeyType::map,
        .sentence = "part that is left of what the refitted model leaves above the noise: `fit` "
                    "and `check`, as a cause's share"},
       {.name = "times_noise",
        .type = KeyType::map,
        .sentence = "RMS residual over the noise: likewise `fit` and `check`"},
       {.name = "channels",
        .type = KeyType::list,
        .sentence = "both by kind of instrument, over all trials"},
       {.name = "symptoms",
        .type = KeyType::list,
        .sentence = "names of the [symptoms](#symptoms) that still show"}}};
  return keys;
}

const io::KeyList& channel_list() {
  static const io::KeyList keys{
      "channel",
      "a channel",
      {{.name = "name",
        .type = KeyType::word,
        .words = {"position", "pixel", "force", "moment", "torque", "joint"},
        .sentence = "kind of instrument"},
       {.name = "times_noise", .unit = "1", .sentence = "RMS residual over the noise"},
       {.name = "share", .unit = "1", .sentence = "part that is left"}}};
  return keys;
}

const io::KeyList& limit_list() {
  static const io::KeyList keys{
      "detectable_limit",
      "a detectable limit",
      {{.name = "name", .type = KeyType::text, .sentence = "name of an effect"},
       {.name = "parameter", .type = KeyType::text, .sentence = "its number"},
       {.name = "smallest_seen",
        .unit = "its `unit`",
        .sentence = "detectable limit: the smallest size that these data would show"},
       {.name = "unit", .type = KeyType::text, .sentence = "unit of that size"}}};
  return keys;
}

Json number(double value) {
  // JSON has neither infinity nor NaN. An open end of an interval is null, and so is what was not
  // measured: a reader must not take either for a zero.
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}
Json number(const std::optional<double>& value) {
  return value ? number(*value) : Json(nullptr);
}

Json to_json(const Estimate& estimate) {
  return DescribedObject(number_list())
      .set("value", number(estimate.value))
      .set("low", number(estimate.low))
      .set("high", number(estimate.high))
      .set("unit", estimate.unit)
      .json();
}

// A vector's components stand in lists.
Json to_json(const std::vector<Estimate>& estimates) {
  // A single number stays a number. Readers that look for `value` of a modulus need not unpack a
  // list.
  if (estimates.size() == 1) return to_json(estimates.front());
  Json value = Json::array(), low = Json::array(), high = Json::array();
  for (const Estimate& estimate : estimates) {
    value.push_back(number(estimate.value));
    low.push_back(number(estimate.low));
    high.push_back(number(estimate.high));
  }
  return DescribedObject(number_list())
      .set("value", value)
      .set("low", low)
      .set("high", high)
      .set("unit", estimates.front().unit)
      .json();
}

// Every size carries its unit, because changes of markers, forces and pixels stand side by side.
Json sized(double value, const std::string& unit) {
  return DescribedObject(size_list()).set("value", number(value)).set("unit", unit).json();
}

// Only what was measured. A change of 0 N would say that a force was looked at.
Json to_json(const Change& change) {
  DescribedObject json(change_list());
  if (change.marker) json.set("marker", sized(*change.marker, "m"));
  if (change.force) json.set("force", sized(*change.force, "N"));
  if (change.moment) json.set("moment", sized(*change.moment, "N m"));
  if (change.pixel) json.set("pixel", sized(*change.pixel, "px"));
  return json.json();
}

// The key is always there, also without a place: a reader can tell "everywhere" from "forgotten".
Json where_json(const NamedCause& cause) {
  Json where = nullptr;
  if (cause.where) where = {{"curve", cause.where->curve}, {"at", cause.where->at}};
  // Words that say where are part of `where`, whatever kind of thing they name.
  for (const char* key : {"plant", "fruit", "link", "joint", "camera", "wrench", "marker"})
    if (const auto word = cause.words.find(key); word != cause.words.end())
      where[key] = word->second;
  return where;
}

Json to_json(const FitAndCheck& share) {
  return DescribedObject(share_list())
      .set("fit", number(share.fit))
      .set("check", number(share.check))
      .json();
}

Json to_json(const LeftMisfit& left) {
  Json channels = Json::array();
  for (const LeftMisfit::Channel& channel : left.channels)
    channels.push_back(DescribedObject(channel_list())
                           .set("name", channel.name)
                           .set("times_noise", number(channel.times_noise))
                           .set("share", number(channel.share))
                           .json());
  return DescribedObject(left_list())
      .set("share", to_json(left.share))
      .set("times_noise", to_json(left.times_noise))
      .set("channels", channels)
      .set("symptoms", left.symptoms)
      .json();
}

Json to_json(const NamedCause& cause) {
  // An object even where it is empty: null would say that nobody looked.
  Json parameters = Json::object();
  for (const auto& [name, estimates] : cause.parameters) parameters[name] = to_json(estimates);
  DescribedObject json(cause_list());
  json.set("name", cause.name).set("parameters", parameters).set("where", where_json(cause));
  // All words once more beside it, since some say no place: in which trial a grip slipped, from
  // which shape a relaxation counts. Their keys are parameters of effects, described there.
  for (const auto& [key, word] : cause.words) json.set_other(key, word);
  json.set("because", cause.because).set("evidence", number(cause.evidence));
  json.set("share", to_json(cause.share)).set("change", to_json(cause.change));
  if (!cause.against.empty()) json.set("against", cause.against);
  if (!cause.instead_of.empty()) json.set("instead_of", cause.instead_of);
  return json.json();
}

Json to_json(const std::vector<SymptomNumber>& symptoms) {
  Json list = Json::array();
  for (const SymptomNumber& one : symptoms)
    list.push_back(DescribedObject(symptom_list())
                       .set("name", one.name)
                       .set("of", one.of)
                       .set("value", number(one.value))
                       .set("error", number(one.error))
                       .set("unit", one.unit)
                       .set("shows", one.shows)
                       .set("speaks_for", one.speaks_for)
                       .set("sentence", one.sentence)
                       .json());
  return list;
}

Json to_json(const std::vector<NamedCause>& causes) {
  Json list = Json::array();
  for (const NamedCause& cause : causes) list.push_back(to_json(cause));
  return list;
}

Json to_json(const Vec3& vector) {
  return {number(vector.x()), number(vector.y()), number(vector.z())};
}

// The place stands twice, in the world and on a curve: the one is for a hand, the other for a
// model.
Json to_json(const OutsideAction& action) {
  return DescribedObject(outside_list())
      .set("position", to_json(action.position))
      .set("plant", action.plant)
      .set("curve", action.place.curve)
      .set("at", number(action.place.at))
      .set("from", number(action.from))
      .set("to", number(action.to))
      .set("direction", to_json(action.direction))
      .json();
}

Json to_json(const Errors& errors) {
  return DescribedObject(misfit_list())
      .set("nominal", number(errors.nominal))
      .set("refitted", number(errors.refitted))
      .set("extended", number(errors.extended))
      .json();
}

std::string short_number(double value) {
  char text[32];
  // Three digits: more than the intervals of a fit leave, and few enough to be read in a sentence.
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace

std::string to_string(Outcome outcome) {
  // Without a default, so that the compiler names what a new outcome forgets.
  switch (outcome) {
    case Outcome::adequate:
      return "adequate";
    case Outcome::named:
      return "named";
    case Outcome::ambiguous:
      return "ambiguous";
    case Outcome::unknown:
      return "unknown";
    case Outcome::bad_data:
      return "bad_data";
    case Outcome::numerical:
      return "numerical";
  }
  return "";
}

int exit_code(Outcome outcome) {
  // The order of the enumeration is that of the exit codes 10 to 14, which scripts rely on.
  return outcome == Outcome::adequate ? exit_ok : exit_cause_named - 1 + static_cast<int>(outcome);
}

std::vector<const io::KeyList*> verdict_keys() {
  return {&verdict_list(), &cause_list(),   &share_list(),   &change_list(),    &number_list(),
          &size_list(),    &outside_list(), &symptom_list(), &competing_list(), &misfits_list(),
          &misfit_list(),  &left_list(),    &channel_list(), &limit_list()};
}

std::string to_json(const Verdict& verdict) {
  Json competing = Json::array(), limits = Json::array();
  for (const CompetingModel& model : verdict.competing)
    competing.push_back(DescribedObject(competing_list())
                            .set("name", model.name)
                            .set("behind", number(model.behind))
                            .json());
  for (const DetectableLimit& limit : verdict.detectable_limits)
    limits.push_back(DescribedObject(limit_list())
                         .set("name", limit.name)
                         .set("parameter", limit.parameter)
                         .set("smallest_seen", number(limit.smallest))
                         .set("unit", limit.unit)
                         .json());
  Json parameters = Json::object();
  for (const auto& [name, estimate] : verdict.parameters) parameters[name] = to_json(estimate);
  Json ratios = Json::object();
  for (const auto& [name, estimate] : verdict.ratios) ratios[name] = to_json(estimate);
  // 1 is noise alone, and that is the best that any model can do.
  const Json error = DescribedObject(misfits_list())
                         .set("fit", to_json(verdict.fit))
                         .set("check", to_json(verdict.check))
                         .set("unit", misfits_list().find("unit")->words.front())
                         .json();
  const auto or_null = [](const std::string& file) {
    return file.empty() ? Json(nullptr) : Json(file);
  };
  DescribedObject json(verdict_list());
  json.set("format", verdict_list().find("format")->words.front())
      .set("version", 2)
      .set("verdict", to_string(verdict.outcome))
      .set("causes", to_json(verdict.causes))
      .set("details", to_json(verdict.details))
      .set("nearest", to_json(verdict.nearest))
      .set("competing", competing)
      .set("parameters", parameters)
      .set("ratios", ratios)
      .set("error", error)
      .set("gain", number(verdict.gain))
      .set("gain_over_nominal", number(verdict.gain_over_nominal))
      .set("remainder", verdict.remainder)
      .set("left", to_json(verdict.left))
      .set("detectable_limits", limits)
      .set("next_experiment", verdict.next_experiment)
      .set("extended_plant", or_null(verdict.extended_plant))
      .set("next", or_null(verdict.next))
      .set("simulations", verdict.simulations)
      .set("seconds", number(verdict.seconds))
      .set("rivals", competing)
      .set("could_hide", limits);
  // Absent where they do not apply: the manual says so of these keys, in place of null.
  if (verdict.unknown) json.set("unknown", to_json(*verdict.unknown));
  // Only a scene has one.
  if (!verdict.extended_scene.empty()) json.set("extended_scene", verdict.extended_scene);
  if (!verdict.symptoms.empty()) json.set("symptoms", to_json(verdict.symptoms));
  // Said only where it is so, since a reader that does not know the key must not take a whole
  // verdict for a part.
  if (verdict.partial) json.set("partial", true);
  return json.json().dump(2);
}

std::string said_name(const NamedCause& cause) {
  // Both names: the plain one is for people, and the one in brackets is what a file or a search
  // takes.
  return (cause.plain.empty() ? effects::plain_name(cause.name) : cause.plain) + " (" + cause.name +
         ")";
}

namespace {

// "-x", or "(0.7, 0.7, 0)" where it is along no axis.
std::string direction_text(const Vec3& direction) {
  // A force found in data is not known to a degree. Three decimals of a direction would promise
  // that.
  constexpr double near = 0.94;  // within 20 degrees
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(direction[axis]) > near)
      return std::string(direction[axis] < 0.0 ? "-" : "+") + "xyz"[axis];
  const auto rounded = [](double x) { return short_number(std::round(100.0 * x) / 100.0); };
  return "(" + rounded(direction.x()) + ", " + rounded(direction.y()) + ", " +
         rounded(direction.z()) + ")";
}

}  // namespace

// "Holds", and not "pushes": a force with a course of its own is mostly a string, a hand or another
// plant, and the direction says where it is drawn to.
std::string outside_sentence(const OutsideAction& action) {
  // To millimetres, and times to hundredths of a second: places are tried 45 mm apart, and refined
  // little beyond that.
  const auto rounded = [](double x) { return short_number(std::round(1000.0 * x) / 1000.0); };
  // Where there is one plant only, its name says nothing.
  return "Something holds " + action.place.curve +
         (action.plant.empty() ? "" : " of " + action.plant) + " at (" +
         rounded(action.position.x()) + ", " + rounded(action.position.y()) + ", " +
         rounded(action.position.z()) + ") m from " +
         short_number(std::round(100.0 * action.from) / 100.0) + " s on, pulling towards " +
         direction_text(action.direction) + ".";
}

std::string share_removed(double gain) {
  // A gain may be a little above 1, where the model does by chance better than the noise. "101 %"
  // would be no share.
  return gain > 0.995 ? "all" : short_number(100.0 * gain) + " %";
}

namespace {

std::string percent(double share) {
  // For the same reason. Shares of several causes need not add up to 1, since one may stand in for
  // another.
  return short_number(100.0 * std::min(share, 1.0)) + " %";
}

// "28 %", "2.5 times as much", and of a number that is seen loosely "32 to 57 %".
std::string size_of(const Estimate& factor, bool loosely) {
  // Beyond twice as much, per cent are read wrongly: "250 % stiffer" is 3.5 times for some and
  // 2.5 times for others.
  const bool in_percent = factor.value < 2.0;
  const auto size = [&](double times) {
    return short_number(in_percent ? 100.0 * std::abs(times - 1.0) : times);
  };
  std::string text = size(factor.value);
  const bool one_side = (factor.low - 1.0) * (factor.high - 1.0) > 0.0;
  if (loosely && one_side && std::isfinite(factor.high)) {
    const bool more = factor.value > 1.0;
    text = size(more ? factor.low : factor.high) + " to " + size(more ? factor.high : factor.low);
  }
  return text + (in_percent ? " %" : " times as much");
}

// "the plant is 28 % softer than the file says", "a weak stretch (weak_segment) at 0.21 of stem".
std::string said(const NamedCause& cause, const std::map<std::string, Estimate>& ratios) {
  const effects::EffectDefinition* known = effects::find_effect(cause.name);
  const auto factor = cause.parameters.find("factor");
  // A number of the material is said as what it means, softer or heavier. "youngs_modulus, factor
  // 0.72" is for the file.
  if (known && known->material && factor != cause.parameters.end()) {
    const Estimate& times = factor->second.front();
    const auto ratio = std::find_if(ratios.begin(), ratios.end(), [&](const auto& one) {
      return one.first.starts_with(cause.name + "/") || one.first.ends_with("/" + cause.name);
    });
    // The value alone: its interval is in the file, and a sentence with both is not read to its
    // end. Unless the data see a ratio in its place: then the value alone would claim far more than
    // they hold.
    const bool loosely = ratio != ratios.end();
    return "the plant is " + size_of(times, loosely) + " " +
           (times.value < 1.0 ? known->less : known->more) + " than the file says (" + cause.name +
           (loosely ? "; seen closely is " + ratio->first + ", " +
                          short_number(ratio->second.value) + " times the file's"
                    : "") +
           ")";
  }
  // What sits at the root has only one place to be, and need not say it.
  std::string place;
  // A marker is a better place than a number along a curve: people see it.
  if (const auto marker = cause.words.find("marker"); marker != cause.words.end())
    place = " at " + marker->second;
  else if (cause.where && known && known->home != effects::Home::base)
    place = " at " + short_number(cause.where->at) + " of " + cause.where->curve;
  return said_name(cause) + place;
}

// In mm and N, as people measure: shares say how much of a misfit, which is nothing to hold a ruler
// to.
std::string changed(const NamedCause& cause) {
  std::string text;
  if (cause.change.marker) text = short_number(1.0e3 * *cause.change.marker) + " mm";
  if (cause.change.force)
    text += (text.empty() ? "" : " and ") + short_number(*cause.change.force) + " N";
  return text;
}

std::string capital(std::string sentence) {
  if (!sentence.empty()) sentence[0] = static_cast<char>(std::toupper(sentence[0]));
  return sentence;
}

// What explains most in words of size, then what stands beside it.
// The first sentence is the one that is read. So it has the largest cause, its size and its share,
// and all else comes after it.
std::string named(const Verdict& verdict, const std::string& names, const std::string& gain) {
  const NamedCause& first = verdict.causes.front();
  // Without a misfit to share, or for a law of breaking, there is nothing but the name.
  // A law of breaking changes when fruits come off, and no sample of a marker: it has no share of a
  // misfit.
  if (!first.share.fit) return "The data show " + names + (gain.empty() ? "" : "; " + gain) + ".";
  std::string text = capital(said(first, verdict.ratios)) + ": this explains " +
                     percent(*first.share.fit) + " of the misfit" +
                     (gain.empty() ? "" : "; " + gain) + ".";
  // In the order of their shares, as they were sorted.
  for (std::size_t c = 1; c < verdict.causes.size(); ++c) {
    const NamedCause& other = verdict.causes[c];
    text += " Beside it " + said(other, verdict.ratios) +
            (other.share.fit ? " explains " + percent(*other.share.fit) : "") + ".";
  }
  return text;
}

// Said although too small to matter: a reader who knows of the thing would else think that it was
// missed.
std::string details(const Verdict& verdict) {
  std::string text;
  for (const NamedCause& cause : verdict.details) {
    if (!cause.instead_of.empty()) continue;
    const std::string size = changed(cause);
    std::string instead;
    for (const NamedCause& other : verdict.details)
      if (other.instead_of == cause.name) instead += " or " + said_name(other);
    text += " Beside it " + said(cause, verdict.ratios) + instead +
            (size.empty() ? "" : ", which changes " + size) + ".";
  }
  return text;
}

// A refit that does worse than the file where it was not fitted is the first thing to know.
// Both numbers are told, since a reader may want to keep the file's own constants.
std::string refit_that_misleads(const Verdict& verdict) {
  // Only on held-out trials can it be seen. On those that were fitted a refit is never worse.
  if (!verdict.refit_misleads) return "";
  return "Refitted to some trials the model is worse in the held-out ones than as the file says (" +
         short_number(*verdict.check.refitted) + " times the noise in place of " +
         short_number(*verdict.check.nominal) + "). ";
}

// Several causes act at once, and of some the data do not tell which.
std::string partly_ambiguous(const Verdict& verdict) {
  std::string certain, open;
  for (const NamedCause& cause : verdict.causes) {
    if (!cause.instead_of.empty()) continue;
    std::string others;
    for (const NamedCause& other : verdict.causes)
      if (other.instead_of == cause.name) others += " or " + said_name(other);
    if (others.empty())
      certain += (certain.empty() ? "" : " and ") + said(cause, verdict.ratios);
    else
      open += (open.empty() ? "" : "; and ") + said_name(cause) + others;
  }
  return "Something more is missing, and these data cannot tell which: " + open + "." +
         (certain.empty() ? "" : " Certain beside it: " + certain + ".");
}

std::string finding(const Verdict& verdict) {
  std::string names;
  for (const NamedCause& cause : verdict.causes) {
    const bool last = &cause == &verdict.causes.back();
    // Several causes are there together; of several explanations one is right.
    const std::string joint = verdict.outcome == Outcome::ambiguous ? " or " : " and ";
    names += (names.empty() ? "" : last ? joint : ", ") + said_name(cause);
  }
  // On trials held out, because on those that were fitted more numbers always remove more.
  const std::string gain = verdict.gain ? "it removes " + share_removed(*verdict.gain) +
                                              " of the error above the noise on held-out trials"
                                        : "";
  switch (verdict.outcome) {
    // Not "nothing is wrong": only what these data could show was looked for, and
    // `detectable_limits` says what they could not.
    case Outcome::adequate:
      return "The model explains these data down to their noise." + details(verdict);
    case Outcome::named:
      return named(verdict, names, gain) + details(verdict);
    case Outcome::ambiguous:
      if (std::ranges::any_of(verdict.causes,
                              [](const NamedCause& cause) { return !cause.instead_of.empty(); }))
        return partly_ambiguous(verdict) + details(verdict);
      return "Something is missing, and these data cannot tell which: " + names + "." +
             details(verdict);
    case Outcome::unknown: {
      std::string beside;
      // Something unknown may stand beside known things that are certain. These are still of use.
      for (const NamedCause& cause : verdict.causes)
        beside += " Beside it " + said(cause, verdict.ratios) + ".";
      // A model that misses something it cannot name is wrong by an unknown amount wherever it was
      // not measured.
      return "Something is missing that none of the known causes explains." +
             (verdict.unknown ? " " + outside_sentence(*verdict.unknown) : "") + beside +
             " Do not extrapolate.";
    }
    case Outcome::bad_data:
      return "The data cannot be used: " + verdict.remainder;
    case Outcome::numerical:
      return "Our own numerical error is too large for these data: " + verdict.remainder;
  }
  return "";
}

}  // namespace

std::string headline(const Verdict& verdict) {
  // Before the finding: it says that the refitted numbers must not be used.
  const std::string first = refit_that_misleads(verdict);
  if (!verdict.partial) return first + finding(verdict);
  // Cut short, `unknown` only says that nothing was concluded yet. The usual sentence would claim
  // that all known causes were tried in vain.
  return "Cut short, so this is what is known: " + first +
         (verdict.outcome == Outcome::unknown ? verdict.remainder + "." : finding(verdict));
}

}  // namespace pedicel::discrepancy
