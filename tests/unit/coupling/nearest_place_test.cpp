#include "plugins/coupling/nearest_place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "engine/core/random.h"
#include "engine/geometry/shapes.h"

namespace pedicel::coupling {
namespace {

using geometry::SignedDistance;

Vec3 random_point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

MovingCapsule resting(const Vec3& near, const Vec3& far, double radius_near, double radius_far) {
  return {near, far, near, far, radius_near, radius_far};
}

MovingCapsule moving(const Vec3& from, const Vec3& to, const Vec3& along, double radius) {
  return {to, to + along, from, from + along, radius, radius};
}

SearchSettings all(int samples) {
  SearchSettings settings;
  settings.samples = samples;
  settings.reach = 1.0e3;
  return settings;
}

std::vector<std::shared_ptr<SignedDistance>> solids() {
  return {std::make_shared<geometry::BoxDistance>(Vec3(0.02, 0.05, 0.03)),
          std::make_shared<geometry::SphereDistance>(0.02),
          std::make_shared<geometry::PlaneDistance>(Vec3(0.1, 0.2, 1.0), 0.01),
          std::make_shared<geometry::CylinderDistance>(0.015, 0.05),
          std::make_shared<geometry::CapsuleDistance>(0.01, 0.05)};
}

// The reference takes 5000 samples. The pull to the middle may cost `flat`; a refined place may be
// nearer than the reference's by what lies between two of its samples.
TEST(NearestPlace, IsThatOfADenseSearch) {
  Random random(4);
  for (const auto& solid : solids()) {
    for (int trial = 0; trial < 200; ++trial) {
      const Vec3 near = random_point(random, 0.08);
      const Vec3 far = near + random_point(random, 0.05);
      const auto capsule = resting(near, far, random.uniform(0.001, 0.004), 0.002);
      double brute = 1.0e9;
      for (int i = 0; i <= 5000; ++i) {
        const double f = i / 5000.0;
        const double radius = (1 - f) * capsule.radius_near + f * capsule.radius_far;
        brute = std::min(brute, solid->distance((1 - f) * near + f * far) - radius);
      }
      if (brute < 0.0) continue;  // inside, distances are not convex: the next test
      const int samples =
          sample_count((far - near).norm(), solid->bounds().sizes().minCoeff(), 2, 32);
      const auto found = nearest_place(*solid, capsule, all(samples));
      ASSERT_TRUE(found);
      EXPECT_LE(found->gap, brute + SearchSettings{}.flat + 1.0e-7);
      EXPECT_GE(found->gap, brute - 1.0e-6);
      const Vec3 axis = (1 - found->fraction) * near + found->fraction * far;
      EXPECT_NEAR(solid->distance(axis) - found->radius, found->gap, 1e-12);
      // Going out along the normal the distance grows one to one.
      EXPECT_NEAR(solid->distance(axis + 1e-4 * found->normal_C), solid->distance(axis) + 1e-4,
                  1e-8);
      SearchSettings near_only = all(samples);
      near_only.reach = brute - 1.0e-5;
      EXPECT_FALSE(nearest_place(*solid, capsule, near_only));
    }
  }
}

TEST(NearestPlace, OfOverlappingCapsulesIsAtLeastAsDeepAsTheSamples) {
  Random random(5);
  for (const auto& solid : solids()) {
    for (int trial = 0; trial < 100; ++trial) {
      const Vec3 near = random_point(random, 0.03), far = near + random_point(random, 0.04);
      const auto capsule = resting(near, far, 0.002, 0.002);
      double brute = 1.0e9;
      for (int i = 0; i < 8; ++i)
        brute = std::min(brute, solid->distance(near + i / 7.0 * (far - near)) - 0.002);
      const auto found = nearest_place(*solid, capsule, all(8));
      ASSERT_TRUE(found);
      EXPECT_LE(found->gap, brute + SearchSettings{}.flat + 1e-12);
    }
  }
}

TEST(NearestPlace, OfASphereIsItsCentre) {
  const geometry::SphereDistance solid(0.01);
  const auto found =
      nearest_place(solid, resting({0, 0, 0.03}, {0, 0, 0.03}, 0.005, 0.005), all(1));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->gap, 0.015, 1e-15);
  EXPECT_EQ(found->radius, 0.005);
  EXPECT_TRUE(found->normal_C.isApprox(Vec3::UnitZ()));
}

// Tilted about the horizontal by an angle a, the cost is L a f + 4 flat (f - 1/2)^2 with its
// minimum at f = 1/2 - L a / (8 flat).
TEST(NearestPlace, OfAFlatCapsuleRollsFromTheMiddleToAnEnd) {
  const geometry::PlaneDistance ground;
  const double length = 0.02, flat = SearchSettings{}.flat;
  for (const double rise : {-2.0, -0.5, -0.1, 0.0, 0.3, 0.9}) {  // of the far end, in units of flat
    const auto capsule = resting({0, 0, 0.002}, {length, 0, 0.002 + rise * flat}, 0.002, 0.002);
    const auto found = nearest_place(ground, capsule, all(5));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->fraction, 0.5 - rise / 8.0, 2e-3) << rise;
  }
  const auto steep = nearest_place(ground, resting({0, 0, 0}, {length, 0, 0.01}, 0, 0), all(5));
  EXPECT_EQ(steep->fraction, 0.0);
}

