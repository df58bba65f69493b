#include "engine/render/renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/core/check.h"
#include "engine/render/mesh_normals.h"
#include "engine/render/offscreen.h"

namespace pedicel::render {
namespace {

constexpr int width = 480, height = 320;
const Shading red{Colour::hex(0xd02020), 0.6f, 0.0f};
const Shading green{Colour::hex(0x20b020), 0.6f, 0.0f};

double brightness(const Image& image, int x, int y) {
  const std::uint8_t* p = image.at(x, y);
  return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
}
double brightness(const Image& image, const PixelPoint& p) {
  return brightness(image, static_cast<int>(p.x), static_cast<int>(p.y));
}
bool is_red(const std::uint8_t* p) {
  return p[0] > p[1] + 30 && p[0] > p[2] + 30;
}
bool is_green(const std::uint8_t* p) {
  return p[1] > p[0] + 30 && p[1] > p[2] + 30;
}

/// Every case needs a context; without OSMesa all of them are skipped, and say why.
class RendererTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string why;
    context_ = OffscreenContext::create(why);
    if (!context_) GTEST_SKIP() << why;
    renderer_ = std::make_unique<Renderer>(context_->gl());
    list_.ground.reset();
    camera_ = {Vec3(0, -2, 0), Vec3::Zero()};
  }

  Image picture() { return renderer_->render(list_, camera_, width, height); }

  std::unique_ptr<OffscreenContext> context_;
  std::unique_ptr<Renderer> renderer_;
  DrawList list_;
  Camera camera_;
};

TEST_F(RendererTest, EmptyListShowsSkyAndGround) {
  list_.ground = Ground{-0.5};
  const Image image = picture();
  EXPECT_GT(brightness(image, width / 2, 5), 150.0);
  EXPECT_GT(image.at(5, 5)[2], image.at(5, 5)[0]) << "the sky is not bluish";
  EXPECT_LE(image.at(5, height - 5)[2], image.at(5, height - 5)[0]) << "the ground is not warm";
}

// A sphere of radius r whose centre is d away on the axis shows as a disc of f r / sqrt(d^2 - r^2).
TEST_F(RendererTest, SphereCoversTheExpectedPixels) {
  list_.spheres.push_back({Vec3::Zero(), 0.3, red});
  const Image image = picture();
  int covered = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) covered += is_red(&image.rgb[i]);
  const double disc = camera_.focal_length(height) * 0.3 / std::sqrt(4.0 - 0.09);
  EXPECT_NEAR(covered, std::numbers::pi * disc * disc, 0.02 * std::numbers::pi * disc * disc);
}

TEST_F(RendererTest, CapsuleMeshAndBoxCoverTheirProjection) {
  // A box of 0.4 x 0.2 seen face on: its front face lies 1.9 m away.
  list_.boxes.push_back({{}, Vec3(0.2, 0.1, 0.1), red});
  Image image = picture();
  int covered = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) covered += is_red(&image.rgb[i]);
  const double f = camera_.focal_length(height) / 1.9;
  EXPECT_NEAR(covered, 0.4 * 0.2 * f * f, 0.02 * 0.4 * 0.2 * f * f);
  // The same box as a mesh gives the same outline.
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  for (int i = 0; i < 8; ++i)
    mesh->vertices.emplace_back(i & 1 ? 0.2 : -0.2, i & 2 ? 0.1 : -0.1, i & 4 ? 0.1 : -0.1);
  mesh->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  list_.clear();
  list_.meshes.push_back({mesh, {}, red});
  EXPECT_EQ(picture().rgb, image.rgb);
}

// Two spheres of radius r at +-a, far away: a stadium of area pi r^2 + 4 a r.
TEST_F(RendererTest, CapsuleIsAStadium) {
  camera_ = {Vec3(0, -20, 0), Vec3::Zero()};
  camera_.field_of_view = 0.06;
  list_.capsules.push_back({Vec3(-0.3, 0, 0), Vec3(0.3, 0, 0), 0.1, 0.1, red});
  const Image image = picture();
  int covered = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) covered += is_red(&image.rgb[i]);
  const double f = camera_.focal_length(height) / 20.0;
  const double area = (std::numbers::pi * 0.01 + 4 * 0.3 * 0.1) * f * f;
  EXPECT_NEAR(covered, area, 0.02 * area);
}

