#include "app/report/manual.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "engine/core/check.h"
#include "engine/core/joined.h"
#include "engine/io/asset_folder.h"
#include "engine/io/text_file.h"

namespace pedicel::app {

namespace {

std::filesystem::path folder() {
  const std::filesystem::path assets = io::asset_folder();
  if (assets.empty() || !std::filesystem::exists(assets / "manual" / "index.md"))
    throw std::runtime_error("the manual is not there, expected it in the folder assets/manual");
  return assets / "manual";
}

/// Without the lines that are comments of Markdown: marks of tables that the program writes.
std::string without_comments(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string line = text.substr(at, end - at);
    if (!line.starts_with("<!--")) out += line;
    at = end;
  }
  return out;
}

bool has_screen() {
  for (const char* name : {"WAYLAND_DISPLAY", "DISPLAY"})
    if (const char* value = std::getenv(name); value && *value) return true;
  return false;
}

}  // namespace

std::vector<std::string> manual_pages() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder()))
    if (entry.path().extension() == ".md") names.push_back(entry.path().stem().string());
  std::ranges::sort(names, {},
                    [](const std::string& name) { return std::pair(name != "index", name); });
  return names;
}

std::string manual_text(const std::string& page) {
  const std::vector<std::string> pages = manual_pages();
  if (std::ranges::find(pages, page) != pages.end())
    return without_comments(io::read_text_file(folder() / (page + ".md")));
  throw UsageError("the manual has no page \"" + page + "\", expected one of: " + joined(pages));
}

std::filesystem::path manual_html(const std::string& page) {
  // Installed as documentation; in a tree that was built, where tools/manual puts it.
  const std::filesystem::path above = folder().parent_path().parent_path();
  for (const auto& html :
       {above.parent_path() / "doc" / "pedicel" / "html", above / "build" / "manual"})
    if (std::filesystem::exists(html / (page + ".html"))) return html / (page + ".html");
  return {};
}

bool open_in_browser(const std::filesystem::path& file) {
  if (!has_screen()) return false;
  // A shell puts it aside and ends: without a desktop, xdg-open is the browser until that is
  // closed.
  std::string shell = "sh", option = "-c", path = file.string(),
              line = "command -v xdg-open >/dev/null && { xdg-open \"$1\" >/dev/null 2>&1 & }";
  char* arguments[] = {shell.data(), option.data(), line.data(),
                       shell.data(), path.data(),   nullptr};
  pid_t process = 0;
  if (posix_spawnp(&process, shell.c_str(), nullptr, nullptr, arguments, environ) != 0)
    return false;
  int status = 0;
  return waitpid(process, &status, 0) == process && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace pedicel::app
