#include "plugins/discrepancy/fit/parameter_request.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "engine/core/check.h"
#include "engine/core/joined.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

// Each is simulated over the first part of all records before the first fit.
constexpr int most_starts = 24;

// Kept as it was written, too, because a refusal has to quote it.
struct Word {
  std::string text, effect, parameter;
  std::optional<std::string> value;
  std::optional<plant::CurvePlace> place;
};

[[noreturn]] void refuse(const std::string& word, const std::string& why) {
  // Usage, and not a fault of a file: what is wrong was typed, and is quoted as it was.
  throw UsageError("fit " + word + ": " + why);
}

std::optional<double> number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // To the last character: "0.7m" would be read as 0.7 and its unit be lost. And "nan" is a number
  // to the library.
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

plant::CurvePlace parse_place(const std::string& word, const std::string& text,
                              const Experiment& experiment) {
  // The last one: whatever a curve's name has in it, what stands behind it has none.
  const std::size_t colon = text.rfind(':');
  const auto at = colon == std::string::npos ? std::nullopt : number(text.substr(colon + 1));
  if (!at || *at < 0.0 || *at > 1.0)
    refuse(word, "the place is \"" + text + "\", expected CURVE:AT with AT from 0 to 1");
  const plant::CurvePlace place{text.substr(0, colon), *at, {}};
  if (std::ranges::none_of(experiment.plants, [&](const ExperimentPlant& plant) {
        return plant.file.curve_index(place.curve) >= 0;
      }))
    // Here and not by the simulator, which would refuse it later and without the word.
    refuse(word, "the plant has no curve \"" + place.curve + "\"");
  return place;
}

// "youngs_modulus, density, damping_time".
std::string factor_names() {
  std::string names;
  for (const effects::EffectDefinition* one : effects::material_factors())
    names += (names.empty() ? "" : ", ") + one->name;
  return names;
}

Word parse(const std::string& text, const Experiment& experiment, const FitVocabulary& known) {
  Word word;
  word.text = text;
  std::string rest = text;
  // The place first. It stands behind a value, too, and would be taken for a part of it.
  if (const std::size_t sign = rest.find('@'); sign != std::string::npos) {
    word.place = parse_place(text, rest.substr(sign + 1), experiment);
    rest.resize(sign);
  }
  if (const std::size_t sign = rest.find('='); sign != std::string::npos) {
    word.value = rest.substr(sign + 1);
    rest.resize(sign);
  }
  // Values and places are gone by now, whose numbers have points, too.
  const std::size_t dot = rest.find('.');
  word.effect = rest.substr(0, dot);
  // Modulus, density and damping have one number, and nobody would guess its name.
  word.parameter = dot == std::string::npos ? "factor" : rest.substr(dot + 1);
  const Hypothesis base = baseline();
  const bool material =
      std::ranges::any_of(base.effects, [&](const auto& e) { return e.name == word.effect; });
  const std::optional<EffectKind> kind = known.kind(word.effect);
  // The name of an effect alone could mean any of its numbers, so it is not taken for all of them.
  if (!kind || (dot == std::string::npos && !material))
    refuse(text, "expected " + factor_names() + ", or EFFECT.PARAMETER of a known effect");
  // A place is no parameter of an effect, but a fit may move it like one.
  const bool moves = kind->needs_place && word.parameter == "at";
  // A refusal says what would have been right.
  const std::string names =
      joined(*kind->parameters, [](const auto& p) -> const std::string& { return p.name; });
  if (!moves && std::ranges::none_of(*kind->parameters,
                                     [&](const auto& p) { return p.name == word.parameter; }))
    refuse(text, word.effect + " has no \"" + word.parameter + "\", expected one of " + names);
  // A place that is ignored would look as if the effect had been put there.
  if (word.place && !kind->needs_place) refuse(text, word.effect + " has no place");
  return word;
}

/// The words that belong to one effect at one place.
struct Group {
  std::string effect;
  std::optional<plant::CurvePlace> place;
  std::vector<Word> words;
};

