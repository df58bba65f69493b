#pragma once

#include <nlohmann/json.hpp>

#include "app/sense/picture_files.h"

namespace pedicel::app {

/// The COCO categories: classes of things, with the names of their keypoints.
Json coco_categories();

/// COCO annotations of what is seen in a picture, without "id" and "image_id"; and the names of the
/// organs that are in the picture and wholly hidden.
struct PictureLabels {
  Json annotations = Json::array();
  std::vector<std::string> hidden;
};

/// `alone` has the pixels that each label would cover with nothing before it; `detached` is true
/// for what has come off, by label.
PictureLabels annotate(const SensedPicture& picture, const NamedThings& things,
                       const std::vector<long>& alone, const std::vector<bool>& detached);

/// By label: fruits that came off, and stalks of which a part went with one.
std::vector<bool> detached_things(const simulation::Simulation& simulation,
                                  const NamedThings& things);

}  // namespace pedicel::app
