#include "tests/discrepancy/score_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <set>

namespace pedicel::hidden {

namespace {

constexpr double z95 = 1.959964;
constexpr double tie = 3.0;  // nats: odds of 20 to 1
constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();

using Wanted = std::function<bool(const Score&)>;

bool is(const Score& s, const char* kind) {
  return s.kind == kind;
}
bool alarmed(const Score& s) {
  return s.call == Call::false_alarm || s.call == Call::parameter_alarm;
}
// Whether another cause, refitted in full, explains the data as well as the true one.
bool ties(const Score& s) {
  return s.lead && std::abs(*s.lead) < tie;
}
constexpr double near = 0.1;  // of a curve
bool right_place(const Score& s) {
  return s.force_away && *s.force_away <= near;
}
// Whether the place's interval, two deviations either way, or another curve that is said holds it.
bool holds_place(const Score& s) {
  return right_place(s) || s.force_elsewhere ||
         (s.force_away && s.force_error && *s.force_away <= 2.0 * *s.force_error);
}
std::string kind_of(const Score& s) {
  static const std::map<std::string, std::string> kinds{{"string", "string"},
                                                        {"stake", "stop"},
                                                        {"push", "periodic push"},
                                                        {"attraction", "attraction to a point"}};
  return kinds.at(s.hidden.front());
}
bool right_kind(const Score& s) {
  return kind_of(s) == s.force_kind;
}
bool holds_kind(const Score& s) {
  return right_kind(s) || std::ranges::find(s.other_kinds, kind_of(s)) != s.other_kinds.end();
}
bool hides_known(const Score& s) {
  return is(s, "effect") || is(s, "pair") || is(s, "look_alike");
}

TableRow row_of(const std::string& figure, const Share& share, const char* good = "",
                const char* extraordinary = "") {
  return {figure, share.value, share.low, share.high, share.of, true, good, extraordinary};
}
TableRow row_of(const std::string& figure, const Quantile& q, bool percent, const char* good,
                const char* extraordinary) {
  return {figure, q.value, q.low, q.high, q.of, percent, good, extraordinary};
}

/// Counts among the scores of one kind.
class Counter {
 public:
  explicit Counter(const std::vector<Score>& scores) : scores_(scores) {}
  Share operator()(const Wanted& among, const Wanted& counted) const {
    int count = 0, of = 0;
    for (const Score& s : scores_) {
      if (!among(s)) continue;
      ++of;
      if (counted(s)) ++count;
    }
    return share(count, of);
  }

