#pragma once

#include <string>
#include <vector>

#include "tests/discrepancy/case_setting.h"

namespace pedicel::hidden {

/// One thing that can be hidden, as a function of one size: nothing at size 0, more with more.
struct HiddenEffect {
  /// Of an effect, or string, stake, push, attraction; force_lag and hung_relaxation are kinds of
  /// sensor_lag and relaxation.
  std::string name;
  double guess = 0.0;    ///< a first size to try
  double cap = 0.0;      ///< the largest that makes sense
  bool outside = false;  ///< no effect stands for it
  bool sized = true;     ///< false: its size is not found by its change of the data (outliers)
  std::function<void(double size, reference::Subject& subject)> add;
};

/// What the data of the nominal plant say about sizes that depend on the plant and on the trials.
struct Scale {
  double most_curvature = 0.0;     ///< 1/m, of any joint in any trial
  double settled_curvature = 0.0;  ///< 1/m, before anything is done
  double grip_stiffness = 150.0;   ///< N/m, as the drives state it
  double longest = 5.0;            ///< s, of the trials
  double pause = 0.0;              ///< s between the beginnings of two trials
  Vec3 held = Vec3::Zero();        ///< m, W, where the held point settles
  double reach = 0.5;              ///< m
};

/// Places, directions, times and signs are drawn; the size is left open.
HiddenEffect draw_effect(const std::string& name, const Setting& setting, const Scale& scale,
                         Random& random);

/// The names that draw_effect() knows, and the packs in which each leaves a trace.
struct EffectUse {
  std::string name;
  std::vector<PackKind> packs;
  bool needs_branch = false;
  bool needs_slender = false;  ///< not on a plant that its own weight bends much
};
const std::vector<EffectUse>& effect_uses();
/// Effects that came later: their cases stand behind all others, whose numbers stay.
const std::vector<EffectUse>& later_uses();
const std::vector<EffectUse>& outside_uses();

/// Records as people make them: a pack, and what is hidden there, or nothing. Their cases stand
/// behind those of later_uses().
struct RecordUse {
  PackKind pack = PackKind::moving;
  std::string name;  ///< empty: nothing is hidden
  bool needs_branch = false;
};
const std::vector<RecordUse>& record_uses();

}  // namespace pedicel::hidden