TEST_F(RendererTest, NearerThingsHideFartherOnesInAnyOrder) {
  list_.spheres.push_back({Vec3(0, -0.5, 0), 0.1, green});
  list_.spheres.push_back({Vec3(0, 0.5, 0), 0.3, red});
  const Image first = picture();
  EXPECT_TRUE(is_green(first.at(width / 2, height / 2)));
  std::swap(list_.spheres[0], list_.spheres[1]);
  EXPECT_TRUE(is_green(picture().at(width / 2, height / 2)));
}

TEST_F(RendererTest, ShadowLiesWhereTheSunPutsIt) {
  const RenderSettings settings;
  list_.ground = Ground{};
  list_.ground->dark = list_.ground->light;
  const Vec3 centre(0, 0, 0.6);
  list_.spheres.push_back({centre, 0.15, red});
  camera_ = {Vec3(0.5, -2.5, 1.2), Vec3(0, 0, 0.2)};
  const Vec3 shadow = centre - settings.to_sun * (centre.z() / settings.to_sun.z());
  const PixelPoint in = camera_.project(shadow, width, height);
  const PixelPoint out = camera_.project(shadow + Vec3(0.5, 0, 0), width, height);
  const Image image = picture();
  EXPECT_LT(brightness(image, in), 0.8 * brightness(image, out));
  RenderSettings bright;
  bright.shadows = false;
  const Image lit = Renderer(context_->gl(), bright).render(list_, camera_, width, height);
  EXPECT_NEAR(brightness(lit, in), brightness(lit, out), 3.0);
}

TEST_F(RendererTest, ThingsOnTheGroundDarkenItAroundThem) {
  RenderSettings settings;
  settings.shadows = false;  // what is left is the contact look
  list_.ground = Ground{};
  list_.ground->dark = list_.ground->light;
  camera_ = {Vec3(0.0, -1.5, 1.0), Vec3::Zero()};
  list_.boxes.push_back({{Vec3(0, 0, 0.1)}, Vec3(0.1, 0.1, 0.1), red});
  const Image image = Renderer(context_->gl(), settings).render(list_, camera_, width, height);
  const double near = brightness(image, camera_.project(Vec3(0, -0.105, 0), width, height));
  const double far = brightness(image, camera_.project(Vec3(0, -0.3, 0), width, height));
  EXPECT_LT(near, far - 5.0);
  EXPECT_GT(near, 0.5 * far);
}

/// Brightness interpolated between the four pixels about a point.
double between_pixels(const Image& image, const PixelPoint& p) {
  const int x = static_cast<int>(p.x - 0.5), y = static_cast<int>(p.y - 0.5);
  const double u = p.x - 0.5 - x, v = p.y - 0.5 - y;
  return (1 - v) * ((1 - u) * brightness(image, x, y) + u * brightness(image, x + 1, y)) +
         v * ((1 - u) * brightness(image, x, y + 1) + u * brightness(image, x + 1, y + 1));
}

/// Brightness along the projected centreline of a bow in the plane across the view.
std::vector<double> along_bow(const Image& image, const Camera& camera, double turn) {
  std::vector<double> values;
  for (int i = 10; i <= 190; ++i) {
    const double a = turn * i / 200.0;
    const Vec3 p(0.4 * std::sin(a) / turn, -0.02, 0.4 * (1.0 - std::cos(a)) / turn);
    values.push_back(between_pixels(image, camera.project(p, image.width, image.height)));
  }
  return values;
}

std::vector<TubePoint> bow(double turn, int pieces) {
  std::vector<TubePoint> points;
  for (int i = 0; i <= pieces; ++i) {
    const double a = turn * i / pieces;
    points.push_back(
        {Vec3(0.4 * std::sin(a) / turn, 0, 0.4 * (1 - std::cos(a)) / turn), 0.02, green.colour});
  }
  return points;
}

TEST_F(RendererTest, ChainHasNoSeams) {
  camera_ = {Vec3(0.2, -1.0, 0.1), Vec3(0.2, 0, 0.1)};
  list_.add_tube(bow(1.2, 8), 0.6f, 0.0f);
  const std::vector<double> values = along_bow(picture(), camera_, 1.2);
  for (std::size_t i = 1; i < values.size(); ++i)
    EXPECT_LT(std::abs(values[i] - values[i - 1]), 4.0) << i;
}

TEST_F(RendererTest, StraightChainOfCapsulesHasNoSeams) {
  camera_ = {Vec3(0.2, -1.0, 0.0), Vec3(0.2, 0, 0.0)};
  const auto points = bow(1e-6, 10);
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    list_.capsules.push_back({points[i].position, points[i + 1].position, 0.02, 0.02, green});
  const std::vector<double> values = along_bow(picture(), camera_, 1e-6);
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  EXPECT_GT(*low, 0.97 * *high);
}

