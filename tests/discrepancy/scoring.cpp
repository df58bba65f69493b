#include "tests/discrepancy/scoring.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace pedicel::hidden {

namespace {

using discrepancy::NamedCause;
using discrepancy::Outcome;
using discrepancy::Verdict;
using nlohmann::ordered_json;
using Kind = CaseOrder::Kind;
using Names = std::vector<std::string>;

constexpr std::array call_names = {
    "right",   "partial", "wrong",           "sure",        "held",   "not_held",
    "unknown", "missed",  "parameter_alarm", "false_alarm", "refused"};

// Noise units, squared: below it the ratio of two gains is mostly noise.
constexpr double least_gain = 100.0;

bool contains(const Names& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}
bool within(const Names& part, const Names& whole) {
  return std::ranges::all_of(part, [&](const std::string& name) { return contains(whole, name); });
}

Names names_of(const std::vector<plant::Effect>& effects) {
  Names names;
  for (const plant::Effect& effect : effects) names.push_back(effect.name);
  return names;
}

Call call_null(Outcome outcome, const Names& said) {
  if (outcome == Outcome::adequate) return Call::right;
  const Names three{"youngs_modulus", "density", "damping_time"};
  return outcome == Outcome::named && within(said, three) ? Call::parameter_alarm
                                                          : Call::false_alarm;
}

// Where modulus and damping were off as well, to name them is no mistake, and not what was asked.
Call call_outside(const HiddenCase& hidden, Outcome outcome, const Names& said) {
  switch (outcome) {
    case Outcome::unknown:
      return Call::right;
    case Outcome::adequate:
      return Call::missed;
    case Outcome::ambiguous:
      return Call::not_held;
    default:
      return within(said, names_of(hidden.refitted)) ? Call::missed : Call::wrong;
  }
}

// Likewise.
Call call_named(const HiddenCase& hidden, const Names& truth, const Names& said) {
  Names allowed = truth;
  for (const std::string& name : names_of(hidden.refitted)) allowed.push_back(name);
  if (!within(said, allowed)) return Call::wrong;
  const auto found =
      std::ranges::count_if(truth, [&](const std::string& name) { return contains(said, name); });
  if (found == 0) return Call::missed;
  if (found < static_cast<long>(truth.size())) return Call::partial;
  return hidden.order.kind == Kind::look_alike ? Call::sure : Call::right;
}

Call call_of(const HiddenCase& hidden, Outcome outcome, const Names& said) {
  const Kind kind = hidden.order.kind;
  if (kind == Kind::null) return call_null(outcome, said);
  if (outcome == Outcome::bad_data || outcome == Outcome::numerical) return Call::refused;
  if (kind == Kind::outside) return call_outside(hidden, outcome, said);
  const Names truth = names_of(hidden.causes);
  switch (outcome) {
    case Outcome::adequate:
      return Call::missed;
    case Outcome::unknown:
      return Call::unknown;
    case Outcome::ambiguous:
      if (!within(truth, said)) return Call::not_held;
      return kind == Kind::look_alike ? Call::right : Call::held;
    default:
      return call_named(hidden, truth, said);
  }
}

double stated_grip(const HiddenCase& hidden) {
  for (const reference::TrialPlan& trial : hidden.trials)
    for (const reference::HoldPlan& hold : trial.holds)
      if (hold.stiffness) return *hold.stiffness;
  return reference::rigid_stiffness;
}

std::optional<double> gain_share(const HiddenCase& hidden, const Verdict& verdict,
                                 const TrueError& truth) {
  const Kind kind = hidden.order.kind;
  if ((kind != Kind::effect && kind != Kind::pair) || verdict.causes.empty()) return {};
  if (!verdict.check.refitted || !verdict.check.extended) return {};
  const double refitted = *verdict.check.refitted, extended = *verdict.check.extended;
  if (truth.samples * (refitted * refitted - truth.error * truth.error) < least_gain) return {};
  return (refitted - extended) / (refitted - truth.error);
}

Score blank(const HiddenCase& hidden) {
  Score s;
  s.number = hidden.order.number;
  s.seed = hidden.seed;
  s.kind = name_of(hidden.order.kind);
  s.plant = name_of(hidden.order.plant);
  s.pack = name_of(hidden.order.pack);
  s.coloured = hidden.order.coloured;
  s.off = hidden.order.off;
  s.times = hidden.order.size;
  s.told_apart = hidden.order.told_apart;
  s.hidden = hidden.order.hidden;
  s.causes = names_of(hidden.causes);
  s.off_too = names_of(hidden.refitted);
  return s;
}

// JSON has no NaN and no infinity.
ordered_json number(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}
double number_of(const ordered_json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

}  // namespace

const char* name_of(Call call) {
  return call_names[static_cast<std::size_t>(call)];
}

bool named_exactly(const Score& s) {
  if (s.outcome != discrepancy::to_string(Outcome::named)) return false;
  Names wanted = s.causes, told = s.said;
  wanted.insert(wanted.end(), s.off_too.begin(), s.off_too.end());
  told.insert(told.end(), s.details.begin(), s.details.end());
  return within(s.said, wanted) && within(wanted, told);
}

Score score(const HiddenCase& hidden, const Verdict& verdict, const TrueError& truth) {
  Score s = blank(hidden);
  s.outcome = discrepancy::to_string(verdict.outcome);
  std::vector<NamedCause> found = verdict.causes;
  for (const NamedCause& cause : verdict.causes) s.said.push_back(cause.name);
  for (const NamedCause& detail : verdict.details) s.details.push_back(detail.name);
  // What was hidden and is told as a detail was found.
  for (const NamedCause& detail : verdict.details)
    if (verdict.outcome == Outcome::named && contains(names_of(hidden.causes), detail.name)) {
      s.said.push_back(detail.name);
      found.push_back(detail);
    }
  s.call = call_of(hidden, verdict.outcome, s.said);
  s.gain_share = gain_share(hidden, verdict, truth);
  if (s.call == Call::right || s.call == Call::partial || s.call == Call::sure)
    for (const plant::Effect& effect : hidden.causes)
      for (const NamedCause& cause : found)
        if (cause.name == effect.name)
          s.sizes.push_back(size_error(effect, cause, stated_grip(hidden)));
  if (!verdict.causes.empty()) s.evidence = verdict.causes.front().evidence;
  s.simulations = verdict.simulations;
  s.seconds = verdict.seconds;
  return s;
}

Score failed_score(const HiddenCase& hidden, const std::string& fault) {
  Score s = blank(hidden);
  s.call = hidden.order.kind == Kind::null ? Call::false_alarm : Call::refused;
  s.fault = fault;
  return s;
}

std::string to_line(const Score& s) {
  ordered_json sizes = ordered_json::array();
  for (const SizeError& size : s.sizes)
    sizes.push_back({{"cause", size.cause},
                     {"error", number(size.error)},
                     {"inside", size.inside},
                     {"entries", size.entries},
                     {"place", number(size.place)}});
  const ordered_json json = {{"case", s.number},
                             {"seed", s.seed},
                             {"kind", s.kind},
                             {"hidden", s.hidden},
                             {"times_smallest", s.times},
                             {"told_apart", s.told_apart},
                             {"verdict", s.outcome},
                             {"said", s.said},
                             {"causes", s.causes},
                             {"off_too", s.off_too},
                             {"details", s.details},
                             {"call", name_of(s.call)},
                             {"gain_share", number(s.gain_share.value_or(NAN))},
                             {"sizes", sizes},
                             {"evidence", number(s.evidence)},
                             {"alarm", number(s.alarm)},
                             {"lead", number(s.lead.value_or(NAN))},
                             {"force_kind", s.force_kind},
                             {"force_away", number(s.force_away.value_or(NAN))},
                             {"force_error", number(s.force_error.value_or(NAN))},
                             {"force_elsewhere", s.force_elsewhere},
                             {"other_kinds", s.other_kinds},
                             {"plant", s.plant},
                             {"pack", s.pack},
                             {"coloured", s.coloured},
                             {"off", s.off},
                             {"simulations", s.simulations},
                             {"seconds", number(s.seconds)},
                             {"fault", s.fault}};
  return json.dump();
}

Score from_line(const std::string& line) {
  const ordered_json json = ordered_json::parse(line);
  Score s;
  json.at("case").get_to(s.number);
  json.at("seed").get_to(s.seed);
  json.at("kind").get_to(s.kind);
  json.at("hidden").get_to(s.hidden);
  json.at("verdict").get_to(s.outcome);
  json.at("said").get_to(s.said);
  json.at("plant").get_to(s.plant);
  json.at("pack").get_to(s.pack);
  json.at("coloured").get_to(s.coloured);
  json.at("off").get_to(s.off);
  json.at("simulations").get_to(s.simulations);
  json.at("fault").get_to(s.fault);
  s.times = number_of(json.at("times_smallest"));
  s.told_apart = json.value("told_apart", false);
  s.causes = json.value("causes", s.hidden);  // older lines have none of the three
  s.off_too = json.value("off_too", Names{});
  s.details = json.value("details", Names{});
  s.evidence = number_of(json.at("evidence"));
  s.alarm = number_of(json.at("alarm"));
  s.seconds = number_of(json.at("seconds"));
  if (!json.at("gain_share").is_null()) s.gain_share = number_of(json.at("gain_share"));
  if (!json.at("lead").is_null()) s.lead = number_of(json.at("lead"));
  if (!json.at("force_away").is_null()) s.force_away = number_of(json.at("force_away"));
  if (!json.at("force_error").is_null()) s.force_error = number_of(json.at("force_error"));
  json.at("force_elsewhere").get_to(s.force_elsewhere);
  json.at("other_kinds").get_to(s.other_kinds);
  json.at("force_kind").get_to(s.force_kind);
  const auto call = std::ranges::find(call_names, json.at("call").get<std::string>());
  if (call == call_names.end()) throw std::invalid_argument("no such call");
  s.call = static_cast<Call>(call - call_names.begin());
  for (const ordered_json& size : json.at("sizes"))
    s.sizes.push_back({size.at("cause"), number_of(size.at("error")), size.at("inside"),
                       size.at("entries"), number_of(size.at("place"))});
  return s;
}

}  // namespace pedicel::hidden
