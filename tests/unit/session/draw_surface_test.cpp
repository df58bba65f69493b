// Rays to places: planes, bodies, and the strokes that are drawn on them.
#include "app/session/live/draw_surface.h"

#include <gmock/gmock.h>

#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

geometry::Ray towards(const Vec3& from, const Vec3& to) {
  return {from, (to - from).normalized()};
}

TEST(DrawPlanes, MeetRaysInFront) {
  const geometry::Ray ray = towards({0, -2, 1}, {0.1, 0, 0.5});
  const auto place = meet(ray, view_plane(Vec3::UnitY(), {5, 0, 5}));
  ASSERT_TRUE(place.has_value());
  EXPECT_NEAR((*place - Vec3(0.1, 0, 0.5)).norm(), 0.0, 1.0e-12);
  EXPECT_FALSE(meet(ray, view_plane(Vec3::UnitY(), {0, -3, 0})).has_value()) << "behind";
  EXPECT_FALSE(meet({{0, 0, 1}, Vec3::UnitX()}, ground_plane(0)).has_value()) << "along";
  const DrawPlane tangent = tangent_plane({0, 0.6, 0.8}, Vec3::UnitY(), {0, 0, 1});
  EXPECT_NEAR(tangent.normal.dot(Vec3(0, 0.6, 0.8)), 0.0, 1.0e-12);
  EXPECT_LT(tangent.normal.dot(Vec3::UnitY()), -0.5);
}

TEST(DrawPlanes, UprightOnesStandAndFaceTheView) {
  const Vec3 view = Vec3(1, 2, -1.5).normalized(), point(0.1, 0.2, 0.3);
  const DrawPlane plane = upright_plane(view, point);
  EXPECT_EQ(plane.normal.z(), 0.0);
  EXPECT_NEAR(plane.normal.norm(), 1.0, 1.0e-12);
  EXPECT_NEAR(plane.normal.dot(Vec3(-1, -2, 0).normalized()), 1.0, 1.0e-12);
  const DrawPlane above = upright_plane(Vec3(0.01, 0, -1), point);
  EXPECT_GT(above.normal.z(), 0.99) << "seen from straight above";
}

// A person draws a line up in the picture, and means a stem that stands.
TEST(DrawPlanes, AStrokeUpThePictureStandsUpright) {
  const Vec3 eye(-1, -1.5, 1.2), foot(0.2, 0.1, 0.0), forward = (foot - eye).normalized();
  StrokeProjector stroke(ProjectorOptions{}, forward, nullptr);
  stroke.set_fallback(foot);
  EXPECT_NEAR((*stroke.place(towards(eye, foot)) - foot).norm(), 0.0, 1.0e-12);
  const Vec3 right = forward.cross(Vec3::UnitZ()).normalized(), up = right.cross(forward);
  for (const double height : {0.1, 0.2, 0.4}) {
    const auto place = stroke.place(towards(eye, foot + height * up));
    ASSERT_TRUE(place);
    EXPECT_NEAR((*place - foot).head<2>().norm(), 0.0, 1.0e-9);
    EXPECT_GT(place->z(), height);
  }
}

class Scene : public ::testing::Test {
 protected:
  Scene() : session(waiting()) {
    must(session.run_text("open " +
                          source("assets/scenes/cherry_tomato_pull_up.scene.yaml").string()));
    now = session.snapshot();
  }
  Session session;
  std::shared_ptr<const Snapshot> now;
};

TEST_F(Scene, SurfacesAreHitFromOutside) {
  const Surfaces surfaces(*now);
  ASSERT_TRUE(now->robot.present);
  int hits = 0;
  for (const Pose& link : now->robot.links) {
    const Vec3 eye = link.position + Vec3(-1.5, -1.5, 1.0);
    const auto hit = surfaces.hit(towards(eye, link.position));
    if (!hit) continue;
    ++hits;
    EXPECT_LT(hit->normal.dot(link.position - eye), 0.0) << hit->name;
    EXPECT_NEAR(hit->normal.norm(), 1.0, 1.0e-6);
    EXPECT_GT(hit->depth, 0.1);
  }
  EXPECT_GT(hits, static_cast<int>(now->robot.links.size()) / 2);
  EXPECT_FALSE(surfaces.hit({{0, 0, 3}, Vec3::UnitZ()}).has_value());
}

TEST_F(Scene, AStrokeKeepsTheDepthOfItsStart) {
  const Surfaces surfaces(*now);
  const Vec3 eye(-2, -2, 2), forward = Vec3(1, 1, -0.7).normalized();
  ProjectorOptions options;
  options.plane = StrokePlane::view;
  StrokeProjector on_stem(options, forward, &surfaces);
  const Vec3 snap(0.1, 0.2, 0.5);
  on_stem.start_on_stem(snap, Vec3::UnitZ());
  EXPECT_EQ(*on_stem.place(towards(eye, snap + Vec3(0.001, 0, 0))), snap);
  const auto next = on_stem.place(towards(eye, snap + Vec3(0, 0, 0.1)));
  ASSERT_TRUE(next.has_value());
  EXPECT_NEAR((*next - snap).dot(forward), 0.0, 1.0e-9);

  options.plane = StrokePlane::ground;
  StrokeProjector on_ground(options, forward, &surfaces);
  EXPECT_NEAR(on_ground.place(towards(eye, {0.3, 0.2, -0.5}))->z(), 0.0, 1.0e-12);
}

TEST_F(Scene, AStrokeOnSurfacesFollowsThem) {
  const Surfaces surfaces(*now);
  ProjectorOptions options;
  options.plane = StrokePlane::surface;
  options.only_first = false;
  options.offset = 0.01;
  const Vec3 eye(3, 3, 2);
  StrokeProjector follows(options, (-eye).normalized(), &surfaces);
  for (const double x : {1.5, 1.8, 2.1}) {
    const geometry::Ray ray = towards(eye, {x, 1.5, 0});
    const auto hit = surfaces.hit(ray);
    const auto place = follows.place(ray);
    ASSERT_EQ(hit.has_value(), place.has_value());
    if (!hit) continue;
    EXPECT_NEAR((*place - hit->point - 0.01 * hit->normal).norm(), 0.0, 1.0e-9);
  }
}

}  // namespace
}  // namespace pedicel::app
