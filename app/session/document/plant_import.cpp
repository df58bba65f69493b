#include "app/session/document/plant_import.h"

#include "engine/core/check.h"
#include "engine/io/unit_text.h"
#include "plugins/skeleton/plant_source.h"

namespace pedicel::app {

bool is_plant_file(const std::filesystem::path& path) {
  return plant::source_kind(path) == plant::SourceKind::plant_file;
}

std::optional<plant::PlantFile> read_plant(const std::filesystem::path& path,
                                           Diagnostics& diagnostics, double unit) {
  return plant::read_plant_source(path, unit, diagnostics);
}

double unit_of_text(const std::string& text, const std::string& option) {
  if (text.empty()) return 0.0;
  if (const auto unit = io::length_unit(text)) return *unit;
  throw UsageError(option + " " + printable(text, 60) + ": expected " +
                   io::expected_length_units());
}

}  // namespace pedicel::app
