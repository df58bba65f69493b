#include "plugins/simulation/plants/organ_places.h"

#include <algorithm>

#include "engine/core/check.h"
#include "plugins/simulation/plants/plant_step.h"

namespace pedicel::simulation {

namespace {

PlaceOnPlant place_in_stem(const cosserat::RodModel& model, int plant, int organ, double at) {
  double left = 0.0;
  for (const cosserat::Element& element : model.elements)
    if (element.organ == organ) left += element.length;
  left *= at;
  PlaceOnPlant place{plant, 0, 0.0};
  for (int e = 0; e < model.size(); ++e) {
    if (model.elements[e].organ != organ) continue;
    const double length = model.elements[e].length;
    place = {plant, e, std::max(0.0, length - left)};
    if (left <= length) break;
    left -= length;
  }
  return place;
}

}  // namespace

PlaceOnPlant find_organ_place(const cosserat::RodSystem& rods, const std::string& organ,
                              double at) {
  if (!(at >= 0.0 && at <= 1.0))
    throw UsageError("at = " + std::to_string(at) + ": must be between 0 and 1");
  std::vector<std::string> names;
  for (int p = 0; p < rods.size(); ++p) {
    const cosserat::RodModel& model = rods.model(p);
    for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
      names.push_back(fruit_name(model, f));
      if (names.back() == organ) return {p, model.fruits[f].element, model.fruits[f].back};
    }
    for (int o = 0; o < static_cast<int>(model.organs.size()); ++o) {
      names.push_back(model.organs[o]);
      if (names.back() == organ) return place_in_stem(model, p, o, at);
    }
  }
  throw UsageError("no organ " + in_quotes(organ) + ", expected one of: " + list_of(names));
}

std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t shown = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, names.size()); ++i)
    text += (i ? ", " : "") + names[i];
  return text + (names.size() > shown ? ", ..." : names.empty() ? "(there is none)" : "");
}

}  // namespace pedicel::simulation
