#include "app/playback/log_film.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/draw/drawing.h"
#include "app/playback/drawn_markers.h"
#include "engine/mcap/reader.h"
#include "engine/ros_messages/cdr.h"
#include "engine/urdf/urdf_reader.h"

namespace pedicel::app {

namespace {

constexpr const char* root_frame = "world";
constexpr const char* description_topic = "/robot_description";

double time_of_markers(const ros::MarkerArray& array) {
  return array.markers.empty() ? 0.0 : ros::seconds_of(array.markers.front().header.stamp);
}

}  // namespace

bool is_playable(const std::string& file) {
  return mcap::is_mcap(file);
}

LogFilm::LogFilm(const std::filesystem::path& file, const std::vector<std::string>& packages)
    : file_(file), log_(discrepancy::read_log(file)) {
  if (!log_.whole)
    notes_.push_back("the log has no end (a run that was killed?); what was whole is shown");
  read_markers();
  read_robot(packages);
  find_times();
}

void LogFilm::read_markers() {
  std::size_t bytes = 0;
  mcap::read(file_, [&](const mcap::Message& message) {
    if (message.channel.topic == description_topic) {
      const auto said = message.channel.metadata.find("file");
      if (said != message.channel.metadata.end()) urdf_ = said->second;
    }
    if (message.schema.name != ros::MarkerArray::name || message.channel.message_encoding != "cdr")
      return;
    const auto array = ros::from_cdr<ros::MarkerArray>(message.data);
    if (!array || array->markers.empty()) return;
    bytes += message.data.size();
    if (bytes > most_markers)
      throw InvalidFile({file_.string()}, "more than 2 GB of markers, expected a shorter log");
    std::vector<Marked>& series = markers_[message.channel.topic];
    const double time = time_of_markers(*array);
    if (series.empty() || time > series.back().time)
      series.push_back({time, std::string(message.data)});
  });
}

void LogFilm::read_robot(const std::vector<std::string>& packages) {
  const auto text = log_.texts.find(description_topic);
  if (text == log_.texts.end() || text->second.empty()) return;
  robot::PackagePaths paths = robot::PackagePaths::from_environment();
  for (const std::string& package : packages) paths.add(package);
  Diagnostics diagnostics;
  // Meshes lie beside the URDF, wherever that was.
  robot_ = robot::parse_urdf(text->second.front().value, urdf_.empty() ? file_ : urdf_, paths,
                             diagnostics);
  if (robot_)
    shapes_ = robot_shapes(*robot_);
  else
    notes_.push_back("the robot is left out: " + diagnostics.text());
}

void LogFilm::find_times() {
  begin_ = std::numeric_limits<double>::infinity();
  end_ = -begin_;
  const auto add = [&](double first, double last) {
    begin_ = std::min(begin_, first);
    end_ = std::max(end_, last);
  };
  for (const auto& [topic, series] : markers_) add(series.front().time, series.back().time);
  for (const auto& [frame, series] : log_.frames)
    if (!series.empty()) add(series.front().stamp, series.back().stamp);
  if (begin_ > end_)
    throw InvalidFile({file_.string()},
                      "nothing in it can be shown, expected /tf or markers (MarkerArray)");
}

std::optional<Vec3> LogFilm::place_of(const std::string& frame, double time) const {
  const Pose pose = discrepancy::frame_at(log_, frame, root_frame, time, false);
  if (pose.position.hasNaN()) return std::nullopt;
  return pose.position;
}

void LogFilm::fill(double time, render::DrawList& list) const {
  for (std::size_t l = 0; l < shapes_.size(); ++l) {
    const Pose pose = discrepancy::frame_at(log_, robot_->links[l].name, root_frame, time, false);
    if (!pose.position.hasNaN()) add_at(list, shapes_[l], pose);
  }
  for (const auto& [topic, series] : markers_) {
    const auto after = std::ranges::upper_bound(series, time, {}, &Marked::time);
    const auto before = after == series.begin() ? after : after - 1;
    const auto now = ros::from_cdr<ros::MarkerArray>(before->cdr);
    if (after == series.end() || after == before) {
      add_markers(list, *now);
      continue;
    }
    const double share = (time - before->time) / (after->time - before->time);
    add_markers(list, between(*now, *ros::from_cdr<ros::MarkerArray>(after->cdr), share));
  }
}

std::string LogFilm::event_at(double time) const {
  std::string last;
  for (const auto& [topic, texts] : log_.texts) {
    if (!topic.ends_with("events")) continue;
    for (const auto& one : texts) {
      const auto json = nlohmann::json::parse(one.value, nullptr, false);
      if (!json.is_object() || one.stamp > time) continue;
      const auto word = [&](const char* key) {
        return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
      };
      char when[40];
      std::snprintf(when, sizeof when, "t = %.3f s: ", one.stamp);
      last = when + word("what") + " " + word("event");
    }
  }
  return last;
}

}  // namespace pedicel::app
