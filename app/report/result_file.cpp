#include "app/report/result_file.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/core/diagnostics.h"
#include "engine/io/atomic_file.h"

namespace pedicel::app {

namespace {

using Result = nlohmann::ordered_json;

/// JSON has no word for what is not finite.
Result of_number(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
}

double to_number(const Result& value) {
  if (value.is_number()) return value.get<double>();
  const auto word = value.get<std::string>();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return word == "inf" ? infinity : word == "-inf" ? -infinity : std::nan("");
}

Result of_numbers(std::span<const double> values) {
  Result list = Result::array();
  for (const double value : values) list.push_back(of_number(value));
  return list;
}

std::vector<double> to_numbers(const Result& list) {
  std::vector<double> values;
  for (const Result& value : list) values.push_back(to_number(value));
  return values;
}

Result of_pose(const Pose& pose) {
  const Quat& q = pose.rotation;
  const Vec3& p = pose.position;
  return of_numbers(std::array{p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()});
}

Pose to_pose(const Result& list) {
  const std::vector<double> n = to_numbers(list);
  if (n.size() != 7) throw std::out_of_range("a pose has 7 numbers");
  Pose pose;
  pose.position = Vec3(n[0], n[1], n[2]);
  pose.rotation = Quat(n[6], n[3], n[4], n[5]);
  return pose;
}

Result of_events(const std::vector<world::Event>& events) {
  Result list = Result::array();
  for (const world::Event& e : events)
    list.push_back({{"organ", e.organ},
                    {"cause", e.cause},
                    {"numbers", of_numbers(std::array{e.time, e.stretch, e.bend, e.force, e.moment,
                                                      e.torsion, e.angle})},
                    {"tool", of_pose(e.tool)}});
  return list;
}

std::vector<world::Event> to_events(const Result& list) {
  std::vector<world::Event> events;
  for (const Result& one : list) {
    world::Event e;
    e.organ = one.at("organ");
    e.cause = one.at("cause");
    const std::vector<double> n = to_numbers(one.at("numbers"));
    if (n.size() != 7) throw std::out_of_range("an event has 7 numbers");
    e.time = n[0], e.stretch = n[1], e.bend = n[2], e.force = n[3], e.moment = n[4];
    e.torsion = n[5], e.angle = n[6];
    e.tool = to_pose(one.at("tool"));
    events.push_back(e);
  }
  return events;
}

/// Which of the scene's expectations each verdict is of: they come in their order.
Result of_verdicts(std::span<const world::Expectation> expectations,
                   const std::vector<world::ExpectationResult>& verdicts) {
  Result list = Result::array();
  std::size_t at = 0;
  for (const world::ExpectationResult& verdict : verdicts) {
    const std::string what = world::to_string(verdict.expectation);
    while (at < expectations.size() && world::to_string(expectations[at]) != what) ++at;
    list.push_back(
        {{"expectation", at++}, {"measured", of_numbers(verdict.measured)}, {"met", verdict.met}});
  }
  return list;
}

Result of_gentleness(const SceneResult& r) {
  const simulation::Gentleness::Total& all = r.gentleness;
  Result organs = Result::array();
  for (const HandledOrgan& one : r.handled)
    organs.push_back(
        {{"organ", one.name},
         {"fruit", one.fruit},
         {"broken", one.record.broken},
         {"numbers",
          of_numbers(std::array{one.record.peak_force, one.record.impulse, one.record.first_touch,
                                one.record.strain_energy, one.record.margin_used})}});
  return {{"numbers",
           of_numbers(std::array{all.peak_force, all.impulse, all.strain_energy, all.margin_used})},
          {"touched", all.touched},
          {"broken", all.broken},
          {"organs", organs}};
}

void take_gentleness(const Result& json, SceneResult& r) {
  const std::vector<double> sums = to_numbers(json.at("numbers"));
  if (sums.size() != 4) throw std::out_of_range("gentleness has 4 numbers");
  r.gentleness = {sums[0],
                  sums[1],
                  sums[2],
                  sums[3],
                  json.at("touched").get<int>(),
                  json.at("broken").get<int>()};
  for (const Result& one : json.at("organs")) {
    const std::vector<double> n = to_numbers(one.at("numbers"));
    if (n.size() != 5) throw std::out_of_range("an organ that was handled has 5 numbers");
    HandledOrgan organ{one.at("organ").get<std::string>(), one.at("fruit").get<bool>(), {}};
    organ.record.peak_force = n[0], organ.record.impulse = n[1], organ.record.first_touch = n[2];
    organ.record.strain_energy = n[3], organ.record.margin_used = n[4];
    organ.record.broken = one.at("broken").get<bool>();
    r.handled.push_back(organ);
  }
}

Result of_result(std::span<const world::Expectation> expectations, const SceneResult& r) {
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(r.state_hash));
  Result json = {{"format", "pedicel-result"},
                 {"version", 1},
                 {"exit_code", r.exit_code},
                 {"error", r.error},
                 {"steps", r.steps},
                 {"simulated_s", of_number(r.simulated)},
                 {"wall_s", of_number(r.wall)},
                 {"ms_per_step_p50", of_number(r.ms_per_step_p50)},
                 {"ms_per_step_p95", of_number(r.ms_per_step_p95)},
                 {"stretch_max", of_number(r.largest_stretch)},
                 {"state_hash", hash},
                 {"residual", r.residual},
                 {"verdicts", of_verdicts(expectations, r.verdicts)},
                 {"events", of_events(r.events)},
                 {"gentleness", of_gentleness(r)},
                 {"limits", Result::array()},
                 {"pictures", Result::array()}};
  for (const StalkLimits& limit : r.limits)
    json["limits"].push_back({{"fruit", limit.fruit},
                              {"stretch", of_number(limit.stretch)},
                              {"bend_rad", of_number(limit.bend)}});
  for (const std::filesystem::path& picture : r.pictures)
    json["pictures"].push_back(picture.lexically_relative(r.folder).generic_string());
  if (r.video) json["video"] = r.video->lexically_relative(r.folder).generic_string();
  return json;
}

SceneResult to_result(const Result& json, const std::filesystem::path& folder,
                      std::span<const world::Expectation> expectations) {
  SceneResult r;
  r.folder = folder;
  r.exit_code = json.at("exit_code");
  r.error = json.at("error");
  r.steps = json.at("steps");
  r.simulated = to_number(json.at("simulated_s"));
  r.wall = to_number(json.at("wall_s"));
  r.ms_per_step_p50 = to_number(json.at("ms_per_step_p50"));
  r.ms_per_step_p95 = to_number(json.at("ms_per_step_p95"));
  r.largest_stretch = to_number(json.at("stretch_max"));
  r.state_hash = std::strtoull(json.at("state_hash").get<std::string>().c_str(), nullptr, 16);
  r.residual = json.at("residual");
  for (const Result& one : json.at("verdicts")) {
    const auto at = one.at("expectation").get<std::size_t>();
    if (at >= expectations.size()) throw std::out_of_range("it judges what the scene expects not");
    r.verdicts.push_back({expectations[at], to_numbers(one.at("measured")), one.at("met")});
  }
  r.events = to_events(json.at("events"));
  take_gentleness(json.at("gentleness"), r);
  for (const Result& limit : json.at("limits"))
    r.limits.push_back(
        {limit.at("fruit"), to_number(limit.at("stretch")), to_number(limit.at("bend_rad"))});
  for (const Result& picture : json.at("pictures"))
    r.pictures.push_back(folder / picture.get<std::string>());
  if (json.contains("video")) r.video = folder / json.at("video").get<std::string>();
  return r;
}

}  // namespace

void write_result(const std::filesystem::path& path,
                  std::span<const world::Expectation> expectations, const SceneResult& result) {
  io::write_file_atomically(path, of_result(expectations, result).dump(1) + "\n");
}

SceneResult read_result(const std::filesystem::path& path,
                        std::span<const world::Expectation> expectations) {
  try {
    return to_result(Result::parse(io::read_file(path)), path.parent_path(), expectations);
  } catch (const Result::exception& fault) {
    throw InvalidFile({path.string()}, std::string("is no result of a run: ") + fault.what());
  } catch (const std::out_of_range& fault) {
    throw InvalidFile({path.string()}, std::string("is no result of a run: ") + fault.what());
  }
}

}  // namespace pedicel::app
