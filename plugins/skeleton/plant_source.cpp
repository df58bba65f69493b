#include "plugins/skeleton/plant_source.h"

#include <algorithm>
#include <cctype>

#include "engine/io/atomic_file.h"
#include "engine/io/table_text.h"
#include "engine/io/text_file.h"
#include "plugins/plant/plant_size.h"
#include "plugins/skeleton/helios_reader.h"
#include "plugins/skeleton/mtg_reader.h"
#include "plugins/skeleton/ply_reader.h"
#include "plugins/skeleton/skeleton_columns.h"

namespace pedicel::plant {

namespace {

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::vector<SkeletonNode> parse_nodes(const std::filesystem::path& path, SourceKind kind,
                                      double unit, Diagnostics& diagnostics) {
  const std::string file = path.string();
  if (kind == SourceKind::ply_skeleton)
    return parse_ply_skeleton(io::read_file(path), file, diagnostics, unit);
  const std::string text = io::read_text_file(path);
  if (kind == SourceKind::helios_xml) return parse_helios_xml(text, file, diagnostics, unit);
  return kind == SourceKind::mtg ? parse_mtg(text, file, diagnostics, unit)
                                 : parse_skeleton_csv(text, file, diagnostics, unit);
}

std::optional<PlantFile> read_nodes(const std::filesystem::path& path, SourceKind kind, double unit,
                                    Diagnostics& diagnostics) {
  MtgOptions options;
  options.keeps_thin = kind != SourceKind::mtg;  // a fruit's stalk
  const std::vector<SkeletonNode> nodes = parse_nodes(path, kind, unit, diagnostics);
  auto plant = checked_skeleton_plant(nodes, path.stem().string(), options, diagnostics);
  if (!plant) return std::nullopt;
  warn_of_size(*plant, diagnostics);
  diagnostics.notice({path.string()}, size_text(*plant, nodes.size()));
  return plant;
}

}  // namespace

SourceKind source_kind(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".yaml" || extension == ".yml") return SourceKind::plant_file;
  if (extension == ".mtg") return SourceKind::mtg;
  if (extension == ".csv" || extension == ".tsv" || extension == ".txt")
    return SourceKind::skeleton_table;
  if (extension == ".ply") return SourceKind::ply_skeleton;
  if (extension == ".xml") return SourceKind::helios_xml;
  return SourceKind::unknown;
}

bool is_skeleton(SourceKind kind) {
  return kind != SourceKind::unknown && kind != SourceKind::plant_file;
}

bool is_skeleton_table(const std::filesystem::path& path) {
  try {
    Diagnostics unused;
    const std::string text = io::read_text_file(path);
    const io::TableText table(text, path.string(), unused);
    std::vector<std::string> names;
    for (const io::TableColumn& column : table.columns()) names.push_back(column.name);
    return looks_like_skeleton(names);
  } catch (const InvalidFile&) {
    return false;
  }
}

std::optional<PlantFile> read_plant_source(const std::filesystem::path& path, double unit,
                                           Diagnostics& diagnostics, SourceKind kind) {
  if (kind == SourceKind::unknown) kind = source_kind(path);
  try {
    if (is_skeleton(kind)) return read_nodes(path, kind, unit, diagnostics);
    if (kind == SourceKind::plant_file && (unit == 0.0 || unit == 1.0))
      return read_plant_file(path, diagnostics);
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
    return std::nullopt;
  }
  diagnostics.error({path.string()},
                    kind == SourceKind::plant_file
                        ? "is a plant file, whose lengths are in m: expected no other unit"
                        : "cannot tell what this is, expected *.scene.yaml, *.plant.yaml, *.csv (a "
                          "skeleton or cylinders), *.mtg, *.ply (a skeleton) or *.xml (of Helios)");
  return std::nullopt;
}

}  // namespace pedicel::plant
