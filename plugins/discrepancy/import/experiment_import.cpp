#include "plugins/discrepancy/import/experiment_import.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/io/csv.h"
#include "plugins/discrepancy/data/places.h"

namespace pedicel::discrepancy {

namespace {

constexpr double clock_step = 1.0e-9;  // s: finer differences come from subtracting clocks

double on_clock(double time, double begin) {
  return std::round((time - begin) / clock_step) * clock_step;
}

std::string list_of_names(const std::vector<std::string>& names) {
  constexpr std::size_t shown = 12;
  std::string list;
  for (std::size_t i = 0; i < std::min(shown, names.size()); ++i)
    list += (i > 0 ? ", " : "") + in_quotes(names[i]);
  if (names.size() > shown) list += " and " + std::to_string(names.size() - shown) + " more";
  return list.empty() ? "none" : list;
}

/// Rows from the trial's beginning on, on its own clock.
Samples since(const std::vector<double>& time, const Eigen::MatrixXd& value, double begin) {
  Samples samples;
  std::size_t first = 0;
  while (first < time.size() && on_clock(time[first], begin) < 0.0) ++first;
  for (std::size_t r = first; r < time.size(); ++r)
    samples.time.push_back(on_clock(time[r], begin));
  samples.value = value.bottomRows(static_cast<Eigen::Index>(time.size() - first));
  return samples;
}

/// Rows where the point was seen.
DrivenPath path_of(const Samples& samples, int point) {
  DrivenPath path;
  for (int r = 0; r < samples.size(); ++r) {
    const Vec3 x = samples.value.block<1, 3>(r, 3 * point).transpose();
    if (!x.allFinite()) continue;
    path.time.push_back(samples.time[static_cast<std::size_t>(r)]);
    path.position.push_back(x);
  }
  return path;
}

class Importer {
 public:
  Importer(const ImportRequest& request, ImportNotes& notes) : request_(request), notes_(notes) {}

  Experiment make() {
    Experiment experiment;
    experiment.title = request_.title;
    experiment.plant() = request_.plant;
    experiment.plants.front().path = request_.plant_path;
    for (const PlacedPoint& one : request_.places) {
      check_curve(one.place, "--place");
      experiment.markers.push_back({one.name, one.place});
    }
    for (const ImportedHold& hold : request_.holds) check_curve(hold.place, "--hold or --lead");
    if (request_.places.empty())
      miss("no point has a place on the plant, expected --place POINT=CURVE:AT; the points are " +
           list_of_names(request_.trials.front().recording.names) + ", the curves " +
           list_of_names(curve_names()));
    for (const ImportedTrial& trial : request_.trials)
      experiment.trials.push_back(make_trial(trial));
    if (request_.holds.empty())
      say("nothing leads the plant (drive: none); --hold and --lead say what does");
    return experiment;
  }

 private:
  void miss(const std::string& sentence) { notes_.missing.push_back(sentence); }
  void say(const std::string& sentence) { notes_.said.push_back(sentence); }

  std::vector<std::string> curve_names() const {
    std::vector<std::string> names;
    for (const plant::PlantCurve& curve : request_.plant.curves) names.push_back(curve.name);
    return names;
  }

  void check_curve(const plant::CurvePlace& place, const std::string& option) {
    if (request_.plant.curve_index(place.curve) < 0)
      miss(option + ": the plant has no curve " + in_quotes(place.curve) + ", expected one of " +
           list_of_names(curve_names()));
  }

  Trial make_trial(const ImportedTrial& from) {
    Trial trial;
    trial.name = trial.folder = from.name;
    const WorldTracks tracks = world_tracks(from.recording, request_.statements, notes_);
    if (tracks.time.empty() || tracks.value.size() == 0) return trial;
    const double begin = from.begin.value_or(tracks.time.front());
    if (begin != 0.0)
      say(from.name + ": the trial begins " + io::format_number(begin) + " s into the recording" +
          (from.begin ? ", as --begin says" : ", with its first sample"));
    const Samples all = since(tracks.time, tracks.value, begin);
    if (all.size() == 0)
      miss(from.name + ": no sample at or after " + io::format_number(begin) +
           " s, expected a --begin within the recording (" +
           io::format_number(tracks.time.front()) + " to " + io::format_number(tracks.time.back()) +
           " s)");
    choose_markers(from, all, trial);
    for (const ImportedHold& hold : request_.holds) add_hold(from, all, hold, trial);
    if (from.force) add_force(from, trial);
    say(from.name + ": " + from.recording.program + ", " + std::to_string(all.size()) +
        " samples of " + std::to_string(request_.places.size()) + " markers over " +
        io::format_number(trial.duration()) + " s");
    return trial;
  }

