#include "app/report/moving_scene.h"

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "engine/io/asset_folder.h"

namespace pedicel::app {

namespace {

constexpr std::uintmax_t largest_scene = 40u << 20;  // bytes of a scene that goes into a page

std::optional<std::string> bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(in), {});
}

}  // namespace

std::optional<std::filesystem::path> viewer_script() {
  const char* said = std::getenv("PEDICEL_VIEWER");
  const std::filesystem::path assets = io::asset_folder();
  for (const std::filesystem::path& file :
       {std::filesystem::path(said ? said : ""), assets / "viewer" / "model-viewer.js",
        assets.parent_path() / "build" / "viewer" / "model-viewer.js"})
    if (!file.empty() && std::filesystem::is_regular_file(file)) return file;
  return std::nullopt;
}

void add_moving_scene(io::HtmlReport& page, const std::filesystem::path& glb) {
  const std::string where = "The moving scene is in " + glb.string();
  std::error_code fault;
  const std::uintmax_t size = std::filesystem::file_size(glb, fault);
  if (fault) return;
  if (size > largest_scene)
    return page.paragraph(where + "; it is larger than 40 MB, so this page does not play it.");
  const auto script = viewer_script();
  if (!script)
    return page.paragraph(
        where +
        "; this page does not play it, since the viewer is not there (tools/viewer "
        "fetches it).");
  const auto scene = bytes_of(glb), viewer = bytes_of(*script);
  if (scene && viewer)
    page.moving_scene(*scene, *viewer, "The whole run; drag turns it, the wheel goes nearer.");
}

}  // namespace pedicel::app