// A thin plate that a rod passes altogether within one step, from above to below.
TEST(NearestPlace, PushesBackWhatWentThroughInOneStep) {
  const geometry::BoxDistance plate(Vec3(0.1, 0.1, 0.002));
  const double radius = 0.001;
  for (const double below : {0.0005, 0.002, 0.006}) {
    const auto capsule = moving({-0.01, 0, 0.003}, {-0.01, 0, -below}, {0.02, 0, 0}, radius);
    SearchSettings settings = all(5);
    settings.reach = 2.0e-4;
    const auto found = nearest_place(plate, capsule, settings);
    ASSERT_TRUE(found) << below;
    EXPECT_TRUE(found->normal_C.isApprox(Vec3::UnitZ())) << below;
    EXPECT_NEAR(found->gap, -(0.001 + radius + below), 1e-9) << below;
  }
}

// What rests on the plate and slips deep into it within the step, beyond its middle, still belongs
// above.
TEST(NearestPlace, KeepsTheSideOfWhatTouchedBefore) {
  const geometry::BoxDistance plate(Vec3(0.1, 0.1, 0.002));
  const auto capsule = moving({-0.01, 0, 0.0019}, {-0.01, 0, -0.0003}, {0.02, 0, 0}, 0.001);
  const auto found = nearest_place(plate, capsule, all(5));
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->normal_C.isApprox(Vec3::UnitZ()));
  EXPECT_NEAR(found->gap, -0.0023, 1e-9);
}

TEST(NearestPlace, LeavesAloneWhatPassesBeside) {
  const geometry::BoxDistance plate(Vec3(0.1, 0.1, 0.002));
  SearchSettings settings = all(5);
  settings.reach = 2.0e-4;
  const auto beside = moving({0.06, 0, 0.01}, {0.06, 0, -0.01}, {0.02, 0, 0}, 0.001);
  EXPECT_FALSE(nearest_place(plate, beside, settings));
  const auto away = moving({0, 0, 0.0021}, {0, 0, 0.02}, {0.02, 0, 0}, 0.001);
  EXPECT_FALSE(nearest_place(plate, away, settings));
}

// Random rods thrown at random boxes: whoever starts outside and hits is pushed back against its
// way, and lies outside once it is put where its contact wants it.
TEST(NearestPlace, NeverPushesThroughToTheFarSide) {
  Random random(6);
  int hits = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 size(random.uniform(0.002, 0.02), 0.08, 0.08);
    const geometry::BoxDistance solid(size);
    const double start_x = 0.5 * size.x() + random.uniform(0.003, 0.01);
    const Vec3 from(start_x, random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02));
    const Vec3 to(from.x() - random.uniform(0.0, 0.04), from.y(), from.z());
    const Vec3 along(0, random.uniform(-0.015, 0.015), random.uniform(-0.015, 0.015));
    SearchSettings settings = all(5);
    settings.reach = 0.0;
    const auto found = nearest_place(solid, moving(from, to, along, 0.0015), settings);
    const bool hit = to.x() - 0.0015 < 0.5 * size.x();
    EXPECT_EQ(found.has_value(), hit);
    if (!found) continue;
    ++hits;
    EXPECT_GT(found->normal_C.x(), 0.999);
    const Vec3 mended = to + found->fraction * along - found->gap * found->normal_C;
    EXPECT_NEAR(solid.distance(mended), 0.0015, 1e-6);
  }
  EXPECT_GT(hits, 200);
}

TEST(SampleCount, FollowsLengthAndFeature) {
  EXPECT_EQ(sample_count(0.0, 0.01, 2, 16), 1);
  EXPECT_EQ(sample_count(0.02, std::numeric_limits<double>::infinity(), 2, 16), 2);
  EXPECT_EQ(sample_count(0.02, 0.01, 2, 16), 5);
  EXPECT_EQ(sample_count(0.021, 0.01, 2, 16), 6);
  EXPECT_EQ(sample_count(0.001, 0.01, 2, 16), 2);
  EXPECT_EQ(sample_count(1.0, 0.01, 2, 16), 16);
}

}  // namespace
}  // namespace pedicel::coupling
