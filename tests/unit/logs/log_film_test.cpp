// A log as pictures, without its scene.
#include "app/playback/log_film.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/playback/drawn_markers.h"
#include "app/playback/play_off_screen.h"
#include "engine/core/diagnostics.h"
#include "engine/mcap/writer.h"
#include "engine/render/offscreen.h"
#include "engine/ros_messages/cdr.h"
#include "tests/unit/logs/logged_run.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

TEST(LogFilm, ShowsPlantAndFrames) {
  const LoggedRun run("0.03", 1.0);
  const LogFilm film(run.log_file(), {});
  EXPECT_TRUE(is_playable(run.log_file().string()));
  EXPECT_TRUE(film.notes().empty()) << film.notes().front();
  EXPECT_EQ(film.begin(), 0.0);
  EXPECT_NEAR(film.end(), 1.0, 1e-9);
  render::DrawList first, last;
  film.fill(0.0, first);
  film.fill(film.end(), last);
  ASSERT_FALSE(first.tubes.empty());
  EXPECT_EQ(first.tubes.size(), last.tubes.size());
  // The stem's far end as it is drawn, and where the finger pushed it.
  EXPECT_LT((first.tubes.back().p1 - Vec3(0.4, 0.03, 0.6)).norm(), 1e-6);
  EXPECT_GT((last.tubes.back().p1 - first.tubes.back().p1).norm(), 0.01);
  const auto finger = film.place_of("finger", 0.55);
  ASSERT_TRUE(finger);
  EXPECT_NEAR(finger->y(), 0.4 * std::sin(run.joint(0.55)), 1e-3);
  EXPECT_FALSE(film.place_of("nobody", 0.5));
}

TEST(LogFilm, MarkersAreInBetweenTwoMessages) {
  ros::Marker one;
  one.type = ros::Marker::sphere;
  one.scale = {0.2, 0.2, 0.2};
  ros::Marker two = one;
  two.pose.position = {1.0, 0.0, 2.0};
  const auto third = between({{one}}, {{two}}, 0.25);
  render::DrawList list;
  add_markers(list, third);
  ASSERT_EQ(list.spheres.size(), 1U);
  EXPECT_EQ(list.spheres[0].centre, Vec3(0.25, 0.0, 0.5));
  EXPECT_EQ(list.spheres[0].radius, 0.1);
  // Another marker has no way in between.
  two.id = 7;
  EXPECT_EQ(between({{one}}, {{two}}, 0.25).markers[0].pose.position.x, 0.0);
}

TEST(LogFilm, DrawsEveryKindThatWeSend) {
  ros::MarkerArray all;
  for (const std::int32_t type :
       {ros::Marker::cube, ros::Marker::sphere, ros::Marker::cylinder, ros::Marker::line_list,
        ros::Marker::line_strip, ros::Marker::sphere_list, ros::Marker::triangle_list}) {
    ros::Marker marker;
    marker.type = type;
    marker.scale = {0.1, 0.1, 0.4};
    marker.points = {{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 2}};
    all.markers.push_back(marker);
  }
  all.markers.push_back({});
  all.markers.back().type = 99;
  ros::Marker gone = all.markers[0];
  gone.action = ros::Marker::remove;
  all.markers.push_back(gone);
  render::DrawList list;
  add_markers(list, all);
  EXPECT_EQ(list.boxes.size(), 1U);
  EXPECT_EQ(list.spheres.size(), 5U);
  ASSERT_EQ(list.meshes.size(), 1U) << "a cylinder with flat ends";
  double highest = 0.0;
  for (const Vec3& vertex : list.meshes[0].mesh->vertices)
    highest = std::max(highest, std::abs(vertex.z()));
  EXPECT_DOUBLE_EQ(highest, 0.2);
  EXPECT_EQ(list.blades.size(), 1U);
  EXPECT_EQ(list.tubes.size(), 2U + 3U) << "two lines that do not meet, and a strip";
}

TEST(LogFilm, LeavesOutWhatHasNoSizeOrNoPlace) {
  ros::MarkerArray all;
  const double none = std::nan(""), most = 1.7e308;
  for (std::int32_t type = 0; type < 14; ++type)
    for (const double bad : {none, 1.0 / 0.0, most}) {
      ros::Marker marker;
      marker.type = type;
      marker.scale = {0.1, 0.1, 0.1};
      marker.points = {{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 2}};
      ros::Marker sized = marker, placed = marker, turned = marker, bent = marker;
      sized.scale = {bad, bad, bad};
      placed.pose.position = {0, bad, 0};
      turned.pose.orientation = {0, 0, bad, 1};
      bent.points[2].z = bad;
      for (const ros::Marker& one : {sized, placed, turned, bent}) all.markers.push_back(one);
      if (type != ros::Marker::triangle_list) {
        marker.scale = {0.0, 0.0, 0.0};
        all.markers.push_back(marker);
      }
    }
  render::DrawList list;
  add_markers(list, all);
  EXPECT_TRUE(list.boxes.empty() && list.spheres.empty() && list.meshes.empty());
  EXPECT_TRUE(list.tubes.empty() && list.blades.empty());
}

TEST(LogFilm, RefusesALogWithNothingToSee) {
  const LoggedRun run("0.3", 0.01);
  const auto file = run.path("empty.mcap");
  {
    mcap::Writer writer(file, {});
    const auto channel = writer.add_channel(
        "/clock",
        {ros::Clock::name, "ros2msg", ros::schema_text(ros::definitions_of<ros::Clock>())});
    writer.write(channel, 5, ros::to_cdr(ros::Clock{}));
  }
  try {
    const LogFilm film(file, {});
    FAIL() << "expected a refusal";
  } catch (const InvalidFile& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("nothing in it can be shown, expected /tf or markers"));
  }
}

TEST(LogFilm, BecomesAPictureAndAFilm) {
  std::string why;
  if (!render::OffscreenContext::create(why)) GTEST_SKIP() << why;
  const LoggedRun run("0.03", 0.3);
  PlayRequest request;
  request.log = run.log_file().string();
  request.film = run.path("frame_%05d.png").string();
  request.picture = run.path("end.png").string();
  request.size = {96, 64};
  request.fps = 10.0;
  request.quiet = true;
  EXPECT_EQ(play_off_screen(request), 0);
  EXPECT_GT(std::filesystem::file_size(run.path("end.png")), 500U);
  EXPECT_TRUE(std::filesystem::exists(run.path("frame_00003.png")));
  EXPECT_FALSE(std::filesystem::exists(run.path("frame_00004.png")));
}

}  // namespace
}  // namespace pedicel::app
