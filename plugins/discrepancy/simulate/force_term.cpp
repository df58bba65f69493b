#include "plugins/discrepancy/simulate/force_term.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <map>
#include <numbers>
#include <stdexcept>

namespace pedicel::discrepancy {

namespace {

constexpr double tiny = 1.0e-9;  // m or m/s, below which a direction means nothing

using Law = std::function<Vec3(double, const Vec3&, const Vec3&)>;

Vec3 vector(const plant::Effect& force, const char* name) {
  return Vec3(force.numbers.at(name).data());
}

Vec3 anchor_of(const plant::Effect& force) {
  return vector(force, "about") + force.number("distance") * direction_of(force);
}

Law law_of_place(const plant::Effect& force) {
  const std::string& kind = kind_of(force);
  if (kind == "stop") {
    const double k = force.number("stiffness"), offset = force.number("offset");
    return [=, n = direction_of(force), about = vector(force, "about")](double, const Vec3& x,
                                                                        const Vec3&) -> Vec3 {
      return k * std::max(0.0, -n.dot(x - about) - offset) * n;
    };
  }
  const Vec3 anchor = anchor_of(force);
  if (kind == "spring")
    return [=, k = force.number("stiffness")](double, const Vec3& x, const Vec3&) -> Vec3 {
      return k * (anchor - x);
    };
  if (kind == "attraction")
    return [=, size = force.number("size"), d = force.number("range")](double, const Vec3& x,
                                                                       const Vec3&) -> Vec3 {
      const Vec3 away = anchor - x;
      const double r2 = away.squaredNorm();
      return size * d * d / (d * d + r2) / std::max(std::sqrt(r2), tiny) * away;
    };
  const double k = force.number("stiffness");
  const double slack = force.number("distance") + force.number("offset");
  return [=](double, const Vec3& x, const Vec3&) -> Vec3 {
    const Vec3 away = anchor - x;
    const double r = away.norm();
    return k * std::max(0.0, r - slack) / std::max(r, tiny) * away;
  };
}

Law law_of_time(const plant::Effect& force) {
  const std::string& kind = kind_of(force);
  if (kind == "periodic")
    return [w = 2 * std::numbers::pi * force.number("frequency"), sine = vector(force, "sine"),
            cosine = vector(force, "cosine")](double t, const Vec3&, const Vec3&) -> Vec3 {
      return std::sin(w * t) * sine + std::cos(w * t) * cosine;
    };
  const Vec3 push = vector(force, "force");
  if (kind == "constant") return [=](double, const Vec3&, const Vec3&) { return push; };
  const double time = force.number("time");
  if (kind == "onset")
    return [=](double t, const Vec3&, const Vec3&) -> Vec3 {
      return t >= time ? push : Vec3(Vec3::Zero());
    };
  return [=, length = force.number("length")](double t, const Vec3&, const Vec3&) -> Vec3 {
    return std::max(0.0, 1.0 - std::abs(t - time) / length) * push;
  };
}

Law law_of_velocity(const plant::Effect& force) {
  const std::string& kind = kind_of(force);
  if (kind == "friction")
    return
        [size = force.number("size"), speed = force.number("speed")](
            double, const Vec3&, const Vec3& v) -> Vec3 { return -size / (v.norm() + speed) * v; };
  const bool quadratic = kind == "quadratic_drag";
  return [rate = force.number("rate"), quadratic](double, const Vec3&, const Vec3& v) -> Vec3 {
    return -rate * (quadratic ? v.norm() : 1.0) * v;
  };
}

/// Frees the numbers of a force one after the other.
class Freeing {
 public:
  explicit Freeing(const plant::Effect& force) { made_.effects = {force}; }

  void positive(const char* name, double range, const char* unit,
                Vanishes vanishes = Vanishes::never) {
    if (!has(name)) return;
    const double value = made_.effects[0].number(name);
    add({0, name, 0, true, 1.0, value / range, value * range, unit, 0.0, 0.0, vanishes});
  }
  void number(const char* name, double scale, double reach, const char* unit, int components = 1) {
    if (!has(name)) return;
    for (int c = 0; c < components; ++c) {
      const double value = made_.effects[0].numbers.at(name)[c];
      add({0, name, c, false, scale, value - reach, value + reach, unit});
    }
  }
  // Along the stem a push does next to nothing: a wide prior keeps that component in place.
  void push(const char* name) {
    if (!has(name)) return;
    const double size = std::max(vector(made_.effects[0], name).norm(), tiny);
    for (int c = 0; c < 3; ++c)
      add({0, name, c, false, size, -10 * size, 10 * size, "N", 2.0,
           made_.effects[0].numbers.at(name)[c], Vanishes::at_zero});
  }
  // Where the data leave it open, somewhere in the middle of the upper part.
  void place() {
    FreeParameter at{0, "at", 0, false, 0.1, 0.02, 1.0, "1", 2.5, 0.6};
    if (made_.effects[0].place) add(at);
  }
  Hypothesis take() { return std::move(made_); }

 private:
  bool has(const char* name) const { return made_.effects[0].numbers.contains(name); }
  void add(FreeParameter parameter) { made_.free.push_back(std::move(parameter)); }

