#include "app/dataset/annotations.h"

#include <algorithm>
#include <cmath>

#include "app/dataset/run_length.h"

namespace pedicel::app {

namespace {

using Kind = Keypoint::Kind;
using Visibility = Keypoint::Visibility;

std::vector<Kind> keypoints_of_class(ThingClass kind) {
  switch (kind) {
    case ThingClass::fruit:
      return {Kind::centre, Kind::attachment};
    case ThingClass::stem:
    case ThingClass::branch:
    case ThingClass::stalk:
      return {Kind::foot, Kind::tip};
    default:
      return {};
  }
}

bool is_annotated(ThingClass kind) {
  return kind != ThingClass::background && kind != ThingClass::ground;
}

/// Three numbers each: x, y, v; all zero outside of the picture, as COCO wants it.
void add_keypoints(Json& annotation, const SensedPicture& picture, render::Label label,
                   const std::vector<Kind>& kinds) {
  Json numbers = Json::array();
  int inside = 0;
  for (const Kind kind : kinds) {
    const auto found = std::ranges::find_if(picture.keypoints, [&](const Keypoint& one) {
      return one.thing == label && one.kind == kind;
    });
    const bool there = found != picture.keypoints.end() && found->visibility != Visibility::outside;
    inside += there;
    numbers.push_back(there ? Json(found->u) : Json(0));
    numbers.push_back(there ? Json(found->v) : Json(0));
    numbers.push_back(there ? static_cast<int>(found->visibility) : 0);
  }
  annotation["keypoints"] = std::move(numbers);
  annotation["num_keypoints"] = inside;
}

/// To four digits, so that a file says no more than it knows.
double rounded(double share) {
  return std::round(1.0e4 * share) / 1.0e4;
}

}  // namespace

Json coco_categories() {
  Json list = Json::array();
  for (int c = 0; c < thing_classes; ++c) {
    const auto kind = static_cast<ThingClass>(c);
    if (!is_annotated(kind)) continue;
    const bool machine = kind == ThingClass::robot || kind == ThingClass::body;
    Json category = {{"id", c},
                     {"name", std::string(name_of(kind))},
                     {"supercategory", machine ? "thing" : "plant"}};
    const std::vector<Kind> kinds = keypoints_of_class(kind);
    if (!kinds.empty()) {
      for (const Kind one : kinds) category["keypoints"].push_back(std::string(name_of(one)));
      category["skeleton"] = {{1, 2}};
    }
    list.push_back(std::move(category));
  }
  return list;
}

PictureLabels annotate(const SensedPicture& picture, const NamedThings& things,
                       const std::vector<long>& alone, const std::vector<bool>& detached) {
  PictureLabels labels;
  const std::vector<RunLength> runs = run_lengths(picture.map, things.all().size());
  for (std::size_t l = 1; l < runs.size(); ++l) {
    const auto label = static_cast<render::Label>(l);
    const NamedThing& thing = things.of(label);
    if (!is_annotated(thing.kind)) continue;
    if (runs[l].area == 0) {
      if (alone[l] > 0) labels.hidden.push_back(thing.name);
      continue;
    }
    Json one = {{"category_id", static_cast<int>(thing.kind)},
                {"segmentation",
                 {{"size", {picture.map.height, picture.map.width}}, {"counts", runs[l].counts}}},
                {"area", runs[l].area},
                {"bbox", runs[l].box},
                {"iscrowd", 0}};
    const std::vector<Kind> kinds = keypoints_of_class(thing.kind);
    if (!kinds.empty()) add_keypoints(one, picture, label, kinds);
    one["organ_id"] = thing.name;
    one["instance"] = label;
    one["occlusion"] =
        rounded(1.0 - std::min(1.0, static_cast<double>(runs[l].area) /
                                        static_cast<double>(std::max(1l, alone[l]))));
    one["detached"] = static_cast<bool>(detached[l]);
    labels.annotations.push_back(std::move(one));
  }
  return labels;
}

std::vector<bool> detached_things(const simulation::Simulation& simulation,
                                  const NamedThings& things) {
  std::vector<bool> gone(things.all().size(), false);
  for (int p = 0; p < simulation.rods().size(); ++p) {
    const cosserat::RodModel& model = simulation.rods().model(p);
    const cosserat::RodState& state = simulation.rods().state(p);
    for (int e = 0; e < model.size(); ++e)
      if (!state.alive[e]) gone[things.organ(p, model.elements[e].organ)] = true;
    for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f)
      if (state.fruit_gone[f]) gone[things.fruit(p, f)] = true;
  }
  return gone;
}

}  // namespace pedicel::app