TEST_F(RendererTest, TubeOfFivePiecesEqualsTubeOfTen) {
  camera_ = {Vec3(0.2, -1.0, 0.3), Vec3(0.2, 0, 0.0)};
  list_.add_tube(bow(1e-6, 5));
  const Image five = picture();
  list_.clear();
  list_.add_tube(bow(1e-6, 10));
  const Image ten = picture();
  int different = 0;
  for (std::size_t i = 0; i < five.rgb.size(); ++i)
    different += std::abs(five.rgb[i] - ten.rgb[i]) > 12;
  EXPECT_LT(different, 60);
}

TEST_F(RendererTest, BladesAreSeenFromBothSides) {
  list_.blades.push_back({Vec3(-0.3, 0, -0.3), Vec3(0.3, 0, -0.3), Vec3(0, 0, 0.3), green});
  EXPECT_TRUE(is_green(picture().at(width / 2, height / 2)));
  std::swap(list_.blades[0].a, list_.blades[0].b);
  EXPECT_TRUE(is_green(picture().at(width / 2, height / 2)));
}

TEST_F(RendererTest, LinesHaveTheirWidthAndSurviveTheNearPlane) {
  list_.lines.push_back({Vec3(-0.5, 0, 0), Vec3(0.5, 0, 0), red.colour, 4.0f});
  list_.lines.push_back({Vec3(0, -5, -0.3), Vec3(0, 5, -0.3), green.colour, 3.0f});
  const Image image = picture();
  int rows = 0;
  for (int y = 0; y < height; ++y) rows += is_red(image.at(width / 2 + 20, y));
  EXPECT_NEAR(rows, 4, 1);
  int greens = 0;
  for (int y = height / 2 + 20; y < height; ++y) greens += is_green(image.at(width / 2, y));
  EXPECT_GT(greens, 80) << "the line that passes below the eye is cut off";
}

TEST_F(RendererTest, SameListGivesSameBytes) {
  list_.ground = Ground{};
  list_.add_tube(bow(1.2, 8));
  list_.spheres.push_back({Vec3(0.1, 0, 0.3), 0.1, red});
  list_.blades.push_back({Vec3(-0.3, 0, 0), Vec3(0.3, 0, 0), Vec3(0, 0.2, 0.3), green});
  const Image first = picture();
  EXPECT_EQ(picture().rgb, first.rgb);
  renderer_->render({}, camera_, 64, 64);
  EXPECT_EQ(picture().rgb, first.rgb) << "another picture in between leaves a trace";
  EXPECT_EQ(Renderer(context_->gl()).render(list_, camera_, width, height).rgb, first.rgb);
}

TEST_F(RendererTest, AMeshThatChangedPlacesIsNotMistakenForTheOld) {
  const auto triangle = [](double size) {
    geometry::TriangleMesh mesh;
    mesh.vertices = {{-size, 0, -size}, {size, 0, -size}, {0, 0, size}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
  };
  alignas(geometry::TriangleMesh) std::byte place[sizeof(geometry::TriangleMesh)];
  const auto at_same_address = [&](double size) {
    return std::shared_ptr<const geometry::TriangleMesh>(
        new (place) geometry::TriangleMesh(triangle(size)),
        [](geometry::TriangleMesh* mesh) { mesh->~TriangleMesh(); });
  };
  const auto reds = [&](double size) {
    list_.clear();
    list_.meshes.push_back({at_same_address(size), {}, red});
    const Image image = picture();
    int count = 0;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) count += is_red(&image.rgb[i]);
    list_.clear();
    return count;
  };
  EXPECT_GT(reds(0.4), 10 * reds(0.1));
}

