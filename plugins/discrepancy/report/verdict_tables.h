#pragma once

#include "engine/io/html_report.h"
#include "plugins/discrepancy/select/verdict.h"

namespace pedicel::discrepancy {

// Parts of a card that a verdict alone fills, of plants and of scenes.

/// Whatever was accepted: what the data show, and which causes would make it.
void add_symptom_numbers(io::HtmlReport& page, const Verdict& v);
/// Causes, details and what came closest, with sizes, shares and what they change.
void add_causes(io::HtmlReport& page, const Verdict& v);
/// What the data would not show.
void add_detectable_limits(io::HtmlReport& page, const Verdict& v);

}  // namespace pedicel::discrepancy
