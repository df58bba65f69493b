#include "app/dataset/data_set_files.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "app/dataset/annotations.h"
#include "app/dataset/contact_sheet.h"
#include "app/report/version.h"
#include "app/sense/noise.h"
#include "engine/core/diagnostics.h"
#include "engine/io/atomic_file.h"
#include "engine/world/scene_writer.h"

namespace pedicel::app {

namespace {

namespace fs = std::filesystem;

constexpr int sheet_pictures = 20, sheet_columns = 5, sheet_width = 256;

std::string hex(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

/// Files of a run that was killed while it wrote them.
void remove_parts(const fs::path& folder) {
  for (const auto& one : fs::recursive_directory_iterator(folder))
    if (one.is_regular_file() && one.path().filename().string().find(".part") != std::string::npos)
      fs::remove(one.path());
}

Json about(const DataSetOptions& options) {
  return {{"format", "pedicel-dataset"},
          {"version", 1},
          {"scene", options.scene.name},
          {"seed", options.seed},
          {"identity", identity_of(options)},
          {"coordinates",
           "pixels count from the upper left corner, the middle of the first one is (0.5, 0.5); "
           "camera frames have x right, y down, z forward; depth is along z, in mm, 0: none"}};
}

}  // namespace

Json read_labels(const fs::path& file) {
  Json labels = Json::parse(io::read_file(file), nullptr, false);
  if (labels.is_object() && labels.contains("left_out")) return labels;
  const bool good = labels.is_object() && labels.contains("annotations") &&
                    labels["annotations"].is_array() && labels.contains("image") &&
                    labels["image"].is_object() && labels["image"].value("split", "") != "" &&
                    labels["image"].contains("id");
  if (!good)
    throw InvalidFile({file.string()},
                      "is no picture's labels, expected those of this data set; without the file "
                      "its picture is made anew");
  return labels;
}

std::string identity_of(const DataSetOptions& options) {
  std::string all = world::scene_text(options.scene, options.scene.file.parent_path());
  const auto add = [&](const std::string& text) { all += "\n" + text; };
  const auto add_file = [&](const fs::path& file) {
    std::error_code none;
    if (!file.empty() && fs::is_regular_file(file, none)) add(io::read_file(file));
  };
  for (const world::ScenePlant& plant : options.scene.plants) add_file(plant.file);
  if (options.scene.robot) add_file(options.scene.robot->file);
  add(std::to_string(options.seed) + " " + options.camera);
  for (const double time : options.at) add(std::to_string(time));
  if (options.size)
    add(std::to_string((*options.size)[0]) + "x" + std::to_string((*options.size)[1]));
  return hex(noise_seed(0, all, 0));
}

io::FolderLock take_data_set_folder(const DataSetOptions& options) {
  const fs::path head = options.out / "dataset.json";
  io::check_output_folder(options.out);
  std::error_code none;
  fs::create_directories(options.out, none);
  if (none) throw io::WriteError(options.out.string() + ": cannot be made: " + none.message());
  io::FolderLock lock(options.out);
  if (fs::exists(head, none)) {
    const Json before = Json::parse(io::read_file(head), nullptr, false);
    if (!before.is_object() || before.value("identity", "") != identity_of(options))
      throw io::WriteError(options.out.string() +
                           ": holds a data set of another scene, seed or setting, expected an "
                           "empty folder or the same data set");
    remove_parts(options.out);
  } else if (fs::exists(options.out, none) && !fs::is_empty(options.out, none)) {
    throw io::WriteError(options.out.string() +
                         ": holds other files, expected an empty folder or a data set");
  }
  fs::create_directories(options.out / "labels", none);
  if (none) throw io::WriteError(options.out.string() + ": cannot be made: " + none.message());
  io::write_file_atomically(head, about(options).dump(1) + "\n");
  return lock;
}

void take_pictures(const fs::path& from, const DataSetOptions& options) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(from))
    if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(from));
  // A picture's labels say that it is whole, so they come last.
  std::ranges::stable_sort(files, {}, [](const fs::path& one) { return *one.begin() == "labels"; });
  for (const fs::path& one : files) {
    const bool of_pictures = one.has_parent_path() && *one.begin() != "annotations";
    if (of_pictures || one == "things.json") io::link_or_copy(from / one, options.out / one);
  }
}

std::string picture_name(long picture) {
  char text[32];
  std::snprintf(text, sizeof text, "%06ld", picture);
  return text;
}

fs::path labels_file(const fs::path& folder, long picture) {
  return folder / "labels" / (picture_name(picture) + ".json");
}

long write_coco(const DataSetOptions& options) {
  const Json info = {{"description", "pictures of " + options.scene.name},
                     {"version", version()},
                     {"contributor", "pedicel dataset"}};
  const auto empty = [&]() {
    return Json{{"info", info},
                {"images", Json::array()},
                {"annotations", Json::array()},
                {"categories", coco_categories()}};
  };
  std::map<std::string, Json> files = {
      {"all", empty()}, {"train", empty()}, {"val", empty()}, {"test", empty()}};
  long annotations = 0;
  for (long i = 0; i < options.count; ++i) {
    const fs::path file = labels_file(options.out, i);
    std::error_code none;
    if (!fs::exists(file, none)) continue;
    Json labels = read_labels(file);
    if (!labels.contains("image")) continue;
    for (const std::string& part :
         {std::string("all"), labels["image"]["split"].get<std::string>()})
      files.at(part)["images"].push_back(labels["image"]);
    for (Json& one : labels["annotations"]) {
      Json entry = {{"id", ++annotations}, {"image_id", labels["image"]["id"]}};
      entry.update(one);
      files.at(labels["image"]["split"].get<std::string>())["annotations"].push_back(entry);
      files.at("all")["annotations"].push_back(std::move(entry));
    }
  }
  for (const auto& [part, json] : files)
    io::write_file_atomically(options.out / "annotations" / (part + ".json"), json.dump() + "\n");
  return annotations;
}

void write_contact_sheet(const DataSetOptions& options) {
  std::vector<SheetCell> cells;
  for (long i = 0; i < options.count && std::ssize(cells) < sheet_pictures; ++i) {
    const std::string name = picture_name(i) + ".png";
    std::error_code none;
    if (!fs::exists(labels_file(options.out, i), none) ||
        !fs::exists(options.out / "images" / name, none))
      continue;
    const Json image = read_labels(labels_file(options.out, i))["image"];
    char text[96];
    std::snprintf(text, sizeof text, "%ld  %s  t = %.2f s", i,
                  image["split"].get<std::string>().c_str(), image.value("time_s", 0.0));
    cells.push_back({render::read_png(options.out / "images" / name),
                     render::read_gray_png(options.out / "instances" / name), text});
  }
  render::write_png(options.out / "contact_sheet.png",
                    contact_sheet(cells, sheet_columns, sheet_width));
}

}  // namespace pedicel::app
