#include "plant/apply_effects.h"

#include <algorithm>
#include <cmath>

#include "cosserat/turn_frame.h"
#include "plant/apply_laws.h"
#include "plant/effects.h"

namespace pedicel::plant {

namespace {

using cosserat::Element;

/// One effect on one model.
class Change {
 public:
  Change(const PlantFile& plant, BuiltPlant& built, const Effect& effect)
      : plant_(plant), built_(built), model_(built.model), effect_(effect) {}

  void run() {
    const std::string& name = effect_.name;
    if (name == "youngs_modulus") scale_stiffness();
    if (name == "density") scale_mass([&](const BuiltPlant::Span&) { return number("factor"); });
    if (name == "damping_time")
      for (Element& element : model_.elements) element.damping_time *= number("factor");
    if (name == "mass_damping")
      for (Element& element : model_.elements) element.mass_damping += number("rate");
    if (name == "extra_mass") add_mass();
    if (name == "mass_distribution")
      scale_mass([&](const BuiltPlant::Span& span) { return along(span, number("gradient")); });
    if (name == "stiffness_gradient") grade_stiffness();
    if (name == "weak_segment") weaken();
    if (name == "base_compliance") soften(roots());
    if (name == "attachment_compliance") soften({attachment()});
    if (name == "anisotropy") make_anisotropic();
    if (name == "detachment_law") replace_thresholds();
  }

 private:
  double number(const char* parameter) const { return effect_.number(parameter); }

  void scale_stiffness() {
    for (Element& element : model_.elements) {
      element.stretch_stiffness *= number("factor");
      element.bend_stiffness *= number("factor");
    }
  }

  // 1 + gradient (s/L - 1/2) at the middle of a span, s along its curve as drawn.
  double along(const BuiltPlant::Span& span, double gradient) const {
    const double s = 0.5 * (span.arc_near + span.arc_far) / built_.curve_lengths[span.curve];
    return 1.0 + gradient * (s - 0.5);
  }

  // The same at a span's joint, which stands for half a segment on either side of it; a clamp's
  // stands for the first half of its own segment.
  double at_joint(const BuiltPlant::Span& span, double gradient) const {
    const bool clamped = model_.elements[span.element].parent < 0;
    const double share = clamped ? 0.25 : 0.0;
    const double arc = (1.0 - share) * span.arc_near + share * span.arc_far;
    return 1.0 + gradient * (arc / built_.curve_lengths[span.curve] - 0.5);
  }

  bool concerns(const BuiltPlant::Span& span) const {
    return !effect_.place || plant_.curve_index(effect_.place->curve) == span.curve;
  }

  template <class Factor>
  void scale_mass(const Factor& factor) {
    for (const BuiltPlant::Span& span : built_.spans) {
      if (!concerns(span)) continue;
      cosserat::Section& s = model_.elements[span.element].section;
      const double f = factor(span);
      for (double* value : {&s.mass, &s.inertia1, &s.inertia2, &s.inertia3}) *value *= f;
      cosserat::lump_inertia(model_, span.element);
    }
  }

  void grade_stiffness() {
    for (const BuiltPlant::Span& span : built_.spans) {
      if (!concerns(span)) continue;
      model_.elements[span.element].stretch_stiffness *= along(span, number("gradient"));
      model_.elements[span.element].bend_stiffness *= at_joint(span, number("gradient"));
    }
  }

  // A joint whose half segments reach into the weak stretch has their share of its compliance
  // raised.
  void weaken() {
    const int curve = plant_.curve_index(effect_.place->curve);
    const double centre = effect_.place->at * built_.curve_lengths[curve];
    const double half = 0.5 * number("length");
    for (const BuiltPlant::Span& span : built_.spans) {
      if (span.curve != curve) continue;
      const double low = std::min(span.arc_near, span.arc_far);
      const double length = std::abs(span.arc_far - span.arc_near);
      // The joint at the near end stands for half a segment on either side of it.
      const double from = span.arc_near - 0.5 * length, to = span.arc_near + 0.5 * length;
      const double shared = std::max(
          0.0, std::min({to, centre + half, low + length}) - std::max(from, centre - half));
      const double share = std::min(1.0, shared / length);
      model_.elements[span.element].bend_stiffness /= 1.0 - share + share / number("factor");
    }
  }

  // Of every fruit, or of those on one curve.
  void replace_thresholds() {
    cosserat::DetachmentLaw law;
    const auto set = [&](double& scale, const char* parameter) {
      if (effect_.numbers.contains(parameter)) scale = number(parameter);
    };
    set(law.force, "force");
    set(law.moment, "moment");
    set(law.torsion, "torsion");
    if (effect_.numbers.contains("exponents")) {
      const std::vector<double>& e = effect_.numbers.at("exponents");
      law.exponents = {e[0], e[1], e[2]};
    }
    for (std::size_t f = 0; f < model_.fruits.size(); ++f)
      if (!effect_.place || plant_.fruits[f].place.curve == effect_.place->curve)
        model_.fruits[f].law = law;
  }

  void make_anisotropic() {
    const std::vector<double>& d = effect_.numbers.at("direction");
    for (const BuiltPlant::Span& span : built_.spans)
      if (concerns(span))
        cosserat::make_anisotropic(model_, span.element, number("ratio"), Vec3(d[0], d[1], d[2]));
  }

  void add_mass() {
    const PlacedPoint place =
        built_.locate(plant_.curve_index(effect_.place->curve), effect_.place->at);
    model_.masses.push_back({place.element, place.back, number("mass"), 0.0});
    cosserat::lump_inertia(model_, place.element);
  }

  std::vector<int> roots() const {
    std::vector<int> elements;
    for (int e = 0; e < model_.size(); ++e)
      if (model_.elements[e].parent < 0) elements.push_back(e);
    return elements;
  }

  // The first element of the branch: the joint at its junction.
  int attachment() const {
    const int curve = plant_.curve_index(effect_.place->curve);
    for (const BuiltPlant::Span& span : built_.spans)
      if (span.curve == curve) return span.element;
    return 0;
  }

  // A spring in series with a joint's two bending springs.
  void soften(const std::vector<int>& elements) {
    for (const int e : elements)
      for (int axis = 0; axis < 2; ++axis) {
        double& k = model_.elements[e].bend_stiffness[axis];
        k = 1.0 / (1.0 / k + 1.0 / number("stiffness"));
      }
  }

  const PlantFile& plant_;
  BuiltPlant& built_;
  cosserat::RodModel& model_;
  const Effect& effect_;
};

}  // namespace

void apply_effects(const PlantFile& plant, BuiltPlant& built, Diagnostics& diagnostics) {
  const auto run = [&](bool anisotropy) {
    for (const Effect& effect : plant.effects)
      if (!is_law(effect.name) && (effect.name == "anisotropy") == anisotropy)
        Change(plant, built, effect).run();
  };
  for (const Effect& effect : plant.effects) {
    const EffectKind* kind = find_effect(effect.name);
    if (kind && kind->simulated) continue;
    diagnostics.error(effect.where,
                      "effect \"" + effect.name +
                          "\" is known but cannot be simulated yet, expected one that can");
  }
  if (diagnostics.has_errors()) return;
  run(true);
  run(false);
  for (const Effect& effect : plant.effects)
    if (is_law(effect.name)) apply_law(plant, effect, built, diagnostics);
  finish_laws(plant, built, diagnostics);
}

}  // namespace pedicel::plant
