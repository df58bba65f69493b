#pragma once

#include <cstdint>

#include "engine/render/camera.h"
#include "engine/render/draw_list.h"

namespace pedicel::app {

/// A number that is another where a picture of the list would be another (a 64-bit hash of all that
/// it shows). Meshes count by their address: they are never changed, only replaced.
std::uint64_t list_key(const render::DrawList& list, const render::Camera& camera);

}  // namespace pedicel::app
