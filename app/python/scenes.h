#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/steer/steered_run.h"

namespace pedicel::python {

/// What Simulation and Worlds are made of: a path of a scene or a plant, or a Plant; plants that
/// take the place of the scene's, by name; "NAME=PATH" of packages; keys of `--set` with their
/// values. Throws InvalidFile and UsageError.
std::shared_ptr<const app::SteeredScene> make_scene(const pybind11::object& scene,
                                                    const pybind11::dict& plants,
                                                    const std::vector<std::string>& packages,
                                                    const pybind11::dict& settings);

/// Keys and values of `--set` as texts.
app::SteeredScene::Settings settings_of(const pybind11::dict& settings);

/// A value of a setting as `--set` takes it: numbers exact, sequences with commas.
std::string setting_text(const pybind11::handle& value);

}  // namespace pedicel::python
