#include "plugins/discrepancy/report/verdict_tables.h"

#include "plugins/discrepancy/report/report_words.h"
#include "plugins/discrepancy/test/symptom_parts.h"

namespace pedicel::discrepancy {

namespace {

std::string listed(const std::vector<std::string>& words, const char* between = "; ") {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

void add_cause_table(io::HtmlReport& page, const std::vector<NamedCause>& causes) {
  std::vector<std::vector<std::string>> rows;
  for (const NamedCause& cause : causes) {
    std::string numbers;
    for (const auto& [name, estimates] : cause.parameters)
      numbers += (numbers.empty() ? "" : "; ") + name + " " + estimate_text(estimates);
    const std::string place = place_text(cause);
    rows.push_back({said_name(cause), place.empty() ? "the whole" : place, numbers,
                    share_text(cause.share), change_text(cause.change),
                    short_number(cause.evidence)});
  }
  page.table(
      {"cause", "where", "size", "share of the misfit", "changes by (RMS)", "evidence (nats)"},
      rows);
}

}  // namespace

// Whatever was accepted: what the data show, and which causes would make it.
void add_symptom_numbers(io::HtmlReport& page, const Verdict& v) {
  constexpr std::size_t most = 8;
  std::vector<std::vector<std::string>> rows;
  for (const SymptomNumber& one : v.symptoms) {
    if (!one.shows || rows.size() == most) break;
    rows.push_back({symptom_title(one.name), one.of.empty() ? "all trials" : one.of,
                    with_error(one.value, one.error, one.unit), listed(one.speaks_for, ", ")});
  }
  if (rows.empty()) return;
  page.subheading("What shows, in numbers");
  page.table({"symptom", "of", "measured less refitted model", "speaks for"}, rows);
}

void add_causes(io::HtmlReport& page, const Verdict& v) {
  if (!v.causes.empty()) {
    page.subheading(v.outcome == Outcome::ambiguous ? "What it could be, and how large"
                                                    : "What it is, where, and how large");
    add_cause_table(page, v.causes);
    const std::string explained = explained_text(v);
    if (!explained.empty()) page.paragraph(explained);
  }
  if (!v.details.empty()) {
    page.subheading("Details: real, and too small to matter");
    add_cause_table(page, v.details);
  }
  if (!v.nearest.empty()) {
    page.subheading("What came closest, and was not accepted");
    add_cause_table(page, v.nearest);
  }
}

void add_detectable_limits(io::HtmlReport& page, const Verdict& v) {
  const auto [small, never] = detectable_limit_texts(v);
  if (small.empty() && never.empty()) return;
  page.subheading("What could still hide in these data");
  const std::string first =
      v.outcome == Outcome::unknown
          ? "Behind what is missing anything may hide. Were that known, there "
            "could still be "
          : "";
  if (!small.empty()) page.paragraph(first + listed(small) + ".");
  if (!never.empty()) page.paragraph("These data cannot see at any size: " + listed(never) + ".");
}

}  // namespace pedicel::discrepancy
