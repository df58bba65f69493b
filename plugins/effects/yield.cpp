#include <string>
#include <string_view>

#include "plugins/cosserat/laws/joint_terms.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// Bending that stays: a slider that carries all that is elastic, from the unloaded shape on. It
// slips as internal_friction-inl.h says.
EffectDefinition define_yield() {
  EffectDefinition d;
  d.name = "yield";
  d.plain_name = "bending that stays (yield)";
  d.sentence = "perfectly plastic bending beyond a curvature";
  d.home = Home::joint;
  d.family = Family::nonlinearity;
  d.parameters = {{.name = "curvature",
                   .unit = "1/m",
                   .bounds = io::positive,
                   .sentence = "at which permanent set begins",
                   .vanishes = Vanishes::at_infinity,
                   .first = {10.0}}};
  d.change = ModelChange{
      // Last of all: it makes a slider of what is elastic when all others have taken their shares.
      Stage::last, [](ModelTarget& t) {
        bool twice = false;
        std::string_view beside;  // a law that is elastic, too, and would have nothing left
        t.each_law([&](int e, cosserat::JointLaw& law) {
          // By the solver's own list of formulas. What is nonlinear and elastic would be inside the
          // slider, whose law is that of a linear spring.
          for (const laws::JointTerm& term : laws::joint_terms)
            if (law.terms_there() & term.bit) beside = term.effect;
          for (const cosserat::JointBranch& branch : law.branches) twice = twice || branch.plastic;
          // Nothing elastic is left: all of it is in sliders and dashpots already.
          if (!beside.empty() || twice || law.elastic + law.deviation < 1.0e-6) return;
          // By a curvature and not by a moment: a strain of the outer fibres is what a material
          // bears, and it goes with the curvature.
          cosserat::add_yield(law, t.softer_bending(e) * t.number("curvature") * t.joint_length(e));
        });
        // Two sliders that carry all of the moment are the one that slips first.
        if (twice) t.error("yield twice on one curve, expected it once");
        if (!beside.empty())
          t.error("yield and " + std::string(beside) + " on one curve, expected one of them");
      }};
  d.starts = [](const StartContext& c) {
    std::vector<Start> starts;
    // Near the largest curvature of the trials a threshold soon does nothing, or much.
    const double k = c.scales.curvature;
    // Densely, in steps of a fifth: a threshold has no slope where nothing yields.
    for (double part = 0.3; part < 3.5; part *= 1.2)
      starts.push_back(Start("yield").positive("curvature", part * k, 1e-2 * k, 20 * k));
    return starts;
  };
  d.speaks_for = {{"loop_area", 3}, {"clock_trend", 3}};
  // Friction and creep go on with each load, a plastic set does not.
  d.tells_apart = "repeat the largest load: no further set follows a set that has settled";
  d.has_threshold = true;
  return d;
}

}  // namespace pedicel::effects
