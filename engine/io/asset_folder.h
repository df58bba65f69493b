#pragma once

#include <filesystem>

namespace pedicel::io {

/// The folder of what Pedicel ships (scenes, robots, leaves): `assets`, beside the program or above
/// it. Empty where there is none.
std::filesystem::path asset_folder();

}  // namespace pedicel::io
