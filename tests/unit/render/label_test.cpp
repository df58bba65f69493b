#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "engine/geometry/primitives_mesh.h"
#include "engine/render/offscreen.h"
#include "engine/render/renderer.h"

namespace pedicel::render {
namespace {

constexpr int width = 320, height = 240;

/// Labels and depths against rays through the middles of the pixels.
class LabelTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string why;
    context_ = OffscreenContext::create(why);
    if (!context_) GTEST_SKIP() << why;
    renderer_ = std::make_unique<Renderer>(context_->gl());
    list_.ground.reset();
    camera_ = {Vec3(0.1, -1, 0.4), Vec3(0, 0, 0.05)};
  }

  LabelMap map() { return renderer_->label(list_, camera_, width, height); }
  geometry::Ray ray(int x, int y) const {
    return camera_.unproject(x + 0.5, y + 0.5, width, height);
  }
  /// m along the view axis, of a point at that distance along a ray.
  double depth_at(const geometry::Ray& ray, double distance) const {
    return distance * ray.direction.dot((camera_.target - camera_.eye).normalized());
  }

  std::unique_ptr<OffscreenContext> context_;
  std::unique_ptr<Renderer> renderer_;
  DrawList list_;
  Camera camera_;
};

/// Distance along a ray to a sphere; nothing where it misses.
std::optional<double> hit(const geometry::Ray& ray, const Sphere& sphere) {
  const Vec3 to = sphere.centre - ray.origin;
  const double along = to.dot(ray.direction), off2 = to.squaredNorm() - along * along;
  if (off2 > sphere.radius * sphere.radius) return {};
  return along - std::sqrt(sphere.radius * sphere.radius - off2);
}

TEST_F(LabelTest, AnEmptyPictureHasNeitherLabelsNorDepths) {
  const LabelMap seen = map();
  EXPECT_THAT(seen.labels, testing::Each(0u));
  EXPECT_THAT(seen.depth, testing::Each(LabelMap::nothing));
}

TEST_F(LabelTest, SpheresAreWhereRaysMeetThem) {
  list_.spheres = {{Vec3(-0.03, 0, 0.05), 0.1, {}, 7}, {Vec3(0.12, 0.1, 0.1), 0.08, {}, 70000}};
  const LabelMap seen = map();
  int wrong = 0, of_other = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const geometry::Ray through = ray(x, y);
      Label expected = 0;
      double nearest = 1e9;
      for (const Sphere& one : list_.spheres)
        if (const auto at = hit(through, one); at && *at < nearest) {
          nearest = *at;
          expected = one.label;
        }
      const std::size_t i = seen.index(x, y);
      of_other += expected == 70000;
      if (seen.labels[i] != expected) {
        ++wrong;
      } else if (expected != 0) {
        // The sphere is drawn with facets, which lie inside it by up to 1 % of its radius; at its
        // rim that is more along the ray.
        const double rim = -(through.origin + nearest * through.direction -
                             list_.spheres[expected == 7 ? 0 : 1].centre)
                                .normalized()
                                .dot(through.direction);
        if (rim > 0.25) {
          EXPECT_NEAR(seen.depth[i], depth_at(through, nearest), 2.0e-3 / rim);
        }
      }
    }
  EXPECT_GT(of_other, 500);
  // Only at the rims: about 2 pi times 45 px around, of which the facets miss a part.
  EXPECT_LT(wrong, 120);
}

TEST_F(LabelTest, APlaneIsAsFarAwayAsItIs) {
  list_.ground = Ground{-0.1};
  list_.ground->label = 3;
  const LabelMap seen = map();
  int ground = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const geometry::Ray through = ray(x, y);
      const std::size_t i = seen.index(x, y);
      if (seen.labels[i] != 3u) continue;
      ++ground;
      const double distance = (-0.1 - through.origin.z()) / through.direction.z();
      EXPECT_NEAR(seen.depth[i] / depth_at(through, distance), 1.0, 1e-4);
    }
  EXPECT_GT(ground, width * height / 2);
}

TEST_F(LabelTest, EveryShapeKeepsItsLabel) {
  const std::vector<TubePoint> stem = {{Vec3(-0.3, 0, -0.1), 0.02, {}},
                                       {Vec3(-0.3, 0, 0.2), 0.02, {}}};
  const auto add = [&](Label label, const auto& shape) {
    const DrawList::Counts before = list_.counts();
    shape();
    list_.label_since(before, label);
  };
  add(1, [&] { list_.add_tube(stem); });
  add(2, [&] { list_.capsules.push_back({Vec3(-0.2, 0, 0), Vec3(-0.2, 0, 0.1), 0.02, 0.01, {}}); });
  add(3, [&] {
    list_.boxes.push_back({{Vec3(-0.1, 0, 0), Quat::Identity()}, Vec3(.02, .02, .02), {}});
  });
  add(4, [&] {
    list_.meshes.push_back(
        {std::make_shared<const geometry::TriangleMesh>(geometry::make_cylinder(0.02, 0.1, 24)),
         {Vec3(0, 0, 0.05), Quat::Identity()},
         {}});
  });
  add(5, [&] {
    list_.blades.push_back({Vec3(0.1, 0, 0), Vec3(0.2, 0, 0), Vec3(0.1, 0, 0.1), {}});
  });
  add(6, [&] { list_.spheres.push_back({Vec3(0.25, 0, 0), 0.03, {}}); });
  list_.lines.push_back({Vec3(-1, 0, 0.3), Vec3(1, 0, 0.3), {}, 3.0f});
  const LabelMap seen = map();
  EXPECT_THAT(std::set<Label>(seen.labels.begin(), seen.labels.end()),
              testing::ElementsAre(0, 1, 2, 3, 4, 5, 6));
}

TEST_F(LabelTest, WhatIsHiddenIsNotThere) {
  list_.spheres = {{Vec3(0, 0, 0.05), 0.1, {}, 1}};
  const Vec3 behind = list_.spheres[0].centre + 0.3 * (list_.spheres[0].centre - camera_.eye);
  list_.spheres.push_back({behind, 0.05, {}, 2});
  const LabelMap seen = map();
  EXPECT_THAT(seen.labels, testing::Not(testing::Contains(2u)));
  list_.spheres.erase(list_.spheres.begin());
  EXPECT_THAT(map().labels, testing::Contains(2u));
}

TEST_F(LabelTest, ThePictureBesideItIsThePicture) {
  list_.spheres = {{Vec3(0, 0, 0.05), 0.1, shadings::tomato, 1}};
  list_.ground = Ground{-0.1};
  const Image alone = renderer_->render(list_, camera_, width, height);
  const LabelMap labels = map();
  const Renderer::Labelled both = renderer_->render_labelled(list_, camera_, width, height);
  EXPECT_EQ(both.image.rgb, alone.rgb);
  EXPECT_EQ(both.map.labels, labels.labels);
  EXPECT_EQ(both.map.depth, labels.depth);
  EXPECT_EQ(renderer_->render(list_, camera_, width, height).rgb, alone.rgb);
}

}  // namespace
}  // namespace pedicel::render
