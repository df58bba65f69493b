#include "app/window/open_desktop.h"

#include <cstdio>

#include "app/headless.h"
#include "app/window/desktop.h"
#include "core/check.h"
#include "world/settings.h"

namespace pedicel::app {

namespace {

constexpr int no_opengl = 77, invalid_file = 3;

/// Where documents are kept while they are edited: $XDG_STATE_HOME/pedicel, or ~/.local/state/...
std::filesystem::path autosave_folder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state)
    return std::filesystem::path(state) / "pedicel";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::filesystem::path(home) / ".local" / "state" / "pedicel";
  return {};
}

/// False, with the faults on standard error, where it cannot be opened.
bool open_file(Session& session, const DesktopRequest& request) {
  const auto first = asset_folder() / "scenes" / "cherry_tomato_pull_aside.scene.yaml";
  const bool opened =
      session.open(request.file.empty() ? first : std::filesystem::path(request.file));
  for (const Message& message : session.messages())
    std::fprintf(stderr, "%s\n", message.text.c_str());
  for (const std::string& assignment : request.set) {
    const auto [key, value] = world::split_assignment(assignment);
    const Result set = session.run(Command("set", {{"key", key}, {"value", value}}));
    if (!set.ok) throw UsageError("--set " + assignment + ": " + set.text);
  }
  return opened;
}

int take_picture(Platform& platform, Session& session, const DesktopRequest& request,
                 const DesktopOptions& options) {
  Desktop desktop(platform, session, options);
  session.control().wait();
  desktop.ui().view.automatic_quality = false;
  desktop.ui().view.quality = CanvasQuality::best;
  if (request.time > 0.0) session.control().run_for(request.time);
  session.control().wait();
  for (int i = 0; i < 4; ++i) desktop.frame();
  const auto picture = request.with_interface
                           ? desktop.window_picture()
                           : desktop.scene_picture(request.size[0], request.size[1]);
  render::write_png(request.screenshot, picture.value());
  return 0;
}

}  // namespace

std::optional<int> open_desktop(const DesktopRequest& request) {
  PlatformOptions where;
  where.size = request.size;
  where.scale = request.scale;
  const bool picture = !request.screenshot.empty();
  std::string why;
  const auto platform = open_platform(picture ? "offscreen" : request.platform, where, why);
  if (!platform) {
    std::fprintf(stderr, "%s\n", why.c_str());
    return picture ? std::optional<int>(no_opengl) : std::nullopt;
  }
  SessionOptions about;
  about.packages = request.packages;
  if (!picture) about.autosave = autosave_folder();
  Session session(about);
  DesktopOptions options;
  if (!picture) options.preferences = preferences_path();
  if (request.theme == "light") options.theme = Theme::light;
  options.theme_given = !request.theme.empty();
  const bool opened = open_file(session, request);
  if (picture) return opened ? take_picture(*platform, session, request, options) : invalid_file;
  if (request.playing) session.control().play();
  Desktop desktop(*platform, session, options);
  while (desktop.frame() && !stop_requested) {
  }
  return 0;
}

}  // namespace pedicel::app
