#include "tests/discrepancy/scene_cases/scene_case.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <stdexcept>

#include "tests/discrepancy/scene_cases/harvest_case.h"

namespace pedicel::scene_case {

Vec3 reaching(const Vec3& place, double height, double along) {
  const double far = place.head<2>().norm(), out = fore_length + along * finger_length;
  const double c =
      std::clamp((far * far - upper_length * upper_length - out * out) / (2.0 * upper_length * out),
                 -1.0, 1.0);
  const double elbow = std::acos(c);
  const double shoulder = std::atan2(place.y(), place.x()) -
                          std::atan2(out * std::sin(elbow), upper_length + out * std::cos(elbow));
  return {shoulder, elbow, height - shoulder_height};
}

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

Hidden hidden_of(const std::string& text) {
  Hidden one;
  std::istringstream words(text);
  words >> one.name;
  for (std::string word; words >> word;) {
    const std::size_t cut = word.find('=');
    if (cut == std::string::npos) throw std::invalid_argument("--hide: expected KEY=VALUE");
    std::vector<double> values;
    std::istringstream list(word.substr(cut + 1));
    for (std::string value; std::getline(list, value, ',');) values.push_back(std::stod(value));
    one.numbers.emplace_back(word.substr(0, cut), values);
  }
  return one;
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

std::size_t Run::step(double t) const {
  return std::min(joints.size() - 1, static_cast<std::size_t>(std::max(0.0, std::round(t / dt))));
}

namespace {

// Over half a sample to either side.
template <class Row>
Row mean_of(const Run& run, const std::vector<Row>& rows, double t, double rate) {
  Row sum = Row::Zero();
  const std::size_t first = run.step(t - 0.5 / rate), last = run.step(t + 0.5 / rate);
  for (std::size_t k = first; k <= last; ++k) sum += rows[k];
  return sum / static_cast<double>(last - first + 1);
}

}  // namespace

Eigen::Matrix<double, 6, 1> Run::mean_wrench(double t, double rate) const {
  return mean_of(*this, wrench, t, rate);
}

Vec3 Run::mean_effort(double t, double rate) const {
  return mean_of(*this, efforts, t, rate);
}

std::vector<Drive> drives_of(const Setting& s) {
  if (s.truss) return harvest_drives(s);
  const auto beside = [&](double y, double z) { return reaching(s.root + Vec3(0.0, y, 0.0), z); };
  // m, of the finger's axis from the stem's: first it stands clear, wherever a stem that only the
  // robot feels may stand.
  const double clear = -(s.radius + finger_radius + (s.unseen ? 0.03 : 0.012));
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

std::vector<Place> markers_of(const Setting& s) {
  std::vector<Place> all = {{"stem", 0.3}, {"stem", 0.55}, {"stem", 0.8}, {"stem", 1.0}};
  if (s.truss) all.emplace_back("truss", 0.5);
  return all;
}

std::vector<Place> points_of(const Setting& s) {
  std::vector<Place> all;
  if (!s.truss) return all;
  for (int i = 1; i <= 10; ++i) all.emplace_back("stem", 0.1 * i);
  for (int i = 1; i <= 4; ++i) all.emplace_back("truss", 0.2 * i);
  return all;
}

}  // namespace pedicel::scene_case
