#include "tests/discrepancy/hidden_effect.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pedicel::hidden {

namespace {

using plant::Effect;
using reference::OutsideEffect;
using reference::Subject;
using Numbers = std::map<std::string, std::vector<double>>;

std::vector<double> list(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

Vec3 draw_direction(Random& random) {
  Vec3 v;
  do v = Vec3(random.normal(), random.normal(), random.normal());
  while (v.norm() < 0.1);
  return v.normalized();
}

/// Fills in one effect; each family of names has its own function.
class Draw {
 public:
  Draw(const std::string& name, const Setting& setting, const Scale& scale, Random& random)
      : name_(name), setting_(setting), scale_(scale), random_(random) {
    result_.name = name;
    turn_ = random.uniform(0.0, 2 * M_PI);
    sign_ = random.integer(0, 1) ? 1.0 : -1.0;
  }

  HiddenEffect run() {
    if (!constants() && !laws() && !later() && !air() && !instruments() && !outside())
      throw std::invalid_argument("no effect is called " + name_);
    return result_;
  }

 private:
  using Values = std::function<Numbers(double)>;

  void set(double guess, double cap, Values values) { set(guess, cap, std::nullopt, values); }

  void set(double guess, double cap, std::optional<plant::CurvePlace> place, Values values) {
    result_.guess = guess;
    result_.cap = cap;
    result_.add = [name = name_, place = std::move(place), values = std::move(values)](
                      double size, Subject& subject) {
      Effect e;
      e.name = name;
      e.place = place;
      e.numbers = values(size);
      subject.effects.push_back(e);
    };
  }

  double round(double value) const { return std::round(value * 1e3) / 1e3; }

  plant::CurvePlace on_stem(double from, double to) {
    return {setting_.hold.curve, round(random_.uniform(from, to)), {}};
  }

  bool constants() {
    const double s = sign_;
    if (name_ == "youngs_modulus" || name_ == "density" || name_ == "damping_time")
      set(0.01, s < 0 ? 0.5 : 1.5, [s](double u) { return Numbers{{"factor", {1 + s * u}}}; });
    else if (name_ == "extra_mass")
      set(5e-4, 0.05, on_stem(0.4, 0.95), [](double u) { return Numbers{{"mass", {u}}}; });
    else if (name_ == "mass_distribution" || name_ == "stiffness_gradient")
      set(0.1, 1.5, [s](double u) { return Numbers{{"gradient", {s * u}}}; });
    else if (name_ == "base_compliance")
      set(0.02, 20.0, [](double u) { return Numbers{{"stiffness", {1 / u}}}; });
    else if (name_ == "attachment_compliance")
      set(0.2, 200.0, plant::CurvePlace{branch(), 0.0, {}}, [](double u) {
        return Numbers{{"stiffness", {1 / u}}};
      });
    else if (name_ == "weak_segment")
      set(0.3, 19.0, on_stem(0.3, 0.7),
          [length = round(random_.uniform(0.1, 0.2) * setting_.reach)](double u) {
            return Numbers{{"factor", {1 / (1 + u)}}, {"length", {length}}};
          });
    else if (name_ == "anisotropy")
      set(0.05, s < 0 ? 0.7 : 2.0, [s, d = across()](double u) {
        return Numbers{{"ratio", {1 + s * u}}, {"direction", list(d)}};
      });
    else
      return false;
    return true;
  }

  const std::string& branch() {
    return setting_.plant
        .curves[random_.integer(1, static_cast<int>(setting_.plant.curves.size()) - 1)]
        .name;
  }

  Vec3 across() const {
    return Vec3(round(std::cos(turn_)), round(std::sin(turn_)), 0.0).normalized();
  }

  bool laws() {
    const double most = scale_.most_curvature, settled = scale_.settled_curvature;
    if (name_ == "material_nonlinearity")
      set(0.05, sign_ < 0 ? 0.3 : 2.0, [s = sign_, most](double u) {
        return Numbers{{"coefficient", {s * u}}, {"k0", {most}}};
      });
    else if (name_ == "asymmetry")
      set(0.05, 0.9, [s = sign_, most, d = across()](double u) {
        return Numbers{{"coefficient", {s * u}}, {"axis", list(d)}, {"k0", {most}}};
      });
    else if (name_ == "mass_damping")
      set(0.05, 3.0, [](double u) { return Numbers{{"rate", {u}}}; });
    else if (name_ == "structural_damping")
      set(0.01, 0.2, [](double u) { return Numbers{{"loss_factor", {u}}}; });
    else if (name_ == "internal_friction")
      set(0.03, 0.6, [k = random_.uniform(0.08, 0.2) * most](double u) {
        return Numbers{{"curvature", {k}}, {"ratio", {u}}};
      });
    else if (name_ == "relaxation")
      memory(random_.uniform(0.15, 0.4) * scale_.longest);
    else if (name_ == "creep")
      memory(random_.uniform(3.0, 8.0) * scale_.longest);
    else if (name_ == "yield")
      set(0.3, most / std::max(1.2 * settled, 0.2 * most) - 1.0, [most](double u) {
        return Numbers{{"curvature", {most / (1 + u)}}};
      });
    else if (name_ == "stiffness_drift")
      set(0.02 / (3 * scale_.pause), 0.5 / (3 * scale_.pause), [s = sign_](double u) {
        return Numbers{{"rate", {s * u}}};
      });
    else
      return false;
    return true;
  }

  // Fills in words as well.
  void say(const std::string& name, const std::string& key, const std::string& word) {
    result_.add = [name, key, word, add = result_.add](double size, Subject& subject) {
      add(size, subject);
      subject.effects.back().name = name;
      subject.effects.back().words[key] = word;
    };
  }

  bool later() {
    if (name_ == "sensor_lag" || name_ == "force_lag") {
      set(3e-3, 0.3, [](double u) { return Numbers{{"time", {u}}}; });
      say("sensor_lag", "what", name_ == "force_lag" ? "force" : "markers");
    } else if (name_ == "hung_relaxation") {
      memory(random_.uniform(0.15, 0.4) * scale_.longest);
      say("relaxation", "start", "hung");
    } else if (name_ == "rest_shape") {
      set(0.02, 2.0 / scale_.reach, plant::CurvePlace{setting_.hold.curve, 0.5, {}},
          [a = turn_](double u) {
            return Numbers{{"curvature", {u * std::cos(a), u * std::sin(a)}},
                           {"gradient", {0.0, 0.0}},
                           {"normal", {1.0, 0.0, 0.0}}};
          });
    } else if (name_ == "plate_drag") {
      set(0.005, 0.3, [d = across()](double u) {
        return Numbers{{"normal", {u}}, {"tangential", {0.1 * u}}, {"direction", list(d)}};
      });
    } else if (name_ == "hysteresis") {
      set(0.03, 0.6,
          [m = random_.uniform(0.1, 0.4) * scale_.most_curvature * stem_stiffness()](double u) {
            return Numbers{{"moment", {m}}, {"exponent", {1.0}}, {"ratio", {u}}};
          });
    } else {
      return false;
    }
    return true;
  }

  // N m2, at the foot of the stem.
  double stem_stiffness() const {
    const plant::PlantCurve& stem =
        setting_.plant.curves[setting_.plant.curve_index(setting_.hold.curve)];
    const double modulus =
        stem.material.youngs_modulus.value_or(setting_.plant.material.youngs_modulus.value_or(0.0));
    return 0.25 * M_PI * modulus * std::pow(stem.radius.front(), 4);
  }

  void memory(double time) {
    set(0.03, 0.6, [time](double u) { return Numbers{{"fraction", {u}}, {"time", {time}}}; });
  }

  bool air() {
    const Vec3 wind = random_.uniform(0.8, 2.5) * across();
    if (name_ == "leaf_drag")
      set(0.005, 0.3, [](double u) { return Numbers{{"drag_area", {u}}}; });
    else if (name_ == "wind")
      set(0.003, 0.2, [wind](double u) {
        return Numbers{{"velocity", list(wind)}, {"drag_area", {u}}};
      });
    else if (name_ == "gust")
      set(0.003, 0.2,
          [wind, f = random_.uniform(0.4, 1.6), a = random_.uniform(0.3, 0.6)](double u) {
            return Numbers{{"velocity", list(wind)},
                           {"drag_area", {u}},
                           {"frequency", {f}},
                           {"amplitude", {a}}};
          });
    else
      return false;
    return true;
  }

  bool instruments() {
    const double s = sign_;
    if (name_ == "grip_compliance")
      set(1e-4, 0.1, [k = scale_.grip_stiffness](double u) {
        return Numbers{{"stiffness", {1 / (1 / k + u)}}};
      });
    else if (name_ == "grip_slip")
      set(2e-3, 0.1 * scale_.reach, [s, t = 0.02 * random_.integer(50, 150)](double u) {
        return Numbers{{"distance", {s * u}}, {"time", {t}}};
      });
    else if (name_ == "latency")
      set(2e-3, 0.3, [](double u) { return Numbers{{"delay", {u}}}; });
    else if (name_ == "frame_rotation")
      set(1e-3, 0.3, [d = draw_direction(random_)](double u) {
        return Numbers{{"rotation", list(u * d)}};
      });
    else if (name_ == "marker_scale")
      set(5e-4, 0.2, [s](double u) { return Numbers{{"factor", {1 + s * u}}}; });
    else if (name_ == "force_gain")
      set(5e-3, 0.8, [s, d = draw_direction(random_)](double u) {
        return Numbers{{"gain", {1 + s * u}}, {"offset", list(0.1 * u * d)}};
      });
    else if (name_ == "marker_offset")
      offset_marker();
    else if (name_ == "outliers")
      set(0.003, 0.1, [](double u) { return Numbers{{"fraction", {u}}}; });
    else
      return false;
    result_.sized = name_ != "outliers";
    return true;
  }

  void offset_marker() {
    const auto& markers = setting_.markers;
    const std::string marker =
        markers[random_.integer(1, static_cast<int>(markers.size()) - 1)].name;
    result_.guess = 5e-4;
    result_.cap = 0.05;
    result_.add = [marker, d = draw_direction(random_)](double u, Subject& subject) {
      Effect e;
      e.name = "marker_offset";
      e.words["marker"] = marker;
      e.numbers["offset"] = list(u * d);
      subject.effects.push_back(e);
    };
  }

  bool outside() {
    OutsideEffect s;
    s.place = setting_.hold;
    s.place.at = round(random_.uniform(0.5, 0.9));
    s.direction = across();
    const double reach = scale_.reach;
    result_.outside = true;
    if (name_ == "string") {  // just taut, and so slack on one side
      s.kind = OutsideEffect::Kind::string;
      s.point = scale_.held + 0.5 * reach * across();
      s.slack = 0.5 * reach - 0.005 * reach;
      result_.guess = 0.3, result_.cap = 2000;
    } else if (name_ == "stake") {  // just out of reach, and so met on one side
      s.kind = OutsideEffect::Kind::stake;
      s.place = setting_.hold;
      s.point = scale_.held - 0.01 * reach * across();
      result_.guess = 0.3, result_.cap = 2000;
    } else if (name_ == "push") {
      s.kind = OutsideEffect::Kind::push;
      s.frequency = round(random_.uniform(0.4, 2.5));
      result_.guess = 1e-3, result_.cap = 1.0;
    } else if (name_ == "attraction") {
      s.kind = OutsideEffect::Kind::attraction;
      s.point = scale_.held + 0.15 * reach * across() + Vec3(0, 0, 0.03);
      result_.guess = 5e-3, result_.cap = 1.0;
    } else {
      return false;
    }
    result_.add = [s](double u, Subject& subject) {
      subject.outside.push_back(s);
      subject.outside.back().size = u;
    };
    return true;
  }

  const std::string& name_;
  const Setting& setting_;
  const Scale& scale_;
  Random& random_;
  double turn_ = 0.0, sign_ = 1.0;
  HiddenEffect result_;
};

}  // namespace

HiddenEffect draw_effect(const std::string& name, const Setting& setting, const Scale& scale,
                         Random& random) {
  return Draw(name, setting, scale, random).run();
}

const std::vector<EffectUse>& effect_uses() {
  using enum PackKind;
  static const std::vector<EffectUse> uses = {
      {"youngs_modulus", {mix, push, weights}},
      {"density", {mix}},
      {"damping_time", {release, mix, sweep}},
      {"extra_mass", {release, mix, sweep}},
      {"mass_distribution", {release, mix, sweep}},
      {"base_compliance", {mix, release, push, weights}},
      {"attachment_compliance", {mix, release, sweep}, true},
      {"weak_segment", {mix, weights, push, release}},
      {"stiffness_gradient", {mix, weights, push, release}},
      {"material_nonlinearity", {push, mix, release, weights}},
      {"anisotropy", {release, weights, mix, push}},
      {"mass_damping", {sweep, release, mix}},
      {"structural_damping", {sweep, release, mix}},
      {"internal_friction", {push, mix, release}, false, true},
      {"relaxation", {push, mix, weights}},
      {"creep", {push, weights, mix}},
      {"yield", {push, mix, release}, false, true},
      {"stiffness_drift", {mix, push, weights, release}},
      {"wind", {release, mix}},
      {"gust", {mix, release, push}},
      {"leaf_drag", {release, mix, sweep}},
      {"grip_compliance", {push, mix, release}},
      {"grip_slip", {push}},
      {"latency", {release, sweep, mix}},
      {"marker_offset", {mix, weights, release, push}},
      {"frame_rotation", {mix, weights, push}},
      {"marker_scale", {mix, release, push}},
      {"force_gain", {push, mix}},
      {"outliers", {release, mix, push}},
  };
  return uses;
}

const std::vector<EffectUse>& later_uses() {
  using enum PackKind;
  static const std::vector<EffectUse> uses = {
      {"asymmetry", {push, mix, release, weights}},
      {"sensor_lag", {sweep, release, mix}},
      {"force_lag", {push, mix}},
      {"hung_relaxation", {mix, weights, push}, true},
      {"rest_shape", {mix, weights, release, push}},
      {"plate_drag", {release, mix, sweep}},
      {"hysteresis", {push, mix, release}},
  };
  return uses;
}

const std::vector<EffectUse>& outside_uses() {
  using enum PackKind;
  static const std::vector<EffectUse> uses = {
      {"string", {release, mix, push}},
      {"stake", {release, push}},
      {"push", {release, weights, mix}},
      {"attraction", {release, mix, push}},
  };
  return uses;
}

const std::vector<RecordUse>& record_uses() {
  using enum PackKind;
  static const std::vector<RecordUse> uses = {
      {moving, ""},
      {pusher, ""},
      {plate, ""},
      {planar, ""},
      {rest, ""},
      {moving, "damping_time"},
      {pusher, "base_compliance"},
      {plate, "extra_mass"},
      {planar, "sensor_lag"},
      {rest, "weak_segment"},
      {moving, "extra_mass"},
      {pusher, "force_lag"},
      {plate, "hung_relaxation", true},
      {planar, "latency"},
      {rest, "rest_shape"},
      {moving, ""},
      {pusher, ""},
      {plate, ""},
      {planar, ""},
      {rest, ""},
      {moving, "leaf_drag"},
      {pusher, "hung_relaxation", true},
      {plate, "leaf_drag"},
      {planar, "base_compliance"},
      {rest, "base_compliance"},
      {moving, "weak_segment"},
      {pusher, "latency"},
      {plate, "rest_shape"},
      {moving, "base_compliance"},
      {pusher, "weak_segment"},
      {plate, "youngs_modulus"},
      {moving, "youngs_modulus"},
  };
  return uses;
}

}  // namespace pedicel::hidden
