#include <gmock/gmock.h>

#include <cmath>

#include "app/draw/pictures.h"
#include "app/draw/plant_drawing.h"
#include "engine/core/random.h"
#include "engine/render/colormap.h"

namespace pedicel::app {
namespace {

using cosserat::RodModel;
using cosserat::RodState;
using render::DrawList;

constexpr double radius = 0.004;  // m

int add(RodModel& model, int parent, const Vec3& end, int organ) {
  const int e = add_element(model, parent, end, cosserat::circle_section(radius, {}));
  model.elements[e].radius_near = model.elements[e].radius_far = radius;
  model.elements[e].organ = organ;
  return e;
}

/// A stem of four elements up Z (0 .. 3), a branch of two from the second (4, 5) with a fruit.
RodModel branched() {
  RodModel model;
  model.organs = {"plant/stem", "plant/branch"};
  for (int e = 0; e < 4; ++e) add(model, e - 1, Vec3(0, 0, 0.05 * (e + 1)), 0);
  add(model, 1, Vec3(0.05, 0, 0.1), 1);
  add(model, 4, Vec3(0.1, 0, 0.1), 1);
  cosserat::Fruit fruit;
  fruit.name = "fruit";
  fruit.element = 5;
  fruit.radius = 0.015;
  fruit.density = 900.0;
  model.fruits = {fruit};
  finish(model);
  return model;
}

int spheres_of_radius(const DrawList& list, double wanted) {
  int count = 0;
  for (const render::Sphere& sphere : list.spheres) count += sphere.radius == wanted;
  return count;
}

Pose random_pose(Random& random) {
  Pose pose;
  for (int i = 0; i < 3; ++i) pose.position[i] = random.uniform(-1.0, 1.0);
  pose.rotation = Quat(Eigen::AngleAxisd(random.uniform(-3.0, 3.0), Vec3(1, 2, -1).normalized()));
  return pose;
}

TEST(PlantDrawing, DrawsAnOrganAsOneTubeThroughItsElements) {
  const RodModel model = branched();
  const RodState state = drawn_state(model);
  DrawList list;
  PlantDrawing(model).add_to(list, state);
  ASSERT_EQ(list.tubes.size(), 6u);
  for (int e = 0; e < 4; ++e) {
    EXPECT_NEAR((list.tubes[e].p0 - start_of(model, state, e)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((list.tubes[e].p1 - state.position[e]).norm(), 0.0, 1e-12);
  }
  EXPECT_NEAR((list.tubes[4].p0 - state.position[1]).norm(), 0.0, 1e-12);  // leaves the stem
}

TEST(PlantDrawing, LeavesOutWhatHasComeOff) {
  const RodModel model = branched();
  RodState state = drawn_state(model);
  const PlantDrawing drawing(model);
  DrawList whole, without_fruit, without_branch_end;
  drawing.add_to(whole, state);
  EXPECT_EQ(spheres_of_radius(whole, 0.015), 1);
  state.fruit_gone[0] = true;
  drawing.add_to(without_fruit, state);
  EXPECT_EQ(spheres_of_radius(without_fruit, 0.015), 0);
  EXPECT_EQ(without_fruit.tubes.size(), 6u);
  state.alive[5] = 0;
  drawing.add_to(without_branch_end, state);
  EXPECT_EQ(without_branch_end.tubes.size(), 5u);
}

TEST(PlantDrawing, ADeadMiddleElementSplitsTheTube) {
  const RodModel model = branched();
  RodState state = drawn_state(model);
  state.alive[2] = 0;
  DrawList list;
  PlantDrawing(model).add_to(list, state);
  EXPECT_EQ(list.tubes.size(), 5u);
  EXPECT_TRUE(list.tubes[1].rounded);                                      // below the gap
  EXPECT_NEAR((list.tubes[2].p0 - state.position[2]).norm(), 0.0, 1e-12);  // above it
}

TEST(PlantDrawing, BladesFollowTheirElementsAndGoWithThem) {
  const RodModel model = branched();
  RodState state = drawn_state(model);
  const PlantDrawing drawing(model, {{{{3, 0.0}, {4, 0.0}, {5, 0.025}}}});
  state.position[4] += Vec3(0, 0.01, 0);
  DrawList list;
  drawing.add_to(list, state);
  const auto blade = list.blades.front();  // before the fruit's sepals
  EXPECT_NEAR((blade.a - state.position[3]).norm(), 0.0, 1e-12);
  EXPECT_NEAR((blade.b - state.position[4]).norm(), 0.0, 1e-12);
  EXPECT_NEAR((blade.c - 0.5 * (state.position[4] + state.position[5])).norm(), 0.0, 1e-12);
  const std::size_t before = list.blades.size();
  state.alive[3] = 0;
  list.clear();
  drawing.add_to(list, state);
  EXPECT_EQ(list.blades.size(), before - 1);
}

// A rod stretched by 3 % has |C_s| = 0.03 everywhere; joints bent by 0.1 rad a 0.05 m element have
// the curvature 2 1/m, which at radius 4 mm strains the surface by 0.008.
TEST(PlantDrawing, SurfaceStrainIsStretchPlusRadiusTimesCurvature) {
  RodModel model;
  model.organs = {"rod"};
  for (int e = 0; e < 5; ++e) add(model, e - 1, Vec3(0, 0, 0.05 * (e + 1)), 0);
  finish(model);
  RodState stretched = drawn_state(model);
  for (Vec3& p : stretched.position) p.z() *= 1.03;
  for (int e = 0; e < 5; ++e)
    EXPECT_NEAR(simulation::surface_strain(model, stretched, e), 0.03, 1e-9);

  RodState bent = drawn_state(model);
  Vec3 end = Vec3::Zero();
  for (int e = 0; e < 5; ++e) {
    bent.orientation[e] =
        Quat(Eigen::AngleAxisd(0.1 * (e + 1), Vec3::UnitX())) * bent.orientation[e];
    end += 0.05 * (bent.orientation[e] * Vec3::UnitZ());
    bent.position[e] = end;
  }
  // phi is 2 vec(q) in the small-angle limit; the rotation vector would be exactly 0.1.
  for (int e = 0; e < 5; ++e) EXPECT_NEAR(simulation::surface_strain(model, bent, e), 0.008, 1e-5);
}

TEST(PlantDrawing, ColoursStemsByStrainOnRequest) {
  const RodModel model = branched();
  RodState state = drawn_state(model);
  state.position[3].z() += 0.05 * 0.04;  // 4 % in the last element of the stem
  DrawList list;
  PlantDrawing(model).add_to(list, state, 0.04);
  const render::Colour none = render::strain_colour(0.0), full = render::strain_colour(1.0);
  EXPECT_FLOAT_EQ(list.tubes[0].colour0.g, none.g);
  EXPECT_NEAR(list.tubes[3].colour1.g, full.g, 1e-4);
}

TEST(AddAt, ThereAndBackIsWhereItWas) {
  Random random(7);
  DrawList shape;
  shape.add_tube(std::vector<render::TubePoint>{
      {Vec3(0, 0, 0), 0.01, {}}, {Vec3(0.1, 0, 0.1), 0.01, {}}, {Vec3(0.2, 0.1, 0.1), 0.01, {}}});
  shape.add_arrow(Vec3::Zero(), Vec3(0, 0.1, 0), 0.002, {});
  shape.boxes.push_back({random_pose(random), Vec3(0.1, 0.2, 0.3), {}});
  shape.blades.push_back({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), {}});
  shape.lines.push_back({Vec3::UnitX(), Vec3::UnitY(), {}});
  for (int i = 0; i < 20; ++i) {
    const Pose pose = random_pose(random);
    DrawList there, back;
    add_at(there, shape, pose);
    add_at(back, there, pose.inverse());
    EXPECT_NEAR((there.blades[0].b - pose * Vec3::UnitY()).norm(), 0.0, 1e-12);
    EXPECT_NEAR((there.tubes[1].tangent0 - pose.rotation * shape.tubes[1].tangent0).norm(), 0.0,
                1e-12);
    EXPECT_NEAR((back.bounds().min() - shape.bounds().min()).norm(), 0.0, 1e-9);
    EXPECT_NEAR((back.bounds().max() - shape.bounds().max()).norm(), 0.0, 1e-9);
    EXPECT_NEAR((back.tubes[0].side1 - shape.tubes[0].side1).norm(), 0.0, 1e-12);
  }
}

TEST(FruitShape, SepalsLieOnTheStalksSide) {
  const DrawList shape = fruit_shape(FruitLook::tomato(), 2, 0.012, 0.03, 0.001);
  ASSERT_EQ(shape.blades.size(), 25u);  // five sepals of two strips and a tip
  for (const render::BladeFace& t : shape.blades)
    for (const Vec3& corner : {t.a, t.b, t.c}) {
      EXPECT_LT(corner.z(), 0.0);
      EXPECT_GT(corner.norm(), 0.012);
    }
  ASSERT_EQ(shape.capsules.size(), 1u);
  EXPECT_NEAR((shape.capsules[0].p1 - Vec3(0, 0, -0.03)).norm(), 0.0, 1e-12);
  EXPECT_TRUE(fruit_shape(FruitLook::apple(), 0, 0.04).blades.empty());
}

TEST(BodyShape, FillsTheBodysBoundsUnlessHidden) {
  world::BodyDescription body;
  body.parts = world::tray_parts({0.3, 0.2, 0.1}, 0.01);
  world::BodyPart pin;
  pin.kind = world::BodyPart::Kind::cylinder;
  pin.radius = 0.02;
  pin.length = 0.3;
  body.parts.push_back(pin);
  pin.kind = world::BodyPart::Kind::capsule;
  pin.pose.rotation = Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()));
  body.parts.push_back(pin);
  const auto [low, high] = world::bounds_of(body);
  const Eigen::AlignedBox3d box = body_shape(body).bounds();
  EXPECT_NEAR((box.min() - low).norm(), 0.0, 1e-9);
  EXPECT_NEAR((box.max() - high).norm(), 0.0, 1e-9);
  body.look = "hidden";
  EXPECT_TRUE(body_shape(body).bounds().isEmpty());
}

TEST(RobotShapes, HaveOneEntryALinkAndTheColoursOfTheFile) {
  robot::RobotDescription robot;
  robot.links.resize(2);
  robot::Visual visual;
  visual.geometry.kind = robot::Geometry::Kind::box;
  visual.geometry.size = Vec3(0.2, 0.4, 0.6);
  visual.X_LV.position = Vec3(0, 0, 0.3);
  visual.color = Eigen::Vector4d(1.0, 0.5, 0.25, 1.0);
  robot.links[1].visuals = {visual};
  const std::vector<DrawList> shapes = robot_shapes(robot);
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_TRUE(shapes[0].bounds().isEmpty());
  EXPECT_NEAR((shapes[1].bounds().max() - Vec3(0.1, 0.2, 0.6)).norm(), 0.0, 1e-12);
  EXPECT_FLOAT_EQ(shapes[1].boxes[0].material.colour.g, 0.5f);
}

TEST(AddForce, EndsAtThePointItActsOn) {
  DrawList list;
  add_force(list, Vec3(0, 0, 1), Vec3(2, 0, 0), 0.1, render::shadings::accent);
  ASSERT_EQ(list.capsules.size(), 2u);
  EXPECT_NEAR((list.capsules[0].p0 - Vec3(-0.2, 0, 1)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((list.capsules[1].p1 - Vec3(0, 0, 1)).norm(), 0.0, 1e-12);
}

TEST(FrameHistory, KeepsTheLastFramesAndReusesThem) {
  FrameHistory history;
  EXPECT_EQ(history.back(0), nullptr);
  for (int i = 0; i < 5; ++i) {
    Frame& frame = history.next();
    EXPECT_TRUE(frame.list.spheres.empty());
    EXPECT_TRUE(frame.caption.empty());
    frame.time = i;
    frame.caption = "step";
    frame.list.spheres.push_back({});
  }
  ASSERT_NE(history.back(2), nullptr);
  EXPECT_EQ(history.back(0)->time, 4.0);
  EXPECT_EQ(history.back(2)->time, 2.0);
  EXPECT_EQ(history.back(3), nullptr);
}

TEST(CameraOf, MovesWithWhatItFollows) {
  world::SceneCamera camera;
  camera.eye = Vec3(1, 0, 0);
  EXPECT_EQ(camera_of(camera, Vec3(5, 5, 5)).eye, Vec3(1, 0, 0));
  camera.follow.kind = world::Anchor::Kind::tool;
  EXPECT_EQ(camera_of(camera, Vec3(5, 5, 5)).eye, Vec3(6, 5, 5));
  EXPECT_EQ(camera_of(camera, Vec3(5, 5, 5)).target, Vec3(5, 5, 5));
}

TEST(PictureTaker, ShowsARipeFruitWhereItIs) {
  PictureTaker taker;
  if (!taker.available()) GTEST_SKIP() << taker.why();
  const RodModel model = branched();
  const RodState state = drawn_state(model);
  Frame frame;
  PlantDrawing(model).add_to(frame.list, state);
  render::Camera camera = render::frame(frame.list.bounds());
  const auto image = taker.take(frame, camera, 320, 180);
  ASSERT_TRUE(image);
  const render::PixelPoint at = camera.project(state.position[5], 320, 180);
  const std::uint8_t* pixel = image->at(static_cast<int>(at.x), static_cast<int>(at.y));
  EXPECT_GT(pixel[0], pixel[1] + 60);
  EXPECT_GT(pixel[0], pixel[2] + 60);
  frame.caption = "caption";
  EXPECT_NE(taker.take(frame, camera, 320, 180)->rgb, image->rgb);
}

}  // namespace
}  // namespace pedicel::app
