#pragma once

#include "engine/io/html_report.h"
#include "plugins/discrepancy/report/report_plots.h"

namespace pedicel::discrepancy {

/// The card: what a person has to know, in the order in which it is asked for. `pairs`: symptoms
/// before and after, strongest first.
void add_card(io::HtmlReport& page, const ReportData& report,
              const std::vector<SymptomPair>& pairs);

/// The symptom that a card shows: the strongest of those that speak for the first cause, else the
/// strongest; nothing where none shows.
const SymptomPair* leading_symptom(const ReportData& report, const std::vector<SymptomPair>& pairs);

}  // namespace pedicel::discrepancy
