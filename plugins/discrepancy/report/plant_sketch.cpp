#include "plugins/discrepancy/report/plant_sketch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/io/csv.h"
#include "engine/plots/svg_canvas.h"
#include "plugins/discrepancy/data/places.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

using plots::SvgCanvas;

constexpr int width = 400, most_height = 460, least_height = 240;
constexpr double margin = 56.0, foot = 44.0;  // px
constexpr int pieces = 40;                    // of a curve
constexpr double font = 12.0;

struct LabelBox {
  double left, top, right, bottom;
  bool meets(const LabelBox& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};

class Sketch {
 public:
  Sketch(const Experiment& experiment, const std::vector<SketchMark>& marks)
      : experiment_(experiment), marks_(marks) {
    for (const plant::PlantCurve& curve : experiment.plant().curves) {
      lines_.emplace_back();
      for (int i = 0; i <= pieces; ++i)
        lines_.back().push_back(drawn_point(curve, static_cast<double>(i) / pieces));
    }
    choose_side();
    choose_scale();
  }

  std::string svg() && {
    SvgCanvas canvas(width, height_,
                     "The plant from the side, with its markers and what was found");
    ground(canvas);
    for (const SketchMark& mark : marks_) broad_parts(canvas, mark);
    for (std::size_t c = 0; c < lines_.size(); ++c) {
      const plant::PlantCurve& curve = experiment_.plant().curves[c];
      const double radius = curve.radius.empty() ? 0.0 : curve.radius.front();
      polyline(canvas, lines_[c], "#57606a", std::clamp(2.0 * radius * scale_, 2.0, 9.0), 1.0);
    }
    markers(canvas);
    for (const SketchMark& mark : marks_) rings(canvas, mark);
    labels(canvas);
    scale_bar(canvas);
    return std::move(canvas).finished();
  }

 private:
  // The azimuth that spreads the plant most, or shows the marks' directions.
  void choose_side() {
    double best = -1.0;
    for (int i = 0; i < 24; ++i) {
      const double angle = i * std::numbers::pi / 24.0;
      const Vec3 u(std::cos(angle), std::sin(angle), 0.0);
      double low = 1e300, high = -1e300, height = 1e-9;
      for (const auto& line : lines_)
        for (const Vec3& p : line) {
          low = std::min(low, p.dot(u));
          high = std::max(high, p.dot(u));
          height = std::max(height, std::abs(p.z() - experiment_.plant().root.z()));
        }
      double score = (high - low) / std::max(height, high - low);
      for (const SketchMark& mark : marks_)
        if (mark.direction) score += std::abs(mark.direction->dot(u));
      if (score <= best + 1e-9) continue;
      best = score;
      side_ = u;
    }
  }

  void choose_scale() {
    double left = 1e300, right = -1e300, low = 1e300, high = -1e300;
    for (const auto& line : lines_)
      for (const Vec3& p : line) {
        left = std::min(left, p.dot(side_)), right = std::max(right, p.dot(side_));
        low = std::min(low, p.z()), high = std::max(high, p.z());
      }
    const double across = std::max(right - left, 1e-3), up = std::max(high - low, 1e-3);
    scale_ = std::min((width - 2.0 * margin) / across, (most_height - margin - foot) / up);
    height_ = std::clamp(static_cast<int>(scale_ * up + margin + foot), least_height, most_height);
    middle_ = 0.5 * (left + right);
    base_ = low;
    bottom_ = 0.5 * (height_ - margin - foot - scale_ * up);
  }

  double x(const Vec3& p) const { return 0.5 * width + scale_ * (p.dot(side_) - middle_); }
  double y(const Vec3& p) const { return height_ - foot - bottom_ - scale_ * (p.z() - base_); }

  std::optional<Vec3> point(const plant::CurvePlace& place) const {
    const int c = experiment_.plant().curve_index(place.curve);
    if (c < 0) return std::nullopt;
    return drawn_point(experiment_.plant().curves[c], place.at);
  }

  void polyline(SvgCanvas& canvas, const std::vector<Vec3>& line, const std::string& colour,
                double thick, double opacity) const {
    std::string points;
    for (const Vec3& p : line)
      points += SvgCanvas::number(x(p)) + "," + SvgCanvas::number(y(p)) + " ";
    canvas.element("<polyline fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"" +
                   SvgCanvas::number(thick) + "\" stroke-opacity=\"" + SvgCanvas::number(opacity) +
                   "\" stroke-linecap=\"round\" stroke-linejoin=\"round\" points=\"" + points +
                   "\"/>\n");
  }

