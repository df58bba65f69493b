#include <string>
#include <string_view>

#include "plugins/cosserat/laws/joint_terms.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// A root that is loose in its clamp. The formula is in clamp_play-inl.h. It takes the root's spring
// away, so it comes last, and no other law may carry moment there.
EffectDefinition define_clamp_play() {
  EffectDefinition d;
  d.name = "clamp_play";
  d.plain_name = "a root that is loose in its clamp";
  d.sentence =
      "the root bends freely up to an angle, and with its stiffness beyond; its damping stays";
  d.home = Home::base;
  d.family = Family::softness;
  d.parameters = {{.name = "angle",
                   .unit = "rad",
                   .bounds = io::not_negative,
                   // To either side, so the whole play is twice that.
                   .sentence = "from the unloaded shape, from which on the root bears a moment",
                   .vanishes = Vanishes::at_zero,
                   .first = {0.02}}};
  // After all laws, to see which others are there.
  d.change = ModelChange{Stage::last, [](ModelTarget& t) {
                           const double angle = t.number("angle");
                           // A joint with a law takes other kernels. No play must keep the bits of
                           // no effect.
                           if (angle == 0.0) return;
                           std::string_view beside;
                           t.model.laws.resize(t.model.elements.size());
                           for (int e = 0; e < t.model.size(); ++e) {
                             if (t.model.elements[e].parent >= 0) continue;
                             cosserat::JointLaw& law = t.model.laws[e];
                             // By the solver's list of all formulas: a new law is
                             // refused here without a line of its own.
                             for (const laws::JointTerm& term : laws::joint_terms)
                               if (law.terms_there() & term.bit) beside = term.effect;
                             // Sliders and dashpots carry moment within the play, and the root
                             // would not be free there.
                             if (!law.branches.empty()) beside = "a law with a memory";
                             law.term("clamp_play") = angle;
                           }
                           if (!beside.empty())
                             t.error("clamp_play and " + std::string(beside) +
                                     " at one root, expected one of them there");
                         }};
  d.starts = [](const StartContext&) {
    std::vector<Start> starts;
    for (const double angle : {0.01, 0.05})
      starts.push_back(Start("clamp_play").positive("angle", angle, 1e-5, 0.5));
    return starts;
  };
  // Upright stems fall to either side of their play: which one no prediction says.
  d.is_candidate = false;
  d.tells_apart = "push the stem to and fro by little at the root: play gives way without a force";
  // A play far below the bends of the trials does nothing that could be seen.
  d.has_threshold = true;
  return d;
}

}  // namespace pedicel::effects
