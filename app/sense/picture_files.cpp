#include "app/sense/picture_files.h"

#include <algorithm>
#include <cstring>

#include "app/sense/point_cloud.h"
#include "engine/io/atomic_file.h"

namespace pedicel::app {

namespace {

using world::Sensor;

Json numbers(const Eigen::VectorXd& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(value);
  return list;
}

Json rows_of(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r)
    rows.push_back(numbers(matrix.row(r).transpose()));
  return rows;
}

}  // namespace

Json camera_json(const CameraMatrices& camera) {
  return {{"width", camera.width},
          {"height", camera.height},
          {"fx", camera.intrinsic(0, 0)},
          {"fy", camera.intrinsic(1, 1)},
          {"cx", camera.intrinsic(0, 2)},
          {"cy", camera.intrinsic(1, 2)},
          {"intrinsic", rows_of(camera.intrinsic)},
          {"extrinsic", rows_of(camera.extrinsic)},
          {"position", numbers(camera.pose.position)},
          {"orientation", numbers(camera.pose.rotation.coeffs())}};
}

Json things_json(const NamedThings& things) {
  Json list = Json::array();
  for (std::size_t i = 0; i < things.all().size(); ++i) {
    const NamedThing& one = things.all()[i];
    Json entry = {{"id", i},
                  {"name", one.name},
                  {"class", std::string(name_of(one.kind))},
                  {"class_id", static_cast<int>(one.kind)}};
    if (!one.plant.empty()) entry["plant"] = one.plant;
    list.push_back(std::move(entry));
  }
  return list;
}

Json keypoints_json(const SensedPicture& picture, const NamedThings& things) {
  Json list = Json::array();
  for (const Keypoint& one : picture.keypoints) {
    if (one.visibility == Keypoint::Visibility::outside) continue;
    list.push_back({{"id", one.thing},
                    {"organ", things.of(one.thing).name},
                    {"name", std::string(name_of(one.kind))},
                    {"x", one.u},
                    {"y", one.v},
                    {"depth_m", one.depth},
                    {"v", static_cast<int>(one.visibility)}});
  }
  return list;
}

std::string depth_npy(const render::LabelMap& map) {
  std::string head = "{'descr': '<f4', 'fortran_order': False, 'shape': (" +
                     std::to_string(map.height) + ", " + std::to_string(map.width) + "), }";
  // The head ends at a multiple of 64 bytes, with a line's end.
  constexpr std::size_t before = 10;
  head.append(63 - (before + head.size()) % 64, ' ');
  head += '\n';
  std::string text("\x93NUMPY\x01\x00", 8);
  text += static_cast<char>(head.size() & 255u);
  text += static_cast<char>(head.size() >> 8);
  text += head;
  text.append(reinterpret_cast<const char*>(map.depth.data()), 4 * map.depth.size());
  return text;
}

std::string file_end_of(Sensor sensor) {
  if (sensor == Sensor::keypoints) return "json";
  return std::string(name_of(sensor)) + (sensor == Sensor::points ? ".ply" : ".png");
}

std::vector<std::filesystem::path> write_sensors(const std::filesystem::path& folder,
                                                 const std::string& name,
                                                 const SensedPicture& picture,
                                                 const NamedThings& things,
                                                 const std::vector<Sensor>& wanted) {
  std::vector<std::filesystem::path> files;
  const auto file = [&](const std::string& end) {
    return files.emplace_back(folder / (name + "." + end));
  };
  const auto wants = [&](Sensor one) { return std::ranges::count(wanted, one) > 0; };
  const render::LabelMap& map = picture.map;
  if (wants(Sensor::rgb)) render::write_png(file("rgb.png"), picture.image);
  if (wants(Sensor::depth)) {
    render::write_png(file("depth.png"), depth_millimetres(map.depth, map.width, map.height));
    io::write_file_atomically(file("depth.npy"), depth_npy(map));
  }
  if (wants(Sensor::instances)) render::write_png(file("instances.png"), instance_mask(map));
  if (wants(Sensor::classes)) render::write_png(file("classes.png"), class_mask(map, things), 8);
  if (wants(Sensor::points))
    io::write_file_atomically(file("points.ply"), to_ply(point_cloud_of(picture)));
  Json json = {{"time_s", picture.time}, {"camera", camera_json(picture.camera)}};
  if (wants(Sensor::keypoints)) json["keypoints"] = keypoints_json(picture, things);
  io::write_file_atomically(file("json"), json.dump(1) + "\n");
  return files;
}

}  // namespace pedicel::app
