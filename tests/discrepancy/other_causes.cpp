#include "tests/discrepancy/other_causes.h"

#include <algorithm>
#include <cmath>

namespace pedicel::hidden {

namespace {

using plant::Effect;
using Numbers = std::map<std::string, std::vector<double>>;
using Ways = std::vector<std::vector<Effect>>;

Effect effect(const std::string& name, Numbers numbers,
              std::optional<plant::CurvePlace> place = {}) {
  Effect e;
  e.name = name;
  e.numbers = std::move(numbers);
  e.place = std::move(place);
  return e;
}

double length_of(const plant::PlantCurve& curve) {
  double length = 0.0;
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    length += (curve.points[i] - curve.points[i - 1]).norm();
  return length;
}

/// The list, one family of causes after the other. Sizes are small enough for the data to change in
/// proportion; thresholds lie where some bends pass them.
class List {
 public:
  List(const Setting& setting, const Scale& scale) : setting_(setting), scale_(scale) {
    masses();
    softness();
    laws();
    air();
    instruments();
  }

  std::vector<OtherCause> take() { return std::move(causes_); }

 private:
  void add(const std::string& name, Ways ways) { causes_.push_back({name, std::move(ways)}); }

  void one(const std::string& name, Numbers numbers) { add(name, {{effect(name, numbers)}}); }

  const std::vector<plant::PlantCurve>& curves() const { return setting_.plant.curves; }

  bool is_stem(const plant::PlantCurve& curve) const { return &curve == &curves().front(); }

  void masses() {
    Ways hung;
    for (const plant::PlantCurve& curve : curves())
      for (const double at :
           is_stem(curve) ? std::vector{0.2, 0.4, 0.6, 0.8, 1.0} : std::vector{0.5, 1.0})
        hung.push_back(
            {effect("extra_mass", {{"mass", {1e-3}}}, plant::CurvePlace{curve.name, at, {}})});
    add("extra_mass", hung);
    one("mass_distribution", {{"gradient", {0.1}}});
  }

  void softness() {
    one("base_compliance", {{"stiffness", {50.0}}});
    one("stiffness_gradient", {{"gradient", {0.1}}});
    Ways weak, junctions;
    for (const plant::PlantCurve& curve : curves()) {
      const auto stretch = [&](double length, double at) {
        weak.push_back({effect("weak_segment", {{"factor", {0.8}}, {"length", {length}}},
                               plant::CurvePlace{curve.name, at, {}})});
      };
      for (const double share : {0.01, 0.05, 0.15}) {
        const double length = share * setting_.reach;
        stretch(length, 0.5 * length / length_of(curve));  // at its foot
        if (share < 0.05) continue;
        for (const double at : is_stem(curve) ? std::vector{0.2, 0.4, 0.6, 0.8} : std::vector{0.5})
          stretch(length, at);
      }
      if (!is_stem(curve))
        junctions.push_back({effect("attachment_compliance", {{"stiffness", {5.0}}},
                                    plant::CurvePlace{curve.name, 0.0, {}})});
    }
    add("weak_segment", weak);
    if (!junctions.empty()) add("attachment_compliance", junctions);
    const auto softer = [](const Vec3& d) {
      return effect("anisotropy", {{"ratio", {1.03}}, {"direction", {d.x(), d.y(), d.z()}}});
    };
    // Turned by 45 degrees: the two of which all directions across a stem are mixed.
    add("anisotropy", {{softer({1, 0, 0}), softer({M_SQRT1_2, M_SQRT1_2, 0})}});
  }

  void laws() {
    const double most = scale_.most_curvature;
    one("material_nonlinearity", {{"coefficient", {0.05}}, {"k0", {most}}});
    one("mass_damping", {{"rate", {0.05}}});
    one("structural_damping", {{"loss_factor", {0.01}}});
    one("stiffness_drift", {{"rate", {0.01 / (3 * scale_.pause)}}});
    Ways friction, yield;
    for (const double share : {0.08, 0.25})
      friction.push_back(
          {effect("internal_friction", {{"curvature", {share * most}}, {"ratio", {0.03}}})});
    for (const double share : {0.85, 0.6})
      yield.push_back({effect("yield", {{"curvature", {share * most}}})});
    add("internal_friction", friction);
    add("yield", yield);
    const auto memory = [&](const char* name, std::initializer_list<double> shares) {
      Ways ways;
      for (const double share : shares)
        ways.push_back({effect(name, {{"fraction", {0.03}}, {"time", {share * scale_.longest}}})});
      add(name, ways);
    };
    memory("relaxation", {0.02, 0.1, 0.3, 1.0});
    memory("creep", {1.0, 4.0});
  }

