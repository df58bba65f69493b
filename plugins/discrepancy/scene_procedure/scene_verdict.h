#pragma once

#include "pedicel/discrepancy/scene_fit/scene_search.h"
#include "pedicel/discrepancy/select/verdict.h"

namespace pedicel::discrepancy {

/// What a search of a scene found, as verdict.json says it.
Verdict verdict_of(const SceneFindings& findings, const SceneExperiment& experiment);

/// One sentence for people.
std::string scene_headline(const Verdict& verdict);

}  // namespace pedicel::discrepancy