 private:
  const std::vector<Score>& scores_;
};

void add_null_rows(const Counter& count, std::vector<TableRow>& rows) {
  const auto null = [](const Score& s) { return is(s, "null"); };
  rows.push_back(row_of("false alarms on null data", count(null, alarmed), "3 %", "1 %"));
  rows.push_back(
      row_of("- white noise",
             count([](const Score& s) { return is(s, "null") && !s.coloured; }, alarmed)));
  rows.push_back(
      row_of("- coloured noise",
             count([](const Score& s) { return is(s, "null") && s.coloured; }, alarmed)));
  rows.push_back(row_of("- of them modulus, density or damping", count(null, [](const Score& s) {
                          return s.call == Call::parameter_alarm;
                        })));
}

void add_effect_rows(const Counter& count, std::vector<TableRow>& rows) {
  const auto effect = [](const Score& s) { return is(s, "effect") && s.times >= 2.0; };
  const auto called = [](Call call) { return [call](const Score& s) { return s.call == call; }; };
  rows.push_back(row_of("right name, one effect, 2 x the smallest and above",
                        count(effect, called(Call::right)), "85 %", "97 %"));
  rows.push_back(row_of("- 4 x the smallest and above",
                        count([](const Score& s) { return is(s, "effect") && s.times >= 4.0; },
                              called(Call::right))));
  rows.push_back(row_of("- and modulus and damping, where they were off as well",
                        count(effect, named_exactly), "93 %"));
  const auto parted = [=](const Score& s) { return effect(s) && !ties(s); };
  const auto tied = [=](const Score& s) { return effect(s) && ties(s); };
  rows.push_back(row_of("- where the data part the true cause from every other",
                        count(parted, called(Call::right))));
  rows.push_back(row_of(
      "- where they do not: the truth alone or in the set",
      count(tied, [](const Score& s) { return s.call == Call::right || s.call == Call::held; })));
  rows.push_back(
      row_of("wrong name said with confidence", count(effect, called(Call::wrong)), "5 %", "1 %"));
  rows.push_back(
      row_of("- \"cannot tell\", the truth among them", count(effect, called(Call::held))));
  rows.push_back(row_of("- said unknown", count(effect, called(Call::unknown))));
  rows.push_back(row_of("- missed", count(effect, called(Call::missed))));
}

void add_set_rows(const std::vector<Score>& scores, const Counter& count,
                  std::vector<TableRow>& rows) {
  const auto set = [](const Score& s) { return hides_known(s) && s.outcome == "ambiguous"; };
  rows.push_back(row_of("\"cannot tell\" set holds the truth",
                        count(set, [](const Score& s) { return s.call != Call::not_held; }), "90 %",
                        "98 %"));
  double sum = 0.0, squares = 0.0;
  int sets = 0;
  for (const Score& s : scores)
    if (set(s)) {
      const auto size = static_cast<double>(s.said.size());
      sum += size;
      squares += size * size;
      ++sets;
    }
  const double mean = sets ? sum / sets : none;
  const double error =
      sets > 1 ? z95 * std::sqrt(std::max(squares / sets - mean * mean, 0.0) / (sets - 1))
               : endless;
  rows.push_back({"mean size of the set", mean, mean - error, mean + error, sets, false, "3", "2"});
  const auto pair = [](const Score& s) { return is(s, "pair"); };
  const auto right = [](const Score& s) { return s.call == Call::right; };
  rows.push_back(row_of("two effects, both named", count(pair, right), "60 %", "85 %"));
  rows.push_back(row_of("- both, and modulus and damping, where they were off as well",
                        count(pair, named_exactly)));
  rows.push_back(row_of("- one of them, nothing wrong",
                        count(pair, [](const Score& s) { return s.call == Call::partial; })));
  rows.push_back(row_of("- a wrong name with confidence",
                        count(pair, [](const Score& s) { return s.call == Call::wrong; })));
  rows.push_back(row_of("look-alikes said \"cannot tell\", the truth among them",
                        count([](const Score& s) { return is(s, "look_alike"); }, right)));
}

void add_number_rows(const std::vector<Score>& scores, std::vector<TableRow>& rows) {
  std::vector<double> shares, errors;
  int inside = 0, entries = 0;
  for (const Score& s : scores) {
    if (s.gain_share) shares.push_back(*s.gain_share);
    if (s.call != Call::right || is(s, "look_alike")) continue;
    for (const SizeError& size : s.sizes) {
      if (std::isfinite(size.error)) errors.push_back(size.error);
      inside += size.inside;
      entries += size.entries;
    }
  }
  rows.push_back(row_of("held-out gain over the true model's, median", quantile(shares, 0.5), false,
                        "0.9", "0.97"));
  rows.push_back(row_of("- 10th percentile", quantile(shares, 0.1), false, "0.6", "0.85"));
  rows.push_back(
      row_of("error of a named size, median", quantile(errors, 0.5), true, "10 %", "3 %"));
  rows.push_back(
      row_of("95 % intervals that hold the truth", share(inside, entries), "85 %", "93-97 %"));
}

void add_outside_rows(const Counter& count, std::vector<TableRow>& rows) {
  const auto outside = [](const Score& s) { return is(s, "outside"); };
  rows.push_back(row_of("outside the list: said unknown",
                        count(outside, [](const Score& s) { return s.call == Call::right; }),
                        "70 %", "95 %"));
  rows.push_back(row_of("- the right place, within a tenth of the curve",
                        count(outside, right_place), "60 %", "85 %"));
  rows.push_back(row_of(
      "- the place, within two of the deviations that it is said with, or another curve that "
      "is said to do as well",
      count(outside, holds_place)));
  rows.push_back(row_of("- the right kind", count(outside, right_kind), "50 %", "75 %"));
  rows.push_back(
      row_of("- the right kind, or said not to be told from it", count(outside, holds_kind)));
  rows.push_back(row_of("- a name with confidence",
                        count(outside, [](const Score& s) { return s.call == Call::wrong; })));
  rows.push_back(
      row_of("- missed", count(outside, [](const Score& s) { return s.call == Call::missed; })));
}

// Records that begin in mid swing, of probes and plates, with one or two axes, at rest: few of
// each, and so in no other row.
bool as_people_record(const Score& s) {
  static const std::set<std::string> packs{"moving", "pusher", "plate", "planar", "rest"};
  return packs.contains(s.pack);
}

void add_record_rows(const Counter& count, std::vector<TableRow>& rows) {
  const auto effect = [](const Score& s) { return is(s, "effect"); };
  const auto called = [](Call call) { return [call](const Score& s) { return s.call == call; }; };
  rows.push_back(row_of("records as people make them: false alarms",
                        count([](const Score& s) { return is(s, "null"); }, alarmed)));
  rows.push_back(row_of("- right name alone", count(effect, called(Call::right))));
  rows.push_back(row_of("- and modulus and damping, where they were off as well",
                        count(effect, named_exactly)));
  rows.push_back(row_of("- wrong name said with confidence", count(effect, called(Call::wrong))));
  rows.push_back(
      row_of("- \"cannot tell\", the truth among them", count(effect, called(Call::held))));
}

// P(at most k of n), each with probability p.
double binomial_below(int k, int n, double p) {
  double sum = 0.0;
  for (int i = 0; i <= k; ++i)
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) +
                    i * std::log(p) + (n - i) * std::log1p(-p));
  return sum;
}