// Places come first: a word without one belongs to all of its effect's places, in whatever order
// they were given.
std::vector<Group> group(const std::vector<Word>& words) {
  std::vector<Group> groups;
  const auto find = [&](const Word& w) {
    return std::ranges::find_if(
        groups, [&](const Group& g) { return g.effect == w.effect && g.place == w.place; });
  };
  for (const Word& w : words)
    if (w.place && find(w) == groups.end()) groups.push_back({w.effect, w.place, {}});
  for (const Word& w : words) {
    // Only where no word of this effect has a place does it stand without one.
    const bool placed = std::ranges::any_of(
        groups, [&](const Group& g) { return g.effect == w.effect && g.place; });
    if (!placed && find(w) == groups.end()) groups.push_back({w.effect, {}, {}});
    for (Group& g : groups)
      if (g.effect == w.effect && (g.place == w.place || !w.place)) g.words.push_back(w);
  }
  return groups;
}

std::vector<Hypothesis> material_starts(const std::string& name) {
  // A baseline's entry keeps its bounds, which a verdict uses as well.
  const Hypothesis all = baseline();
  std::vector<Hypothesis> starts;
  for (int p = 0; p < all.size(); ++p) {
    const plant::Effect& effect = all.effects[all.free[p].effect];
    if (effect.name != name) continue;
    Hypothesis one;
    one.effects = {effect};
    one.free = {all.free[p]};
    one.free[0].effect = 0;
    // A fit that pulled a density back to what is known beforehand would return what was put in.
    one.free[0].prior = 0.0;  // what is asked for by name is judged by the data alone
    // As given, and two either way in equal steps of the logarithm.
    for (const double factor : {1.0, 0.55, 0.75, 1.35, 1.9}) {
      one.set_value(0, factor);
      starts.push_back(one);
    }
  }
  return starts;
}

void give(const Word& word, plant::Effect& effect, const effects::EffectParameter& parameter) {
  if (parameter.size == 0) {
    const auto& known = parameter.words;
    // An empty list allows any word, such as the name of a marker.
    if (!known.empty() && std::ranges::find(known, *word.value) == known.end())
      refuse(word.text, "is not one of the words that it may be");
    effect.words[word.parameter] = *word.value;
    return;
  }
  // A word that is no number is refused below, with the same sentence as a number out of bounds.
  const auto value = number(*word.value);
  // One word of a command holds one number, and a part of a direction would say nothing.
  if (parameter.size != 1) refuse(word.text, "a vector can be fitted, not given");
  // The same bounds as in a plant file. What a reader refuses is not let in by this door.
  const io::Bounds& bounds = parameter.bounds;
  if (!value || *value < bounds.minimum || *value > bounds.maximum ||
      (bounds.open_minimum && *value == bounds.minimum))
    refuse(word.text, "\"" + *word.value + "\" is not a number that it may be");
  effect.numbers[word.parameter] = {*value};
}

bool is_of(const FreeParameter& free, const std::string& parameter) {
  // A horizontal direction is fitted as its angle, so that it stays a unit vector. Who asks for it
  // uses the file's word.
  return free.name == parameter || (free.name == "heading" && parameter == "direction");
}

// What of a diagnosis's start is free here, and what is given.
Hypothesis adapted(Hypothesis start, const Group& group, const EffectKind& kind) {
  plant::Effect& effect = start.effects[0];
  // A diagnosis tries several places; here one was asked for.
  if (group.place) effect.place = *group.place;
  for (const Word& word : group.words)
    if (word.value)
      for (const effects::EffectParameter& p : *kind.parameters)
        if (p.name == word.parameter) give(word, effect, p);
  // What was not named stays at the diagnosis's first value. check_words() sees to it that no size
  // is among these in silence.
  std::erase_if(start.free, [&](const FreeParameter& free) {
    return std::ranges::none_of(
        group.words, [&](const Word& w) { return !w.value && is_of(free, w.parameter); });
  });
  // Intervals are of what these data say.
  for (FreeParameter& free : start.free) free.prior = 0.0;
  return start;
}

void check_words(const Group& group, const EffectKind& kind,
                 const std::vector<Hypothesis>& starts) {
  const auto spoken_of = [&](const std::string& parameter) {
    return std::ranges::any_of(group.words,
                               [&](const Word& w) { return w.parameter == parameter; });
  };
  for (const Word& word : group.words) {
    if (word.value) continue;
    // Any start tells it: starts of one effect differ in values and places, not in what is free.
    const bool fits = std::ranges::any_of(starts.front().free, [&](const FreeParameter& free) {
      return is_of(free, word.parameter);
    });
    // Told with what would do. Some parameters have no unknown in any fit.
    if (!fits) refuse(word.text, "cannot be fitted; give it as " + word.text + "=VALUE");
  }
  if (kind.needs_place && !group.place)
    // A diagnosis looks for the place. Its first guess would be taken for what was asked.
    refuse(group.words.front().text, group.effect + " needs a place: @CURVE:AT");
  // A size that nobody speaks of would be a diagnosis's first guess, and silently so.
  for (const effects::EffectParameter& p : *kind.parameters)
    // The curvature k0 only scales another number, and is a diagnosis's own.
    if (p.required && p.name != "k0" && !spoken_of(p.name))
      refuse(group.words.front().text, group.effect + " also needs " + p.name + ": name it (" +
                                           group.effect + "." + p.name + ") or give it (" +
                                           group.effect + "." + p.name + "=VALUE)");
}

