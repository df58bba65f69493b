#include "discrepancy/scene_cases/scene_case.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace pedicel::scene_case {

namespace {

// rad, of the two turning joints, that put the finger's line through a point at its middle: the
// fore arm and the finger lie along one line.
Vec3 reaching(const Vec3& place, double height) {
  const double far = place.head<2>().norm(), out = fore_length + 0.6 * finger_length;
  const double c =
      std::clamp((far * far - upper_length * upper_length - out * out) / (2.0 * upper_length * out),
                 -1.0, 1.0);
  const double elbow = std::acos(c);
  const double shoulder = std::atan2(place.y(), place.x()) -
                          std::atan2(out * std::sin(elbow), upper_length + out * std::cos(elbow));
  return {shoulder, elbow, height - shoulder_height};
}

}  // namespace

void draw(Setting& s) {
  std::mt19937_64 random(s.seed * 7919 + 17);
  const auto between = [&](double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>()(random);
  };
  s.height = between(0.36, 0.46);
  s.radius = between(0.0034, 0.0044);
  s.modulus = between(3.0e8, 6.0e8);
  s.density = between(700.0, 950.0);
  s.damping_time = between(0.004, 0.009);
  s.root = {between(0.42, 0.47), between(-0.03, 0.03), 0.0};
  s.friction = between(0.6, 0.8);
}

bool is_hidden(const Setting& setting, const std::string& name) {
  return std::ranges::any_of(setting.hidden, [&](const Hidden& one) { return one.name == name; });
}

double hidden_number(const Setting& setting, const std::string& name, const std::string& parameter,
                     double otherwise, std::size_t axis) {
  for (const Hidden& one : setting.hidden)
    for (const auto& [key, values] : one.numbers)
      if (one.name == name && key == parameter && axis < values.size()) return values[axis];
  return otherwise;
}

Vec3 Drive::at(double t) const {
  if (t <= time.front()) return joints.front();
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (t > time[i]) continue;
    const double s = (t - time[i - 1]) / (time[i] - time[i - 1]);
    const double share = s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
    return joints[i - 1] + share * (joints[i] - joints[i - 1]);
  }
  return joints.back();
}

std::vector<Drive> drives_of(const Setting& s) {
  const auto beside = [&](double y, double z) { return reaching(s.root + Vec3(0.0, y, 0.0), z); };
  // m, of the finger's axis from the stem's: first it stands clear.
  const double clear = -(s.radius + finger_radius + 0.012);
  const double low = 0.55 * s.height, high = 0.75 * s.height;
  std::vector<Drive> all;
  all.push_back({"push",
                 2.4,
                 {0.2, 1.1, 1.2, 1.9},
                 {beside(clear, low), beside(0.035, low), beside(0.035, low), beside(clear, low)}});
  all.push_back(
      {"push_back",
       2.4,
       {0.2, 1.1, 1.2, 1.9},
       {beside(-clear, low), beside(-0.03, low), beside(-0.03, low), beside(-clear, low)}});
  all.push_back(
      {"push_high",
       2.4,
       {0.2, 1.1, 1.2, 1.9},
       {beside(clear, high), beside(0.045, high), beside(0.045, high), beside(clear, high)}});
  // On its way along the stem it never stands still but where it turns.
  all.push_back({"slide",
                 2.8,
                 {0.2, 1.3, 2.4},
                 {beside(clear, low), beside(0.025, low + 0.06), beside(clear, low + 0.01)}});
  all.resize(static_cast<std::size_t>(std::clamp(s.trials, 1, 4)));
  return all;
}

std::vector<std::pair<std::string, double>> markers_of(const Setting&) {
  return {{"stem", 0.3}, {"stem", 0.55}, {"stem", 0.8}, {"stem", 1.0}};
}

}  // namespace pedicel::scene_case
