#include "plugins/discrepancy/pick/pick_labels.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>

#include "engine/io/table_text.h"
#include "engine/io/text_file.h"
#include "engine/io/unit_text.h"
#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

// Words of public tables, and our own. A word that is neither must not count as a failure.
std::optional<bool> outcome_of(std::string_view word) {
  for (const char* known : {"detached", "came_off"})
    if (io::same_but_case(word, known)) return true;
  for (const char* known : {"failed", "slipped", "held"})
    if (io::same_but_case(word, known)) return false;
  return std::nullopt;
}

// In the order of the names: a table with two of them means the first.
int column_of(const io::TableText& table, std::initializer_list<const char*> names) {
  for (const char* name : names)
    for (std::size_t c = 0; c < table.columns().size(); ++c)
      if (io::same_but_case(table.columns()[c].name, name)) return static_cast<int>(c);
  return -1;
}

/// "06" or "pick_06" or "pick_06.csv" of a path to pick_06.csv.
bool names(const std::string& label, const std::filesystem::path& file) {
  if (label == file.filename().string()) return true;
  const std::string stem = file.stem().string();
  // People label picks by their numbers, and recorders put a prefix before them.
  if (label.empty() || !stem.ends_with(label)) return false;
  const std::size_t before = stem.size() - label.size();
  // "6" is not the end of "pick_16".
  return before == 0 || std::isalnum(static_cast<unsigned char>(stem[before - 1])) == 0;
}

/// A record whose judgement hangs on the two numbers that are fitted.
struct Timed {
  double half, error, blur;  ///< s; `blur`: what the limit has besides the response
  bool came_off;
};

double probability(const Timed& one, double response, double sharpness) {
  // By the same rule that judges, so that what is fitted can be given back to it as options.
  return probability_of_break(one.half, one.error, std::hypot(response, one.blur), sharpness);
}

struct Fitted {
  double response, sharpness;
};

/// Largest likelihood on a grid, but for one record. The grid's ends keep it from running away
/// where one number parts the two kinds.
std::optional<Fitted> fit_timed(const std::vector<Timed>& all, std::size_t but) {
  // A grid, since the likelihood is flat in places and has several tops, and 5,700 points take no
  // time. Responses go from 5 to 200 ms, sharpnesses from 0.5 to 12.
  constexpr int responses = 121, sharpnesses = 47;
  std::optional<Fitted> best;
  double most = 0.0;
  std::array<int, 2> count = {0, 0};
  for (std::size_t i = 0; i < all.size(); ++i) count[all[i].came_off ? 1 : 0] += i != but;
  // Where all came off any limit is right.
  if (count[0] == 0 || count[1] == 0) return std::nullopt;
  for (int r = 0; r < responses; ++r)
    for (int s = 0; s < sharpnesses; ++s) {
      // Responses by ratio, because the odds know only ratios of times. They are 3 % apart.
      const Fitted here = {5e-3 * std::pow(40.0, r / (responses - 1.0)), 0.5 + 0.25 * s};
      double likelihood = 0.0;
      for (std::size_t i = 0; i < all.size(); ++i) {
        // The one that is left out would else vote for itself.
        if (i == but) continue;
        // Each by its own error and blur: a slow record says less about the response of the arm.
        const double p = probability(all[i], here.response, here.sharpness);
        // One odd label costs much, and not all.
        likelihood += std::log(std::max(all[i].came_off ? p : 1.0 - p, 1e-12));
      }
      // Of equal ones the first: the shorter response, and the flatter odds.
      if (!best || likelihood > most) best = here, most = likelihood;
    }
  return best;
}

}  // namespace

