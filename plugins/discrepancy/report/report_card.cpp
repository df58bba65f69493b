#include "plugins/discrepancy/report/report_card.h"

#include <algorithm>
#include <array>

#include "plugins/discrepancy/report/plant_sketch.h"
#include "plugins/discrepancy/report/report_words.h"
#include "plugins/discrepancy/report/verdict_tables.h"
#include "plugins/discrepancy/test/foretold.h"
#include "plugins/discrepancy/test/symptom_parts.h"

namespace pedicel::discrepancy {

namespace {

constexpr std::array<const char*, 4> mark_colours = {"#d1495b", "#c77d0a", "#8a5fbf", "#2e8b57"};
constexpr std::size_t most_competing_models = 5;

bool concluded(const Verdict& v) {
  return v.outcome != Outcome::bad_data && v.outcome != Outcome::numerical;
}

// Where a force acts, one deviation either way, and where else it may; else where most is left.
std::vector<SketchMark> marks_of_unknown(const ReportData& report) {
  const MissingForce& force = report.diagnosis.force;
  std::vector<SketchMark> marks;
  if (force.found && force.place) {
    SketchMark here;
    here.label = "a force acts here";
    here.colour = mark_colours[0];
    here.places = {*force.place};
    plant::CurvePlace from = *force.place;
    from.at = std::max(0.0, force.place->at - force.place_error);
    here.stretch = {from, std::min(1.0, force.place->at + force.place_error)};
    marks.push_back(here);
    for (const plant::CurvePlace& other : force.elsewhere) {
      SketchMark there;
      there.label = "or here";
      there.colour = mark_colours[1];
      there.places = {other};
      marks.push_back(there);
    }
    return marks;
  }
  const auto largest = worst(report, extended);
  const auto markers = static_cast<int>(report.experiment.markers.size());
  if (largest && largest->column < 3 * markers) {
    SketchMark mark;
    mark.label = "largest residual";
    mark.colour = mark_colours[0];
    mark.places = {report.experiment.markers[largest->column / 3].place};
    marks.push_back(mark);
  }
  return marks;
}

std::vector<SketchMark> marks_of(const ReportData& report) {
  const Verdict& v = report.diagnosis.verdict;
  std::vector<SketchMark> marks;
  // Modulus, density and damping belong to all of the plant already.
  for (std::size_t c = 0; c < v.causes.size() && c < mark_colours.size(); ++c)
    marks.push_back(mark_of(report.experiment, v.causes[c], mark_colours[c]));
  return v.outcome == Outcome::unknown ? marks_of_unknown(report) : marks;
}

std::string after_text(const SymptomPair& pair) {
  if (pair.after.name.empty()) return "not to be measured";
  return with_error(pair.after.value, pair.after.standard_error, pair.after.unit) +
         (pair.after.shows() ? "" : ", within the noise");
}

void add_symptom(io::HtmlReport& page, const ReportData& report,
                 const std::vector<SymptomPair>& pairs) {
  const SymptomPair* pair = leading_symptom(report, pairs);
  const StalkStrength& strength = report.diagnosis.strength;
  page.subheading("What is seen");
  if (strength.needs_law()) page.paragraph(strength.sentence());
  if (pair) {
    page.paragraph(pair->before.sentence);
    if (report.extended)
      page.paragraph(
          "With what was found added to the model (" + symptom_title(pair->before.name) +
          "): " + with_error(pair->before.value, pair->before.standard_error, pair->before.unit) +
          " before, " + after_text(*pair) + " after.");
  } else if (!strength.needs_law()) {
    page.paragraph("No single symptom leaves the noise.");
  }
  std::vector<std::string> plots;
  if (const auto largest = worst(report, refitted))
    plots.push_back(residual_plot(report, *largest, 440));
  plots.push_back(plant_sketch(report.experiment, marks_of(report)));
  page.plots(plots);
}

// Where the plant rests and how fast it swings, by the best model: what an engineer would ask of it
// first. Judged on the trials that were held out.
void add_foretold(io::HtmlReport& page, const ReportData& report) {
  const Diagnosis& d = report.diagnosis;
  const std::vector<Foretold> all = foretold(report.experiment, report.data,
                                             d.predictions[report.extended ? extended : refitted]);
  const std::string words = foretold_text(report.experiment, all, d.check_trials);
  if (words.empty()) return;
  page.subheading("What it predicts");
  page.paragraph(words);
  std::vector<std::vector<std::string>> rows;
  for (const Foretold& one : all) {
    const bool held_out = std::ranges::find(d.check_trials, one.trial) != d.check_trials.end();
    rows.push_back({report.experiment.trials[one.trial].name, held_out ? "held out" : "fitted",
                    one.what == Foretold::What::rest ? "path to where it rests" : "frequency",
                    with_error(100.0 * one.off, 100.0 * one.error, "%")});
  }
  page.table({"trial", "", "what", "measured less predicted"}, rows);
}

void add_competing(io::HtmlReport& page, const Diagnosis& d) {
  if (d.ranking.size() < 2) return;
  page.subheading("What else it could have been");
  std::vector<std::vector<std::string>> rows;
  for (const Candidate& candidate : d.ranking) {
    const bool named = std::ranges::any_of(
        d.verdict.causes, [&](const NamedCause& cause) { return cause.name == candidate.cause; });
    if (named || rows.size() == most_competing_models) continue;
    const bool left = !candidate.whole;  // on its way, and so not to be compared
    rows.push_back({candidate.cause,
                    left ? "not fitted to the end"
                         : short_number(d.ranking.front().evidence - candidate.evidence),
                    left ? left_early : why_it_lost(candidate, d)});
  }
  if (!rows.empty()) page.table({"competing model", "behind (nats)", "why it lost"}, rows);
}

void add_next(io::HtmlReport& page, const Diagnosis& d) {
  page.subheading("What to do next");
  const Verdict& v = d.verdict;
  if (!v.next_experiment.empty())
    page.paragraph(v.next_experiment);
  else if (v.outcome == Outcome::bad_data)
    page.paragraph("Mend the data: " + v.remainder + ".");
  else if (v.outcome == Outcome::numerical)
    page.paragraph(
        "Fewer or shorter trials, or a plant drawn without very short pieces, would let "
        "the mesh and the step become finer.");
  else if (v.outcome == Outcome::adequate)
    page.paragraph("Nothing is missing at this noise. Use the refitted parameters below.");
  else if (v.outcome == Outcome::unknown)
    page.paragraph(
        "Repeat the trial with the largest residual at half and at twice its amplitude, "
        "with one more marker where the residual is largest.");
  else
    page.paragraph("No further experiment is needed for this. Use " +
                   (v.extended_plant.empty() ? std::string("the refitted parameters below")
                                             : v.extended_plant) +
                   " in place of the nominal plant.");
  const std::string plot = prediction_plot(d.next);
  if (!plot.empty()) page.plot(plot);
}

}  // namespace

const SymptomPair* leading_symptom(const ReportData& report,
                                   const std::vector<SymptomPair>& pairs) {
  const SymptomPair* strongest = nullptr;
  const auto& causes = report.diagnosis.verdict.causes;
  for (const SymptomPair& pair : pairs) {
    if (!pair.before.shows()) continue;
    if (!strongest) strongest = &pair;
    if (causes.empty()) break;
    const auto& speaks = pair.before.speaks_for;
    if (std::ranges::find(speaks, causes.front().name) != speaks.end()) return &pair;
  }
  return strongest;
}

void add_card(io::HtmlReport& page, const ReportData& report,
              const std::vector<SymptomPair>& pairs) {
  const Diagnosis& d = report.diagnosis;
  const Verdict& v = d.verdict;
  page.begin_card();
  page.note(headline(v), v.outcome == Outcome::adequate || v.outcome == Outcome::named);
  page.paragraph(certainty_text(d));
  if (!d.exchanged.empty())
    page.paragraph("Nothing is wrong in the trials that were to be fitted; \"" + d.exchanged +
                   "\", which was to be held out, is not explained by them. So it was fitted, and "
                   "another one held out.");
  const std::string remainder = remainder_text(v);
  if (concluded(v) && !remainder.empty()) page.paragraph(remainder);
  if (report.predicted && concluded(v)) add_symptom(page, report, pairs);
  if (concluded(v)) add_symptom_numbers(page, v);
  add_causes(page, v);
  const std::string ratios = ratios_text(v);
  if (concluded(v) && !ratios.empty()) page.paragraph(ratios);
  const std::string gain = gain_text(d);
  if (concluded(v) && !gain.empty()) {
    page.subheading(v.outcome == Outcome::unknown ? "What is left" : "What it gains");
    page.paragraph(gain);
  }
  if (report.predicted && concluded(v)) add_foretold(page, report);
  add_competing(page, d);
  if (concluded(v)) add_detectable_limits(page, v);
  add_next(page, d);
  page.end_card();
}

}  // namespace pedicel::discrepancy