  Hypothesis made_;
};

std::string format(const char* form, ...) {
  char text[240];
  va_list values;
  va_start(values, form);
  std::vsnprintf(text, sizeof text, form, values);
  va_end(values);
  return text;
}

std::string point_text(const Vec3& p) {
  return format("(%.3g, %.3g, %.3g) m", p.x(), p.y(), p.z());
}

std::string direction_text(const Vec3& d) {
  return format("(%.2f, %.2f, %.2f)", d.x(), d.y(), d.z());
}

std::string push_text(const plant::Effect& force, const char* name) {
  const Vec3 push = vector(force, name);
  return format("%.3g N along ", push.norm()) + direction_text(push / std::max(push.norm(), tiny));
}

}  // namespace

const std::string& kind_of(const plant::Effect& force) {
  return force.words.at("kind");
}

void across(const Vec3& direction, Vec3& first, Vec3& second) {
  const Vec3 n = direction.normalized();
  first = n.cross(std::abs(n.z()) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0)).normalized();
  second = n.cross(first);
}

Vec3 direction_of(const plant::Effect& force) {
  const Vec3 n = vector(force, "towards").normalized();
  const std::vector<double>& tilt = force.numbers.at("tilt");
  Vec3 first, second;
  across(n, first, second);
  if (force.numbers.contains("axis")) {
    first = vector(force, "axis").cross(n).normalized();
    second = n.cross(first);
  }
  return (n + tilt[0] * first + tilt[1] * second).normalized();
}

PointForce point_force(const plant::Effect& force) {
  const std::string& kind = kind_of(force);
  PointForce result;
  result.place = force.place.value();
  if (const auto trial = force.words.find("trial"); trial != force.words.end())
    result.trial = trial->second;
  if (force.numbers.contains("about"))
    result.law = law_of_place(force);
  else if (kind == "drag" || kind == "quadratic_drag" || kind == "friction")
    result.law = law_of_velocity(force);
  else
    result.law = law_of_time(force);
  return result;
}

Hypothesis free_force(const plant::Effect& force, double size, double duration) {
  Freeing freeing(force);
  freeing.positive("stiffness", 300.0, "N/m", Vanishes::at_zero);
  freeing.positive("size", 300.0, "N", Vanishes::at_zero);
  freeing.positive("rate", 300.0, "N s/m", Vanishes::at_zero);
  freeing.push("force");
  freeing.push("sine");
  freeing.push("cosine");
  // What touches a stem pushes across it.
  freeing.number("tilt", 0.3, 2.0, "1", kind_of(force) == "stop" ? 1 : 2);
  freeing.number("offset", size, 10.0 * size, "m");
  freeing.positive("distance", 4.0, "m");
  freeing.positive("range", 2.0, "m");
  freeing.number("frequency", 1.0 / duration, 1.0 / duration, "Hz");
  freeing.place();
  Hypothesis made = freeing.take();
  made.name = missing_force;
  return made;
}

void scale_force(plant::Effect& force, double factor) {
  for (const char* name : {"stiffness", "size", "rate", "force", "sine", "cosine"})
    if (const auto found = force.numbers.find(name); found != force.numbers.end())
      for (double& x : found->second) x *= factor;
}

std::string plain_kind(const plant::Effect& force) {
  static const std::map<std::string, std::string> names = {
      {"constant", "constant push"},
      {"spring", "attraction to a point"},
      {"attraction", "attraction to a point"},
      {"string", "string"},
      {"stop", "stop"},
      {"periodic", "periodic push"},
      {"drag", "drag at a point"},
      {"quadratic_drag", "drag at a point"},
      {"friction", "friction at a point"},
      {"jolt", "jolt"},
      {"onset", "push that begins during a trial"}};
  return names.at(kind_of(force));
}

std::string describe(const plant::Effect& force) {
  const std::string& kind = kind_of(force);
  if (kind == "stop") {
    const Vec3 n = direction_of(force);
    return format("a stop of %.3g N/m pushes along ", force.number("stiffness")) +
           direction_text(n) + " where the plant goes beyond " +
           point_text(vector(force, "about") - force.number("offset") * n);
  }
  if (kind == "string")
    return format("a string of %.3g N/m pulls towards ", force.number("stiffness")) +
           point_text(anchor_of(force)) +
           format(" beyond %.3g m from there", force.number("distance") + force.number("offset"));
  if (kind == "spring")
    return format("a pull of %.3g N a metre of distance towards ", force.number("stiffness")) +
           point_text(anchor_of(force));
  if (kind == "attraction")
    return format("a pull of up to %.3g N, weaker with distance over %.3g m, towards ",
                  force.number("size"), force.number("range")) +
           point_text(anchor_of(force));
  if (kind == "periodic") {
    const bool sine = vector(force, "sine").norm() > vector(force, "cosine").norm();
    const double size = std::hypot(vector(force, "sine").norm(), vector(force, "cosine").norm());
    const Vec3 along = vector(force, sine ? "sine" : "cosine");
    return format("a push of %.3g N at %.3g Hz along ", size, force.number("frequency")) +
           direction_text(along / std::max(along.norm(), tiny));
  }
  if (kind == "drag") return format("a drag of %.3g N s/m", force.number("rate"));
  if (kind == "quadratic_drag") return format("a drag of %.3g N s2/m2", force.number("rate"));
  if (kind == "friction") return format("a friction of %.3g N", force.number("size"));
  if (kind == "jolt")
    return "a jolt of " + push_text(force, "force") +
           format(" at %.3g s in trial \"", force.number("time")) + force.words.at("trial") + "\"";
  if (kind == "onset")
    return "a push of " + push_text(force, "force") +
           format(" from %.3g s on in trial \"", force.number("time")) + force.words.at("trial") +
           "\"";
  return "a constant push of " + push_text(force, "force");
}

}  // namespace pedicel::discrepancy