  // Where the plant is clamped.
  void ground(SvgCanvas& canvas) {
    const double px = x(experiment_.plant().root), py = y(experiment_.plant().root);
    canvas.line(px - 26, py, px + 26, py, "stroke=\"#1f2328\" stroke-width=\"2\"");
    for (int i = -2; i <= 2; ++i)
      canvas.line(px + 10 * i, py, px + 10 * i - 6, py + 7, "stroke=\"#1f2328\"");
    taken_.push_back({px - 32, py - 3, px + 26, py + 8});
  }

  void broad_parts(SvgCanvas& canvas, const SketchMark& mark) const {
    if (mark.whole_plant)
      for (const auto& line : lines_) polyline(canvas, line, mark.colour, 12.0, 0.3);
    if (!mark.stretch) return;
    const auto& [from, to] = *mark.stretch;
    const int c = experiment_.plant().curve_index(from.curve);
    if (c < 0) return;
    std::vector<Vec3> part;
    for (int i = 0; i <= pieces; ++i)
      part.push_back(
          drawn_point(experiment_.plant().curves[c], from.at + (to - from.at) * i / pieces));
    polyline(canvas, part, mark.colour, 13.0, 0.5);
  }

  void circle(SvgCanvas& canvas, const Vec3& p, double radius, const std::string& style) {
    canvas.element("<circle cx=\"" + SvgCanvas::number(x(p)) + "\" cy=\"" +
                   SvgCanvas::number(y(p)) + "\" r=\"" + SvgCanvas::number(radius) + "\" " + style +
                   "/>\n");
    taken_.push_back({x(p) - radius - 1, y(p) - radius - 1, x(p) + radius + 1, y(p) + radius + 1});
  }

  void markers(SvgCanvas& canvas) {
    for (const Marker& marker : experiment_.markers) {
      const auto p = point(marker.place);
      if (!p) continue;
      circle(canvas, *p, 3.6, "fill=\"#1b6ca8\" stroke=\"#ffffff\"");
      wanted_.push_back({*p, marker.name, "#1b6ca8", 4.0, false});
    }
  }

  void rings(SvgCanvas& canvas, const SketchMark& mark) {
    const std::string style = "fill=\"none\" stroke=\"" + mark.colour + "\" stroke-width=\"3\"";
    if (mark.markers)
      for (const Marker& marker : experiment_.markers)
        if (const auto p = point(marker.place)) circle(canvas, *p, 7.0, style);
    bool first = true;
    for (const plant::CurvePlace& place : mark.places) {
      const auto p = point(place);
      if (!p) continue;
      circle(canvas, *p, 11.0, style);
      if (first) wanted_.insert(wanted_.begin(), {*p, mark.label, mark.colour, 13.0, true});
      first = false;
    }
  }