TEST_F(RendererTest, AMeshWithAHoleIsSeenFromInside) {
  // A closed box, and the same without the side that looks at the camera: its far side shows.
  auto closed = std::make_shared<geometry::TriangleMesh>();
  for (int i = 0; i < 8; ++i)
    closed->vertices.emplace_back(i & 1 ? 0.4 : -0.4, i & 2 ? 0.4 : -0.4, i & 4 ? 0.4 : -0.4);
  closed->triangles = {{0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1},
                       {4, 5, 7}, {4, 7, 6}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  EXPECT_TRUE(is_closed(*closed));
  auto open = std::make_shared<geometry::TriangleMesh>(*closed);
  open->triangles.erase(open->triangles.begin(), open->triangles.begin() + 2);
  EXPECT_FALSE(is_closed(*open));
  auto inside_out = *closed;
  for (auto& triangle : inside_out.triangles) std::swap(triangle[1], triangle[2]);
  EXPECT_FALSE(is_closed(inside_out));
  const auto depth = [&](const std::shared_ptr<geometry::TriangleMesh>& mesh) {
    list_.meshes = {{mesh, Pose{}, red}};
    const LabelMap map = renderer_->label(list_, camera_, width, height);
    EXPECT_TRUE(is_red(picture().at(width / 2, height / 2)));
    return map.depth[map.index(width / 2, height / 2)];
  };
  EXPECT_NEAR(depth(closed), 1.6, 1e-4);
  EXPECT_NEAR(depth(open), 2.4, 1e-4);
}

TEST_F(RendererTest, FarThingsCostFewTriangles) {
  for (int i = 0; i < 100; ++i)
    list_.capsules.push_back({Vec3(i, 0, 0), Vec3(i, 0, 1), 0.1, 0.1, green});
  camera_ = frame(list_.bounds());
  picture();
  const long far = renderer_->triangles();
  camera_ = {Vec3(0, -1, 0.5), Vec3(0, 0, 0.5)};
  picture();
  EXPECT_LT(far, 100 * 80);
  EXPECT_LT(renderer_->triangles(), far) << "what is out of sight is still drawn";
}

TEST_F(RendererTest, RefusesBadSizesAndSettings) {
  using testing::HasSubstr;
  EXPECT_THAT([&] { renderer_->render(list_, camera_, 0, 10); },
              testing::ThrowsMessage<UsageError>(HasSubstr("picture of 0 x 10 px: must be")));
  EXPECT_THROW(renderer_->render(list_, camera_, 10, 9000), UsageError);
  RenderSettings settings;
  settings.samples = 3;
  EXPECT_THAT([&] { Renderer(context_->gl(), settings); },
              testing::ThrowsMessage<UsageError>(HasSubstr("samples = 3: must be 1, 2 or 4")));
  settings = {};
  settings.to_sun.z() = -1.0;
  EXPECT_THROW(check(settings), UsageError);
  settings = {};
  settings.shadow_size = 10;
  EXPECT_THROW(check(settings), UsageError);
  settings = {};
  settings.exposure = 0.0;
  EXPECT_THROW(check(settings), UsageError);
}

TEST_F(RendererTest, AGhostLetsThroughWhatIsBehindItAndHidesNothingBeforeIt) {
  const auto ball = [](const Vec3& centre, const Shading& material) {
    DrawList list;
    list.spheres.push_back({centre, 0.25, material});
    return list;
  };
  const Image empty = picture();
  list_ = ball(Vec3(-0.4, 0, 0), red);
  list_.ground.reset();
  const Image without = picture();
  // One part before the red ball, one behind it, one beside it that lies twice over itself.
  DrawList ghost = ball(Vec3(-0.5, -0.6, 0), green);
  ghost.spheres.push_back({Vec3(-0.4, 0.8, 0), 0.1, green});
  ghost.spheres.push_back({Vec3(0.5, 0, 0), 0.25, green});
  const auto once = std::make_shared<DrawList>(ghost);
  ghost.spheres.push_back({Vec3(0.5, 0.05, 0), 0.2, green});
  list_.ghost = once;
  const Image with = picture();
  const auto at = [&](const Vec3& p) {
    const PixelPoint pixel = camera_.project(p, width, height);
    return std::pair{static_cast<int>(pixel.x), static_cast<int>(pixel.y)};
  };
  const auto [before_x, before_y] = at(Vec3(-0.4, -0.3, 0));
  const std::uint8_t *mixed = with.at(before_x, before_y), *plain = without.at(before_x, before_y);
  EXPECT_LT(mixed[0] + 20, plain[0]) << "less red through the ghost";
  EXPECT_GT(mixed[0], mixed[2] + 20) << "and still red";
  EXPECT_GT(mixed[1], plain[1] + 10);
  const auto [beside_x, beside_y] = at(Vec3(0.5, 0, 0));
  EXPECT_TRUE(is_green(with.at(beside_x, beside_y)));
  EXPECT_GT(with.at(beside_x, beside_y)[0], empty.at(beside_x, beside_y)[0] * 0.4)
      << "the sky through it";
  list_.ghost = std::make_shared<DrawList>(ghost);
  EXPECT_EQ(picture().rgb, with.rgb) << "nothing of it shows through itself";
  list_.ghost.reset();
  EXPECT_EQ(picture().rgb, without.rgb);
  list_.ghost = once;
  list_.clear();
  EXPECT_FALSE(list_.ghost);
}

}  // namespace
}  // namespace pedicel::render