  void air() {
    one("leaf_drag", {{"drag_area", {0.005}}});
    const auto blow = [](const Vec3& v, Numbers more) {
      more["velocity"] = {v.x(), v.y(), v.z()};
      more["drag_area"] = {0.003};
      return more;
    };
    const Vec3 x(1.5, 0, 0), y(0, 1.5, 0);
    add("wind", {{effect("wind", blow(x, {})), effect("wind", blow(y, {}))}});
    Ways gusts;
    for (const double f : {0.5, 1.2}) {
      const Numbers swell{{"frequency", {f}}, {"amplitude", {0.5}}};
      gusts.push_back({effect("gust", blow(x, swell)), effect("gust", blow(y, swell))});
    }
    add("gust", gusts);
  }

  void instruments() {
    one("grip_compliance", {{"stiffness", {1 / (1 / scale_.grip_stiffness + 1e-4)}}});
    one("latency", {{"delay", {2e-3}}});
    one("marker_scale", {{"factor", {1.0005}}});
    Ways slips;
    for (const double t : {1.0, 2.0, 3.0})
      slips.push_back({effect("grip_slip", {{"distance", {2e-3}}, {"time", {t}}})});
    add("grip_slip", slips);
    Effect lag = effect("sensor_lag", {{"time", {3e-3}}});
    Ways lags;
    for (const char* what : {"markers", "force"}) {
      lag.words["what"] = what;
      lags.push_back({lag});
    }
    add("sensor_lag", lags);
    add("frame_rotation", {axes("frame_rotation", "rotation", 1e-3, {})});
    std::vector<Effect> sensor = axes("force_gain", "offset", 1e-3, {{"gain", {1.0}}});
    sensor.push_back(effect("force_gain", {{"gain", {1.005}}, {"offset", {0, 0, 0}}}));
    add("force_gain", {sensor});
  }

  // One effect along each axis.
  static std::vector<Effect> axes(const char* name, const char* key, double size,
                                  const Numbers& more) {
    std::vector<Effect> list;
    for (int k = 0; k < 3; ++k) {
      const Vec3 v = size * Vec3::Unit(k);
      Numbers numbers = more;
      numbers[key] = {v.x(), v.y(), v.z()};
      list.push_back(effect(name, numbers));
    }
    return list;
  }

  const Setting& setting_;
  const Scale& scale_;
  std::vector<OtherCause> causes_;
};

// (special case, what has it).
bool contains(const std::string& cause, const std::string& special) {
  return (special == "leaf_drag" && (cause == "wind" || cause == "gust")) ||
         (special == "wind" && cause == "gust");
}

}  // namespace

std::vector<OtherCause> other_causes(const std::string& truth, const Setting& setting,
                                     const Scale& scale) {
  std::vector<OtherCause> causes = List(setting, scale).take();
  const std::string name = truth == "force_lag"         ? "sensor_lag"
                           : truth == "hung_relaxation" ? "relaxation"
                                                        : truth;
  std::erase_if(causes, [&](const OtherCause& cause) {
    return cause.name == name || contains(cause.name, name);
  });
  return causes;
}

std::vector<plant::Effect> soft_junctions(const plant::PlantFile& plant) {
  std::vector<plant::Effect> list;
  for (std::size_t c = 1; c < plant.curves.size(); ++c) {
    const plant::PlantCurve& curve = plant.curves[c];
    const double r = curve.radius.front(), inertia = M_PI * r * r * r * r / 4.0;
    const double modulus =
        curve.material.youngs_modulus.value_or(plant.material.youngs_modulus.value());
    list.push_back(effect("attachment_compliance",
                          {{"stiffness", {4.0 * modulus * inertia / plant.distance}}},
                          plant::CurvePlace{curve.name, 0.0, {}}));
  }
  return list;
}

}  // namespace pedicel::hidden