  // Each text goes to the first side of its point where it covers nothing; names of markers that
  // find no room are left out, marks take the least bad side.
  void labels(SvgCanvas& canvas) {
    std::vector<LabelBox> curves;
    for (const auto& line : lines_)
      for (const Vec3& p : line) curves.push_back({x(p) - 1.5, y(p) - 1.5, x(p) + 1.5, y(p) + 1.5});
    for (const Wanted& w : wanted_) {
      const double tw = SvgCanvas::text_width(w.text, font) * (w.bold ? 1.1 : 1.0), px = x(w.point),
                   py = y(w.point), gap = w.gap + 4;
      const std::pair<double, double> corners[] = {{px + gap, py - 7},
                                                   {px - gap - tw, py - 7},
                                                   {px + gap, py - 22},
                                                   {px - gap - tw, py - 22},
                                                   {px + gap, py + 8},
                                                   {px - gap - tw, py + 8},
                                                   {px - 0.5 * tw, py - gap - 15},
                                                   {px - 0.5 * tw, py + gap}};
      double best_cost = 1e300;
      LabelBox best{};
      for (const auto& [left, top] : corners) {
        const double moved = std::clamp(left, 4.0, std::max(4.0, width - 4.0 - tw));
        const LabelBox box{moved, top, moved + tw, top + 15};
        double cost = box.top < 2 || box.bottom > height_ - 2 ? 1000.0 : 0.0;
        for (const LabelBox& other : taken_) cost += box.meets(other) ? 100.0 : 0.0;
        for (const LabelBox& other : curves) cost += box.meets(other) ? 3.0 : 0.0;
        if (cost >= best_cost) continue;
        best_cost = cost;
        best = box;
      }
      if (best_cost >= 100.0 && !w.bold) continue;
      taken_.push_back(best);
      canvas.text(best.left, best.bottom - 3, w.text,
                  "font-size=\"12\" fill=\"" + w.colour + "\"" +
                      (w.bold ? " font-weight=\"600\"" : "") +
                      " stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"");
    }
    // What has no place of its own is said in the corner.
    double top = 20;
    for (const SketchMark& mark : marks_) {
      if (!mark.places.empty()) continue;
      canvas.text(12, top, mark.label,
                  "font-size=\"12\" font-weight=\"600\" fill=\"" + mark.colour + "\"");
      top += 17;
    }
  }

  void scale_bar(SvgCanvas& canvas) const {
    double length = std::pow(10.0, std::floor(std::log10(110.0 / scale_)));
    for (const double factor : {5.0, 2.0})
      if (factor * length * scale_ <= 110.0) {
        length *= factor;
        break;
      }
    const double py = height_ - 12.0;
    canvas.line(12, py, 12 + length * scale_, py, "stroke=\"#1f2328\" stroke-width=\"2\"");
    canvas.text(18 + length * scale_, py + 4, io::format_number(length, 3) + " m",
                "font-size=\"12\" fill=\"#3d444d\"");
  }

  struct Wanted {
    Vec3 point;
    std::string text, colour;
    double gap;
    bool bold;
  };

  const Experiment& experiment_;
  const std::vector<SketchMark>& marks_;
  std::vector<std::vector<Vec3>> lines_;
  std::vector<LabelBox> taken_;
  std::vector<Wanted> wanted_;
  Vec3 side_ = Vec3::UnitX();
  double scale_ = 1.0, middle_ = 0.0, base_ = 0.0, bottom_ = 0.0;
  int height_ = most_height;
};

plant::CurvePlace root_place(const Experiment& experiment) {
  for (const MarkerChain& chain : chains_of(experiment)) {
    if (!chain.rooted) continue;
    const plant::PlantCurve& curve = experiment.plant().curves[chain.curve];
    const bool first = (curve.points.front() - chain.foot).norm() < 1e-12;
    return {curve.name, first ? 0.0 : 1.0, {}};
  }
  return {experiment.plant().curves.front().name, 0.0, {}};
}

double first_value(const NamedCause& cause, const std::string& parameter) {
  const auto found = cause.parameters.find(parameter);
  return found == cause.parameters.end() || found->second.empty() ? 0.0
                                                                  : found->second.front().value;
}

}  // namespace

SketchMark mark_of(const Experiment& experiment, const NamedCause& cause,
                   const std::string& colour) {
  SketchMark mark;
  mark.label = cause.name;
  mark.colour = colour;
  const effects::EffectDefinition* known = effects::find_effect(cause.name);
  const auto is = [&](effects::Home home) { return known && known->home == home; };
  if (is(effects::Home::base)) {
    mark.places = {root_place(experiment)};
  } else if (known && known->family == effects::Family::grip) {
    for (const Trial& trial : experiment.trials)
      if (!trial.holds.empty() && mark.places.empty()) mark.places = {trial.holds.front().place};
  } else if (cause.words.contains("marker")) {
    for (const Marker& marker : experiment.markers)
      if (marker.name == cause.words.at("marker")) mark.places = {marker.place};
  } else if (is(effects::Home::sensor)) {
    mark.markers = true;
    mark.label += " (all markers)";
  } else if (cause.where) {
    mark.places = {*cause.where};
    const int c = experiment.plant().curve_index(cause.where->curve);
    const double length = first_value(cause, "length");
    if (c >= 0 && length > 0.0) {
      const double half = 0.5 * length / drawn_length(experiment.plant().curves[c]);
      plant::CurvePlace from = *cause.where;
      from.at = std::max(0.0, cause.where->at - half);
      mark.stretch = {from, std::min(1.0, cause.where->at + half)};
    }
  } else {
    mark.whole_plant = true;
    mark.label += " (the whole plant)";
  }
  for (const char* parameter : {"velocity", "direction"}) {
    const auto found = cause.parameters.find(parameter);
    if (found == cause.parameters.end() || found->second.size() != 3) continue;
    const Vec3 d(found->second[0].value, found->second[1].value, 0.0);
    if (d.norm() > 0.0) mark.direction = d.normalized();
  }
  return mark;
}

std::string plant_sketch(const Experiment& experiment, const std::vector<SketchMark>& marks) {
  return Sketch(experiment, marks).svg();
}

}  // namespace pedicel::discrepancy
