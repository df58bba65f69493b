#pragma once

#include <optional>

#include "app/verbs/cli.h"

namespace pedicel::app {

/// The desktop as the command line asks for it, see OpenDesktop. With `screenshot` or `record` it
/// runs off screen, writes the picture or the film and ends: exit code 77 where there is no OpenGL,
/// of a film 4 where the simulation became unstable, 128 plus the signal where one stopped it.
std::optional<int> open_desktop(const DesktopRequest& request);

/// Films off screen, for scripts.
std::unique_ptr<FilmMaker> make_films(Session& session);

}  // namespace pedicel::app
