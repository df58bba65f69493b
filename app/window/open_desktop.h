#pragma once

#include <optional>

#include "app/cli.h"

namespace pedicel::app {

/// The desktop as the command line asks for it, see OpenDesktop. With `screenshot` it runs off
/// screen, writes the picture and ends: exit code 77 where there is no OpenGL.
std::optional<int> open_desktop(const DesktopRequest& request);

}  // namespace pedicel::app
