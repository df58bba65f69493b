#include "plugins/discrepancy/import/picture_camera.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"
#include "engine/io/number_text.h"
#include "engine/io/yaml.h"

namespace pedicel::discrepancy {

namespace {

/// Brown's model: where a lens shows what a pinhole would show at `x` (over the focal length).
Eigen::Vector2d distorted(const Eigen::Vector2d& x, const std::array<double, 5>& d) {
  const double r2 = x.squaredNorm();
  const double radial = 1.0 + r2 * (d[0] + r2 * (d[1] + r2 * d[4]));
  const double xy = 2.0 * x.x() * x.y();
  return {x.x() * radial + d[2] * xy + d[3] * (r2 + 2.0 * x.x() * x.x()),
          x.y() * radial + d[2] * (r2 + 2.0 * x.y() * x.y()) + d[3] * xy};
}

Eigen::Vector2d pair_of(io::YamlMap& map, const std::string& key, const io::Bounds& bounds) {
  const auto node = map.required(key);
  if (!node) return {1.0, 1.0};
  const std::vector<double> numbers = node->numbers(key, bounds);
  if (numbers.size() == 2) return Eigen::Vector2d(numbers.data());
  if (node->is_list() && !node->diagnostics().has_errors())
    node->error(key + " has " + std::to_string(numbers.size()) + " numbers, expected [x, y]");
  return {1.0, 1.0};
}

}  // namespace

// The distortion is undone by going back by what it still adds, which converges for any lens whose
// picture does not fold.
std::optional<Vec3> PictureCamera::ray(const Eigen::Vector2d& pixel) const {
  constexpr int most_steps = 100;
  constexpr double accuracy = 1.0e-10;
  const Eigen::Vector2d shown = (pixel - centre).cwiseQuotient(focal);
  Eigen::Vector2d x = shown;
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::Vector2d left = shown - distorted(x, distortion);
    x += left;
    if (!x.allFinite()) return std::nullopt;
    if (left.norm() < accuracy) return pose.rotation * Vec3(x.x(), x.y(), 1.0).normalized();
  }
  return std::nullopt;
}

std::optional<PictureCamera> read_picture_camera(const std::filesystem::path& file,
                                                 Diagnostics& diagnostics) {
  const int before = diagnostics.error_count();
  const io::YamlNode node = io::load_yaml(file, diagnostics);
  io::YamlMap map(node, "a camera");
  if (!node.is_map()) return std::nullopt;
  PictureCamera camera;
  map.text("name", "");
  if (const auto position = map.required("position"))
    camera.pose.position = position->vector("position");
  if (const auto orientation = map.required("orientation"))
    camera.pose.rotation = orientation->quaternion("orientation");
  camera.focal = pair_of(map, "focal", io::positive);
  camera.centre = pair_of(map, "centre", io::any_number);
  if (const auto size = map.optional("size")) size->numbers("size", io::positive);
  if (const auto distortion = map.optional("distortion")) {
    const std::vector<double> numbers = distortion->numbers("distortion");
    if (numbers.size() != camera.distortion.size())
      distortion->error("distortion has " + std::to_string(numbers.size()) +
                        " numbers, expected [k1, k2, p1, p2, k3]");
    else
      std::ranges::copy(numbers, camera.distortion.begin());
  }
  map.finish();
  if (diagnostics.error_count() > before) return std::nullopt;
  return camera;
}

std::optional<Vec3> PicturePlane::meets(const Vec3& eye, const Vec3& ray) const {
  constexpr double grazing = 1.0e-6;  // of the ray's length
  if (std::abs(ray[axis]) < grazing) return std::nullopt;
  const double distance = (offset - eye[axis]) / ray[axis];
  if (!(distance > 0.0)) return std::nullopt;
  return eye + distance * ray;
}

PicturePlane plane_of_text(std::string_view text, const std::string& option) {
  if (text.size() > 2 && text[0] >= 'x' && text[0] <= 'z' && text[1] == '=') {
    const io::NumberText offset = io::number_of(text.substr(2));
    if (offset.kind == io::NumberText::Kind::number) return {text[0] - 'x', offset.value};
  }
  throw UsageError(option + " " + in_quotes(text) +
                   ": expected a plane of the world across one axis, in m (y=0.02)");
}

}  // namespace pedicel::discrepancy
