#pragma once

#include "plugins/discrepancy/fit/parameter_fit.h"
#include "plugins/discrepancy/fit/parameter_request.h"
#include "plugins/discrepancy/scene_predict/scene_simulator.h"

namespace pedicel::discrepancy {

/// Effects that an experiment with a robot can be fitted with: those of its contact, arm and
/// instruments, and those of its plants. A word such as `joint` or `plant` says which one is meant;
/// without it the one that fits best is taken.
FitVocabulary scene_vocabulary(const Experiment& experiment);

/// An experiment with a robot, with the noise of the instruments and of the predictions
/// (widen_noise()). Throws InvalidFile where a plant cannot be built.
std::unique_ptr<FitGround> scene_ground(const Experiment& experiment, int threads,
                                        const std::atomic<bool>* stop,
                                        const SceneNumerics& numerics = {});

}  // namespace pedicel::discrepancy
