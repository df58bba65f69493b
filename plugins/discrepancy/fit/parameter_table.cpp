#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "plugins/discrepancy/fit/parameter_fit.h"

namespace pedicel::discrepancy {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  // JSON has neither nan nor inf. A reader takes null for what it is: no number.
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::string text(const char* format, double a) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, a);
  return buffer;
}

std::string padded(std::string cell, std::size_t width) {
  if (cell.size() < width) cell.append(width - cell.size(), ' ');
  return cell + "  ";
}

// What cannot be seen is told before all else: any further word would be about a number that means
// nothing.
std::string remark_on(const FittedParameter& p) {
  if (!p.seen) return "these data cannot see it";
  std::string remark;
  if (p.low_open) remark = "no lower end: these data allow all down to its bound";
  if (p.high_open) remark = "no upper end: these data allow all up to its bound";
  // Beside an open end it says more: the best value itself is where it is for want of room.
  if (p.at_bound) remark += std::string(remark.empty() ? "" : "; ") + "stands at its bound";
  return remark;
}

std::string interval_of(const FittedParameter& p) {
  // An interval between two bounds would look like a result.
  if (!p.seen) return "-";
  const auto end = [](double value, bool open) { return open ? "..." : text("%.4g", value); };
  return end(p.low, p.low_open) + " to " + end(p.high, p.high_open);
}

}  // namespace

std::string to_json(const ParameterFit& fit) {
  const FitSummary& summary = fit.summary;
  Json parameters = Json::array(), trials = Json::array(), bounds = Json::array();
  for (const FittedParameter& p : fit.parameters) {
    parameters.push_back({{"name", p.name},
                          {"value", number(p.value)},
                          // An open end has a number, too, its bound, but that is no finding, and
                          // programs would take it for one.
                          {"low", p.low_open ? Json(nullptr) : number(p.low)},
                          {"high", p.high_open ? Json(nullptr) : number(p.high)},
                          {"unit", p.unit},
                          {"seen", p.seen},
                          {"remark", remark_on(p)}});
    // Apart, too, because a program should not have to read remarks.
    if (p.at_bound) bounds.push_back(p.name);
  }
  for (const TrialError& t : fit.trials)
    trials.push_back(
        {{"name", t.trial}, {"use", t.check ? "check" : "fit"}, {"rms", number(t.rms)}});
  Json noise = Json::object();
  for (const auto& [name, std] : fit.noise) noise[name] = number(std);
  const Json json = {
      {"format", "pedicel-fit"},
      {"version", 1},
      {"parameters", parameters},
      {"interval", "95 %, profile likelihood"},
      // So that somebody who knows the noise better can undo it.
      {"widened", number(fit.spread)},
      {"condition", number(summary.condition)},
      {"at_bound", bounds},
      {"trials", trials},
      {"trials_unit", "rms residual over the noise floor"},
      {"noise", noise},
      {"numerics",
       {{"distance", fit.distance}, {"dt", fit.dt}, {"error", number(fit.numerical_error)}}},
      // A nuisance, told because the modulus depends on it.
      {"mesh_share", number(summary.hypothesis.mesh_share())},
      {"converged", summary.converged},
      {"why", summary.why},
      {"remarks", fit.remarks},
      {"starts", fit.starts},
      {"refits", fit.refits},
      {"simulations", fit.simulations},
      {"seconds", fit.seconds}};
  return json.dump(2);
}

std::string to_table(const ParameterFit& fit) {
  // As wide as the longest name: places and components make some of them long.
  std::size_t name = 9, interval = 15;
  for (const FittedParameter& p : fit.parameters) {
    name = std::max(name, p.name.size());
    interval = std::max(interval, interval_of(p).size());
  }
  std::string table = padded("parameter", name) + padded("value", 10) + padded("unit", 8) +
                      padded("95 % interval", interval) + "\n";
  for (const FittedParameter& p : fit.parameters)
    table += padded(p.name, name) + padded(text("%.4g", p.value), 10) + padded(p.unit, 8) +
             padded(interval_of(p), interval) + remark_on(p) + "\n";
  table += "\n" + padded("trial", name) + padded("use", 10) + "rms over noise\n";
  // Held-out trials stand among the fitted ones, so that their error is seen beside theirs.
  for (const TrialError& t : fit.trials)
    table +=
        padded(t.trial, name) + padded(t.check ? "check" : "fit", 10) + text("%.3g", t.rms) + "\n";
  table += "\n";
  // Chance alone makes some per cent of it; below that the sentence would alarm for nothing.
  if (fit.spread > 1.05)
    table += "More than noise is left: the intervals are " + text("%.3g", fit.spread) +
             " times as wide as noise alone would make them.\n";
  table += "Condition of the scaled problem " + text("%.3g", fit.summary.condition) +
           (fit.summary.condition > 100.0 ? ": these data hardly tell some parameters apart" : "") +
           ". Stopped: " + fit.summary.why + "\n";
  // Last, but always: what was left out of the data is a part of the answer.
  for (const std::string& remark : fit.remarks) table += remark + "\n";
  return table;
}

}  // namespace pedicel::discrepancy