  void choose_markers(const ImportedTrial& from, const Samples& all, Trial& trial) {
    std::set<std::string> used;
    trial.markers.time = all.time;
    trial.markers.value.resize(all.value.rows(),
                               static_cast<Eigen::Index>(3 * request_.places.size()));
    for (std::size_t m = 0; m < request_.places.size(); ++m) {
      const int index = index_of(from.recording, request_.places[m].point, "--place");
      used.insert(request_.places[m].point);
      if (index < 0) continue;
      const auto seen = all.value.middleCols<3>(3 * index);
      trial.markers.value.middleCols<3>(static_cast<Eigen::Index>(3 * m)) = seen;
      if (seen.array().isNaN().all())
        miss(from.name + ": point " + in_quotes(request_.places[m].point) +
             " is never seen in this trial, expected another --begin or no --place for it");
    }
    for (const ImportedHold& hold : request_.holds) used.insert(hold.point);
    std::vector<std::string> left;
    for (const std::string& name : from.recording.names)
      if (!used.contains(name)) left.push_back(name);
    if (!left.empty())
      say(from.name + ": left out, since nobody says where they sit: " + list_of_names(left));
  }

  int index_of(const Recording& recording, const std::string& point, const std::string& option) {
    const int index = recording.index_of(point);
    if (index < 0)
      miss(option + ": " + recording.file.string() + " has no point " + in_quotes(point) +
           ", expected one of " + list_of_names(recording.names));
    return index;
  }

  void add_hold(const ImportedTrial& from, const Samples& all, const ImportedHold& hold,
                Trial& trial) {
    Hold made;
    made.place = hold.place;
    made.stiffness = hold.stiffness;
    if (from.release) made.release = *from.release;
    if (hold.point.empty()) {
      made.path = machine_path(from, hold);
    } else if (const int index = index_of(from.recording, hold.point, "--hold"); index >= 0) {
      made.path = path_of(all, index);
      const auto gaps = static_cast<std::size_t>(all.size()) - made.path.time.size();
      if (gaps > 0)
        say(from.name + ": " + std::to_string(gaps) + " samples do not see " +
            in_quotes(hold.point) + ", which leads: its path is straight between the others");
    }
    if (made.path.time.empty() && notes_.missing.empty())
      miss(from.name + ": no sample of what leads " + hold.place.curve + ", expected a path");
    trial.holds.push_back(std::move(made));
  }

  /// From where the plant is drawn, as far as the machine goes.
  DrivenPath machine_path(const ImportedTrial& from, const ImportedHold& hold) {
    DrivenPath path;
    const int curve = request_.plant.curve_index(hold.place.curve);
    if (!from.force || from.force->extension.empty() || !request_.extension_direction) {
      miss(from.name +
           ": --lead takes the way of a machine, expected --force with a table of it, "
           "--extension-column and --force-direction");
      return path;
    }
    if (curve < 0 || !from.force_begin) return path;
    const Vec3 start =
        drawn_point(request_.plant.curves[static_cast<std::size_t>(curve)], hold.place.at);
    const std::vector<double>& way = from.force->extension;
    double zero = std::nan("");
    for (std::size_t r = 0; r < way.size(); ++r) {
      const double time = on_clock(from.force->time[r], *from.force_begin);
      if (time < 0.0 || std::isnan(way[r])) continue;
      if (std::isnan(zero)) zero = way[r];
      path.time.push_back(time);
      path.position.push_back(start + (way[r] - zero) * *request_.extension_direction);
    }
    return path;
  }

  void add_force(const ImportedTrial& from, Trial& trial) {
    if (trial.holds.empty())
      miss(from.name + ": a force needs what holds the plant, expected --hold or --lead");
    if (!from.force_begin) {
      miss(from.name +
           ": the force table has a clock of its own, expected --force-begin with its time "
           "when the trial begins (0 where both began together)");
      return;
    }
    if (from.force->value.rows() == 0) return;
    trial.force = since(from.force->time, from.force->value, *from.force_begin);
    if (trial.force.size() == 0)
      miss(from.name + ": no force at or after " + io::format_number(*from.force_begin) +
           " s, expected a --force-begin within the table");
  }

  const ImportRequest& request_;
  ImportNotes& notes_;
};

}  // namespace

Experiment import_experiment(const ImportRequest& request, ImportNotes& notes) {
  return Importer(request, notes).make();
}

}  // namespace pedicel::discrepancy
