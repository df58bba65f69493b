#include "tests/discrepancy/cause_size.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace pedicel::hidden {

namespace {

using discrepancy::Estimate;
using discrepancy::NamedCause;
using Numbers = std::map<std::string, std::vector<double>>;
using Size = std::vector<double>;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();

// The parameters that make up the size of a cause.
std::vector<std::string> parts_of(const std::string& cause) {
  static const std::map<std::string, std::vector<std::string>> parts = {
      {"youngs_modulus", {"factor"}},
      {"density", {"factor"}},
      {"damping_time", {"factor"}},
      {"extra_mass", {"mass"}},
      {"mass_distribution", {"gradient"}},
      {"base_compliance", {"stiffness"}},
      {"attachment_compliance", {"stiffness"}},
      {"weak_segment", {"factor", "length"}},
      {"stiffness_gradient", {"gradient"}},
      {"material_nonlinearity", {"coefficient", "k0"}},
      {"anisotropy", {"ratio"}},
      {"asymmetry", {"coefficient", "k0"}},
      {"mass_damping", {"rate"}},
      {"structural_damping", {"loss_factor"}},
      {"internal_friction", {"ratio", "curvature"}},
      {"relaxation", {"fraction"}},
      {"creep", {"fraction", "time"}},
      {"yield", {"curvature"}},
      {"stiffness_drift", {"rate"}},
      {"wind", {"drag_area", "velocity"}},
      {"gust", {"drag_area", "velocity"}},
      {"leaf_drag", {"drag_area"}},
      {"grip_compliance", {"stiffness"}},
      {"grip_slip", {"distance"}},
      {"latency", {"delay"}},
      {"marker_offset", {"offset"}},
      {"frame_rotation", {"rotation"}},
      {"marker_scale", {"factor"}},
      {"force_gain", {"gain"}},
      {"outliers", {"fraction"}}};
  const auto found = parts.find(cause);
  return found == parts.end() ? std::vector<std::string>{} : found->second;
}

Size size_of(const std::string& cause, const Numbers& numbers, double grip_stiffness) {
  const std::vector<std::string> parts = parts_of(cause);
  const Size& first = numbers.at(parts.front());
  const double x = first.front();
  const double y = parts.size() > 1 ? numbers.at(parts[1]).front() : 1.0;
  if (cause == "weak_segment") return {(1.0 / x - 1.0) * y};
  if (parts.front() == "factor" || parts.front() == "gain") return {x - 1.0};
  if (cause == "asymmetry") return {std::abs(x) / y};
  if (cause == "anisotropy") return {std::abs(std::log(x))};
  if (cause == "material_nonlinearity") return {x / (y * y)};
  if (cause == "internal_friction") return {x * y};
  if (cause == "creep") return {x / y};
  if (cause == "grip_compliance") return {1.0 / x - 1.0 / grip_stiffness};
  if (parts.back() == "velocity") {
    double square = 0.0;
    for (const double v : numbers.at("velocity")) square += v * v;
    return {x * square};
  }
  return first;
}

// The least and the largest size at any corner of the parameters' intervals.
class Corners {
 public:
  Corners(const NamedCause& said, double grip_stiffness)
      : said_(said), grip_stiffness_(grip_stiffness) {
    for (const std::string& part : parts_of(said.name))
      for (std::size_t i = 0; i < said.parameters.at(part).size(); ++i) open_.push_back({part, i});
    Numbers numbers;
    for (const auto& [name, entries] : said.parameters)
      for (const Estimate& entry : entries) numbers[name].push_back(entry.value);
    value = size_of(said.name, numbers, grip_stiffness);
    low = high = value;
    visit(numbers, 0);
  }
  Size value, low, high;

 private:
  void visit(Numbers numbers, std::size_t depth) {
    if (depth == open_.size()) return meet(size_of(said_.name, numbers, grip_stiffness_));
    const auto& [name, i] = open_[depth];
    const Estimate& entry = said_.parameters.at(name)[i];
    for (const double x : {entry.low, entry.value, entry.high}) {
      numbers[name][i] = x;
      visit(numbers, depth + 1);
    }
  }
  void meet(const Size& size) {
    for (std::size_t i = 0; i < size.size(); ++i) {
      if (std::isnan(size[i])) continue;  // 0 times an open end
      low[i] = std::min(low[i], size[i]);
      high[i] = std::max(high[i], size[i]);
    }
  }

  const NamedCause& said_;
  double grip_stiffness_;
  std::vector<std::pair<std::string, std::size_t>> open_;
};

double place_error(const plant::Effect& truth, const NamedCause& said) {
  if (!truth.place || !said.where || truth.place->curve != said.where->curve) return none;
  return std::abs(truth.place->at - said.where->at);
}

}  // namespace

SizeError size_error(const plant::Effect& truth, const NamedCause& said, double grip_stiffness) {
  SizeError result{said.name, none, 0, 0, place_error(truth, said)};
  const std::vector<std::string> parts = parts_of(truth.name);
  const bool comparable = truth.name == said.name && !parts.empty() &&
                          std::ranges::all_of(parts, [&](const std::string& part) {
                            return truth.numbers.contains(part) && said.parameters.contains(part) &&
                                   truth.numbers.at(part).size() == said.parameters.at(part).size();
                          });
  if (!comparable) return result;
  const Size wanted = size_of(truth.name, truth.numbers, grip_stiffness);
  const Corners found(said, grip_stiffness);
  double off = 0.0, whole = 0.0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    off += std::pow(found.value[i] - wanted[i], 2);
    whole += wanted[i] * wanted[i];
    if (found.low[i] <= wanted[i] && wanted[i] <= found.high[i]) ++result.inside;
    ++result.entries;
  }
  result.error = whole > 0.0 ? std::sqrt(off / whole) : endless;
  return result;
}

}  // namespace pedicel::hidden