// Whether a start is of the joint, plant or sensor that was given.
bool is_meant(const Hypothesis& start, const Group& group) {
  return std::ranges::all_of(group.words, [&](const Word& word) {
    const auto own = start.effects[0].words.find(word.parameter);
    return !word.value || own == start.effects[0].words.end() || own->second == *word.value;
  });
}

std::vector<Hypothesis> starts_of(const Group& group, const FitVocabulary& known) {
  std::vector<Hypothesis> starts = material_starts(group.effect);
  for (const Cause& cause : known.causes)
    // The same starts as a diagnosis, so that both find the same valleys. Those led by symptoms are
    // not among them: no symptom was looked for.
    if (cause.name == group.effect) starts = cause.starts;
  if (starts.empty())
    // An effect without a start cannot be seen here, whoever asks for it. A fit of it would end
    // anywhere and say so with an interval.
    refuse(group.words.front().text, group.effect + " cannot be fitted to this experiment");
  const EffectKind kind = *known.kind(group.effect);
  check_words(group, kind, starts);
  std::vector<Hypothesis> meant = starts;
  std::erase_if(meant, [&](const Hypothesis& start) { return !is_meant(start, group); });
  // A word that no start has, such as the kind of a law, is given to all of them.
  if (meant.empty()) meant = std::move(starts);
  std::vector<Hypothesis> result;
  for (const Hypothesis& start : meant) {
    const Hypothesis one = adapted(start, group, kind);
    // Starts that differed in what is given now are one, and would be fitted several times.
    const bool is_there = std::ranges::any_of(
        result, [&](const Hypothesis& other) { return other.effects[0] == one.effects[0]; });
    if (!is_there) result.push_back(one);
  }
  return result;
}

}  // namespace

FitVocabulary plant_vocabulary(const Experiment& experiment) {
  // More than a diagnosis tries: an effect may be no candidate there, and still be asked for by a
  // person who has reasons.
  return {fitted_causes(experiment, scales_of(experiment)),
          [](const std::string& name) -> std::optional<EffectKind> {
            const effects::EffectDefinition* known = effects::find_effect(name);
            if (!known) return {};
            return EffectKind{&known->parameters, known->needs_place};
          }};
}

std::vector<Hypothesis> requested_starts(const Experiment& experiment, const FitVocabulary& known,
                                         const std::vector<std::string>& words) {
  std::vector<Word> parsed;
  for (const std::string& word : words) {
    // As text, because the same parameter at two places is no repetition.
    if (std::ranges::any_of(parsed, [&](const Word& w) { return w.text == word; }))
      // The same number twice would be two unknowns for one thing, and neither would have an
      // interval.
      refuse(word, "is named twice");
    parsed.push_back(parse(word, experiment, known));
  }
  // One model that is empty, so that the first effect's starts are paired as those of every other
  // are.
  std::vector<Hypothesis> all{Hypothesis{}};
  for (const Group& one : group(parsed)) {
    const std::vector<Hypothesis> starts = starts_of(one, known);
    std::vector<Hypothesis> longer;
    // All pairs while they are few; beyond that each start with one of the others.
    const bool product = all.size() * starts.size() <= most_starts;
    const std::size_t count =
        product ? all.size() * starts.size() : std::max(all.size(), starts.size());
    for (std::size_t i = 0; i < count; ++i) {
      // Of unequal lists the shorter one begins again, so that every start of each is used at least
      // once.
      longer.push_back(all[product ? i / starts.size() : i % all.size()]);
      longer.back().add(starts[i % starts.size()]);
    }
    all = std::move(longer);
  }
  return all;
}

std::vector<Hypothesis> requested_starts(const Experiment& experiment,
                                         const std::vector<std::string>& words) {
  return requested_starts(experiment, plant_vocabulary(experiment), words);
}

}  // namespace pedicel::discrepancy
