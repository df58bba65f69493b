#pragma once

#include "plugins/cosserat/model/joint_law.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::effects {

// What relaxation and creep share: a part of the moment that decays.

inline std::vector<EffectParameter> decaying_parameters() {
  return {{.name = "fraction",
           .bounds = io::fraction,
           .sentence = "of the moment that decays",
           .vanishes = Vanishes::at_zero,
           .first = {0.2}},
          {.name = "time",
           .unit = "s",
           .bounds = io::positive,
           .sentence = "in which it decays",
           .role = Role::shape,
           .first = {10.0}},
          {.name = "start",
           .sentence = "from which shape it is counted; hung: it had relaxed before, under gravity",
           .size = 0,
           .required = false,
           .otherwise = "`settled`",
           .offered = false,
           .words = {"settled", "unloaded", "hung"},
           .role = Role::shape}};
}

/// What `start` says.
inline cosserat::RelaxationStart relaxation_start(const plant::Effect& effect) {
  const auto start = effect.words.find("start");
  if (start == effect.words.end()) return cosserat::RelaxationStart::settled;
  if (start->second == "hung") return cosserat::RelaxationStart::hung;
  return start->second == "unloaded" ? cosserat::RelaxationStart::unloaded
                                     : cosserat::RelaxationStart::settled;
}

/// The fraction by which the plant is stiffer swinging than at rest (%): at rest it has decayed.
inline double decayed_by_stiffness(double percent, const StartContext&) {
  return 1.0 - 1.0 / (1.0 + 0.01 * percent);
}

/// The fraction by the part of the force that goes by where the drive was (%): what has decayed is
/// missing there.
inline double decayed_by_history(double percent, const StartContext&) {
  return -0.01 * percent;
}

inline void add_decaying_moment(ModelTarget& t) {
  const cosserat::RelaxationStart start = relaxation_start(t.effect);
  t.each_law([&](int, cosserat::JointLaw& law) {
    cosserat::add_relaxation(law, t.number("fraction"), t.number("time"), start);
  });
}

}  // namespace pedicel::effects
