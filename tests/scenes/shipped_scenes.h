#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace pedicel {

/// Every scene in assets/scenes, in the order of names.
inline std::vector<std::filesystem::path> shipped_scenes() {
  std::vector<std::filesystem::path> scenes;
  const auto folder = pedicel::test::source_folder() / "assets/scenes";
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().string().ends_with(".scene.yaml")) scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

/// "cherry_tomato_pull_up", for the names of tests.
inline std::string scene_name(const ::testing::TestParamInfo<std::filesystem::path>& tested) {
  const std::string name = tested.param.filename().string();
  return name.substr(0, name.find('.'));
}

}  // namespace pedicel
