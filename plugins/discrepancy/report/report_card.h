#pragma once

#include "pedicel/discrepancy/report/report_plots.h"
#include "pedicel/io/html_report.h"

namespace pedicel::discrepancy {

/// The card: what a person has to know, in the order in which it is asked for. `pairs`: symptoms
/// before and after, strongest first.
void add_card(io::HtmlReport& page, const ReportData& report,
              const std::vector<SymptomPair>& pairs);

/// The symptom that a card shows: the strongest of those that speak for the first cause, else the
/// strongest; nothing where none shows.
const SymptomPair* leading_symptom(const ReportData& report, const std::vector<SymptomPair>& pairs);

}  // namespace pedicel::discrepancy