std::string number_text(double value, bool percent) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  char text[32];
  std::snprintf(text, sizeof text, percent ? "%.1f %%" : "%.3g", percent ? 100.0 * value : value);
  return text;
}

}  // namespace

Share share(int count, int of) {
  if (of == 0) return {0, 0, none, 0.0, 1.0};
  const double n = of, p = count / n, zz = z95 * z95;
  const double middle = (p + zz / (2.0 * n)) / (1.0 + zz / n);
  const double half = z95 / (1.0 + zz / n) * std::sqrt(p * (1.0 - p) / n + zz / (4.0 * n * n));
  return {count, of, p, std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

Quantile quantile(std::vector<double> values, double level) {
  const int n = static_cast<int>(values.size());
  if (n == 0) return {0, none, -endless, endless};
  std::ranges::sort(values);
  const double at = level * (n - 1);
  const int under = static_cast<int>(at);
  const double next = values[std::min(under + 1, n - 1)];
  Quantile q{n, values[under] + (at - under) * (next - values[under]), -endless, endless};
  // The quantile is at least the k-th smallest value where k or more values lie below it.
  for (int k = 1; k <= n; ++k) {
    if (binomial_below(k - 1, n, level) <= 0.025) q.low = values[k - 1];
    if (std::isinf(q.high) && binomial_below(k - 1, n, level) >= 0.975) q.high = values[k - 1];
  }
  return q;
}

std::vector<TableRow> score_table(const std::vector<Score>& all) {
  std::vector<Score> scores = all, records;
  std::ranges::copy_if(all, std::back_inserter(records), as_people_record);
  std::erase_if(scores, as_people_record);
  const Counter count(scores);
  std::vector<TableRow> rows;
  add_null_rows(count, rows);
  add_effect_rows(count, rows);
  add_set_rows(scores, count, rows);
  add_number_rows(scores, rows);
  add_outside_rows(count, rows);
  add_record_rows(Counter(records), rows);
  return rows;
}

std::vector<std::string> cells(const TableRow& row) {
  return {row.figure,
          number_text(row.value, row.share),
          number_text(row.low, row.share) + " to " + number_text(row.high, row.share),
          std::to_string(row.count),
          row.good,
          row.extraordinary};
}

std::string markdown(const std::vector<TableRow>& rows) {
  std::string text =
      "| figure | reached | 95 % interval | cases | good | extraordinary |\n"
      "|---|---|---|---|---|---|\n";
  for (const TableRow& row : rows) {
    for (const std::string& cell : cells(row)) text += "| " + cell + " ";
    text += "|\n";
  }
  return text;
}

std::string csv(const std::vector<TableRow>& rows) {
  std::string text = "figure,value,low,high,cases\n";
  char line[96];
  for (const TableRow& row : rows) {
    std::string figure = row.figure;
    std::erase(figure, '"');
    std::snprintf(line, sizeof line, ",%.6g,%.6g,%.6g,%d\n", row.value, row.low, row.high,
                  row.count);
    text += "\"" + figure + "\"" + line;
  }
  return text;
}

}  // namespace pedicel::hidden
