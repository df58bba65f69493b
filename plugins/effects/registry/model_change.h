#pragma once

#include "engine/core/diagnostics.h"
#include "plugins/cosserat/model/rod_model.h"
#include "plugins/plant/model/rod_places.h"

namespace pedicel::effects {

/// One effect on one model.
struct ModelTarget {
  const plant::PlantFile& plant;
  const plant::Effect& effect;
  cosserat::RodModel& model;
  const plant::RodPlaces& places;
  Diagnostics& diagnostics;

  double number(const char* parameter) const { return effect.number(parameter); }
  bool has(const char* parameter) const { return effect.numbers.contains(parameter); }
  Vec3 vector(const char* parameter) const { return Vec3(effect.numbers.at(parameter).data()); }
  void error(const std::string& text) const { diagnostics.error(effect.where, text); }

  /// Whether the effect is about a span: of every curve, or of the one that `where` names.
  bool concerns(const plant::RodPlaces::Span& span) const {
    return !effect.place || plant.curve_index(effect.place->curve) == span.curve;
  }
  template <class Task>
  void each_span(const Task& task) const {
    for (const plant::RodPlaces::Span& span : places.spans)
      if (concerns(span)) task(span);
  }

  /// m, the length that a joint's bend is spread over: half of each segment that it lies between,
  /// or half of the first at a clamp.
  double joint_length(int element) const;
  /// N m/rad, of a joint's two bending axes.
  double softer_bending(int element) const;
  /// 1 + gradient (s/L - 1/2) at the middle of a span, s along its curve as drawn.
  double along(const plant::RodPlaces::Span& span, double gradient) const;
  /// The same at a span's joint, which stands for half a segment on either side of it; a clamp's
  /// stands for the first half of its own segment.
  double along_at_joint(const plant::RodPlaces::Span& span, double gradient) const;
  /// Multiplies mass and inertia of the spans.
  template <class Factor>
  void scale_mass(const Factor& factor) {
    each_span([&](const plant::RodPlaces::Span& span) {
      cosserat::Section& s = model.elements[span.element].section;
      const double f = factor(span);
      for (double* value : {&s.mass, &s.inertia1, &s.inertia2, &s.inertia3}) *value *= f;
      cosserat::lump_inertia(model, span.element);
    });
  }
  /// Puts a spring (N m/rad) in series with a joint's two bending springs.
  void soften(int element, double stiffness);
  /// Adds to the law of each joint; elements of leaves have none.
  template <class Task>
  void each_law(const Task& task) {
    model.laws.resize(model.elements.size());
    each_span(
        [&](const plant::RodPlaces::Span& span) { task(span.element, model.laws[span.element]); });
  }
  /// Adds to the air of each segment.
  template <class Task>
  void each_air(const Task& task) {
    model.air.resize(model.elements.size());
    each_span([&](const plant::RodPlaces::Span& span) { task(model.air[span.element]); });
  }
};

/// When a change is made: what turns frames first, then the other constants in the order of the
/// file, then the laws, which refer to final constants; what makes plastic what is elastic last.
enum class Stage { frames, constants, laws, last };

struct ModelChange {
  Stage stage = Stage::constants;
  void (*apply)(ModelTarget&) = nullptr;
};

/// Changes a finished model as effects say. The rest shape stays that of the plant without effects.
/// What does not go together is an error; effects that are not of a plant's model are, too.
void apply_effects(const plant::PlantFile& plant, const std::vector<plant::Effect>& effects,
                   cosserat::RodModel& model, const plant::RodPlaces& places,
                   Diagnostics& diagnostics);

}  // namespace pedicel::effects