std::vector<PickLabel> read_pick_labels(const std::filesystem::path& file,
                                        Diagnostics& diagnostics) {
  const std::string content = io::read_text_file(file);
  io::TableText table(content, file.string(), diagnostics);
  std::vector<PickLabel> labels;
  // What is wrong has been said.
  if (!table.good()) return labels;
  const int name = column_of(table, {"pick", "file", "name"}),
            outcome = column_of(table, {"outcome", "label"});
  // Both at once, since a table of another kind has neither.
  if (name < 0 || outcome < 0) {
    diagnostics.error({file.string(), table.header_line(), 1},
                      "expected a column pick (or file) and a column outcome");
    return labels;
  }
  while (table.next()) {
    const std::string word(table.cells()[static_cast<std::size_t>(outcome)].text);
    if (const auto came_off = outcome_of(word))
      labels.push_back({std::string(table.cells()[static_cast<std::size_t>(name)].text), *came_off,
                        table.at(static_cast<std::size_t>(name))});
    else
      // Once for all rows: a table of another kind has a thousand of them.
      diagnostics.repeated_error(
          "outcome", table.at(static_cast<std::size_t>(outcome)),
          in_quotes(word) + " is no outcome, expected detached, failed, slipped or held");
  }
  return labels;
}

LabelledPicks compare_with_labels(const std::vector<JudgedPick>& all,
                                  const std::vector<PickLabel>& labels) {
  LabelledPicks found;
  std::vector<Timed> timed;
  // Judged records may have no label, and labelled ones no time: three lists, of which this one
  // leads from times to rows.
  std::vector<std::size_t> rows;
  for (const JudgedPick& judged : all) {
    const auto label = std::ranges::find_if(
        labels, [&](const PickLabel& one) { return names(one.name, judged.record.file); });
    if (label == labels.end()) {
      // Told at the end, as a misspelt name would else count for nothing.
      found.without_label.push_back(judged.record.file);
      continue;
    }
    const Pick& pick = judged.pick;
    // What is unclear is no answer, and so is not right, whichever the label is. A fruit that was
    // held did not come off.
    const bool right =
        pick.end != Pick::End::unclear && (pick.end == Pick::End::came_off) == label->came_off;
    // Others were judged by levels alone: no response or sharpness would change them. Sampling and
    // averaging are each record's own; the response is common to all.
    if (pick.probability && pick.fall->half) {
      const double blur = std::hypot(pick.interval, 0.5 * pick.fall->smoothing);
      timed.push_back({*pick.fall->half, pick.fall->half_error, blur, label->came_off});
      rows.push_back(found.rows.size());
    }
    // Those without a time stand as they were judged, with or without the others: nothing that is
    // fitted would change them.
    found.rows.push_back({judged.record.file, label->came_off, right, right});
  }
  for (std::size_t i = 0; i < timed.size(); ++i)
    // Each by what the others give: by its own it would be right too often. Where the others are
    // all of one kind nothing can be fitted, and the judgement stays as it was.
    if (const auto others = fit_timed(timed, i))
      found.rows[rows[i]].right_alone =
          (probability(timed[i], others->response, others->sharpness) >= 0.5) == timed[i].came_off;
  // With none left out: these are the options that a user gets.
  if (const auto fitted = fit_timed(timed, timed.size())) {
    // Zero stays where the labels are all of one kind, and says that there is no such number.
    found.response = fitted->response;
    found.sharpness = fitted->sharpness;
  }
  return found;
}

int LabelledPicks::right() const {
  return static_cast<int>(std::ranges::count_if(rows, &Row::right));
}

int LabelledPicks::right_alone() const {
  return static_cast<int>(std::ranges::count_if(rows, &Row::right_alone));
}

std::string LabelledPicks::to_text() const {
  const std::string of = " of " + std::to_string(rows.size());
  std::string lines = "labels: " + std::to_string(right()) + of + " right\n";
  for (const Row& row : rows)
    if (!row.right)
      // Only those that are wrong: a person then looks at these records.
      lines += "  " + row.file + " is labelled " + (row.came_off ? "detached" : "failed") + "\n";
  for (const std::string& file : without_label) lines += "  " + file + " has no label\n";
  // Numbers that cannot be told from these labels are not told.
  if (response > 0.0)
    lines += "each judged by what the others give: " + std::to_string(right_alone()) + of +
             " right\n" +
             text("these labels give --response %.3g --sharpness %.3g\n", response, sharpness);
  return lines;
}

}  // namespace pedicel::discrepancy
