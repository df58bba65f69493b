#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pedicel::app {

/// Names of the manual's pages, "index" first. Throws std::runtime_error where the manual is not
/// there.
std::vector<std::string> manual_pages();

/// A page as text for a terminal. Throws UsageError where there is no such page; it names all.
std::string manual_text(const std::string& page);

/// The page as HTML, where the manual was built or installed; else empty.
std::filesystem::path manual_html(const std::string& page);

/// Shows a file in the desktop's browser, and does not wait for it. False where there is no screen
/// or nothing that opens files.
bool open_in_browser(const std::filesystem::path& file);

}  // namespace pedicel::app
