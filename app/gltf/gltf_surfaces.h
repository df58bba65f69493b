#pragma once

#include "app/gltf/gltf_file.h"
#include "plugins/simulation/plants/plant_info.h"

namespace pedicel::app {

/// The things of a shape (spheres, boxes, meshes, capsules, tubes, blades) as surfaces, those of
/// one material together.
std::vector<GltfSurface> surfaces_of(const render::DrawList& shape);

/// A plant's stems and leaves as surfaces that hang on its elements.
std::vector<GltfSurface> surfaces_of(const cosserat::RodModel& model,
                                     const simulation::PlantInfo& plant);

/// A tube about a string's places, a ring at each of so many joints, along whose third axis it
/// runs.
GltfSurface string_surface(int places);

}  // namespace pedicel::app
