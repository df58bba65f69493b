// The program without its window's rooms (PEDICEL_WINDOW=OFF).
#include <cstdio>

#include "app/verbs/cli.h"

namespace {

/// Says that there is no window; a run off screen follows, where that can give what was asked for.
std::optional<int> no_window(const pedicel::app::DesktopRequest& request) {
  constexpr int no_pictures = 77;
  const bool picture = !request.screenshot.empty() || !request.record.empty();
  std::fprintf(stderr,
               "no %s: this program was built without its window (PEDICEL_WINDOW=OFF); runs and "
               "their pictures work off screen, with --headless\n",
               picture ? "pictures" : "window");
  return picture ? std::optional<int>(no_pictures) : std::nullopt;
}

}  // namespace

int main(int argc, char** argv) {
  return pedicel::app::run_cli(argc, argv, no_window);
}
