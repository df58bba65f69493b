#include "plugins/cosserat/contact/self_contact.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <tuple>

#include "engine/core/check.h"
#include "engine/core/random.h"
#include "plugins/cosserat/lanes/lane_kernels.h"
#include "plugins/cosserat/model/rotation.h"
#include "plugins/cosserat/solver/contact_terms.h"
#include "tests/support/allocation_counter.h"

namespace pedicel::cosserat {
namespace {

using Pair = std::pair<int, int>;

Vec3 random_point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

void add_stem(RodModel& model, int parent, const Vec3& end, double radius) {
  const int e = add_element(model, parent, end, circle_section(radius, Material{}));
  model.elements[e].radius_near = model.elements[e].radius_far = radius;
}

// Two horizontal rods of three segments each from one clamp, far apart after the first segment: the
// second runs over the first at height `above`.
RodModel crossing_rods(double above, double radius) {
  RodModel model;
  add_stem(model, -1, {0.1, -0.1, 0}, radius);       // 0
  add_stem(model, 0, {0.1, 0, 0}, radius);           // 1
  add_stem(model, 1, {0.1, 0.1, 0}, radius);         // 2
  add_stem(model, 2, {0.1, 0.2, 0}, radius);         // 3
  add_stem(model, -1, {-0.1, 0.06, above}, radius);  // 4
  add_stem(model, 4, {0.05, 0.06, above}, radius);   // 5
  add_stem(model, 5, {0.15, 0.06, above}, radius);   // 6: crosses element 2
  model.elements[0].organ = 0;
  model.organs = {"plant/stem"};
  finish(model);
  return model;
}

std::vector<ContactPoint> contacts_of(SelfContact& source, const RodModel& model,
                                      const RodState& start, const RodState& state) {
  std::vector<ContactPoint> found;
  source.begin_step(model, start, 0.01);
  source.find(model, state, 0.01, found);
  return found;
}

// Lowers elements 4 to 6 rigidly.
RodState lowered(const RodModel& model, double by) {
  RodState state = drawn_state(model);
  for (int e = 4; e < 7; ++e) state.position[e].z() -= by;
  return state;
}

// The cost of a place pair is |a(s) - b(t)|^2; a dense grid over the unit square is the reference.
// The regularisation may cost e/2 = 0.5e-4 of the longer axis squared.
TEST(NearestFractions, AreAsNearAsADenseSearch) {
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 a = random_point(random, 1), b = random_point(random, 1);
    Vec3 along_a = random_point(random, 1), along_b = random_point(random, 1);
    if (trial % 3 == 0) along_b = 0.7 * along_a;  // parallel
    if (trial % 10 == 1) along_b.setZero();       // a sphere
    if (trial % 20 == 2) along_a.setZero();
    const auto at = nearest_fractions(a, along_a, b, along_b);
    ASSERT_GE(std::min(at.a, at.b), 0.0);
    ASSERT_LE(std::max(at.a, at.b), 1.0);
    double best = 1.0e9;
    for (int i = 0; i <= 100; ++i)
      for (int j = 0; j <= 100; ++j)
        best = std::min(best, (a + 0.01 * i * along_a - b - 0.01 * j * along_b).squaredNorm());
    const double found = (a + at.a * along_a - b - at.b * along_b).squaredNorm();
    const double longer = std::max(along_a.squaredNorm(), along_b.squaredNorm());
    EXPECT_LE(found, best + 0.5e-4 * longer + 1.0e-12) << trial;
  }
}

TEST(NearestFractions, OfParallelAxesAreTheMiddles) {
  const auto at = nearest_fractions({0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}, {1, 0, 0});
  EXPECT_NEAR(at.a, 0.5, 1e-9);
  EXPECT_NEAR(at.b, 0.5, 1e-9);
}

// Several at a time, with every instruction set, one pair more than fills vectors: as one by one.
TEST(Capsules, AreMeasuredAsOneByOne) {
  Random random(4);
  Capsules capsules;
  capsules.resize(40);
  for (int i = 0; i < 40; ++i) {
    const Vec3 near = random_point(random, 1);
    const Vec3 far = i % 10 == 1 ? near : Vec3(near + random_point(random, 1));
    for (int k = 0; k < 3; ++k) {
      capsules[i].near[k] = near[k];
      capsules[i].far[k] = far[k];
    }
    capsules[i].radius_near = random.uniform(0.01, 0.2);
    capsules[i].radius_far = random.uniform(0.01, 0.2);
  }
  CapsulePairs pairs;
  for (int a = 0; a < 40; ++a)
    for (int b = a + 1; b < 40; ++b) pairs.add(a, b);
  pairs.add(0, 7);
  for (const std::string& set : available_instruction_sets()) {
    use_instruction_set(set);
    measure(capsules, pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const int a = pairs.a[i], b = pairs.b[i];
      const Vec3 near_a = capsules[a].near_at(), along_a = capsules[a].far_at() - near_a;
      const Vec3 near_b = capsules[b].near_at(), along_b = capsules[b].far_at() - near_b;
      const auto at = nearest_fractions(near_a, along_a, near_b, along_b);
      ASSERT_NEAR(pairs.at_a[i], at.a, 1e-12) << set << " " << a << " " << b;
      ASSERT_NEAR(pairs.at_b[i], at.b, 1e-12) << set << " " << a << " " << b;
      const auto radius = [&](int k, double fraction) {
        return capsules[k].radius_near +
               fraction * (capsules[k].radius_far - capsules[k].radius_near);
      };
      const double gap = (near_a + at.a * along_a - near_b - at.b * along_b).norm() -
                         radius(a, at.a) - radius(b, at.b);
      ASSERT_NEAR(pairs.gap[i], gap, 1e-12) << set << " " << a << " " << b;
    }
  }
  use_instruction_set("");
}

// Turning one axis through parallel must not make the place jump.
TEST(NearestFractions, MoveContinuouslyThroughParallel) {
  double last = nearest_fractions({0, 0, 0}, {1, 0, 0}, {0, 0, 0.2}, {1, 0, -0.05}).a;
  for (double tilt = -0.05; tilt <= 0.05; tilt += 1.0e-4) {
    const double now = nearest_fractions({0, 0, 0}, {1, 0, 0}, {0, 0, 0.2}, {1, 0, tilt}).a;
    EXPECT_LT(std::abs(now - last), 0.25) << tilt;
    last = now;
  }
}

// Boxes near the origin and far from it, empty ones and ones of all sizes, in no order at all;
// pairs of near and of far numbers are left out; in parts and by every instruction set. All pairs
// are found, and none that is apart by more than single precision's rounding on both sides.
TEST(OverlappingBoxes, AreThoseOfAllPairs) {
  constexpr int count = 205;
  Random random(2);
  OverlappingBoxes finder;
  ThreadPool pool(2);
  const std::vector<std::string> sets = available_instruction_sets();
  for (int trial = 0; trial < 30; ++trial) {
    use_instruction_set(sets[trial % sets.size()]);
    const double distance = trial % 3 == 0 ? 1.0e3 : 1.0;  // m
    const Vec3 middle = random_point(random, distance), rounding = Vec3::Constant(3e-7 * distance);
    std::vector<Eigen::AlignedBox3d> boxes;
    std::vector<Pair> left_out, overlapping, touching, found;
    finder.resize(count);
    for (int i = 0; i < count; ++i) {
      Eigen::AlignedBox3d box;
      const Vec3 low = middle + random_point(random, 1);
      if (i % 9 != 0) box.extend(low).extend(low + Vec3::Constant(random.uniform(0.01, 0.3)));
      if (i % 17 == 0) box.extend(middle + random_point(random, 1));
      boxes.push_back(box);
      if (!box.isEmpty()) finder.set(i, box.min(), box.max());
    }
    finder.set(13, Vec3::Constant(std::nan("")), Vec3::Ones());
    boxes[13].setEmpty();
    for (int i = 0; i < count; ++i)
      for (int j = i + 1; j < count; ++j) {
        if (random.uniform(0.0, 1.0) < 0.2) {
          left_out.emplace_back(i, j);
        } else if (!boxes[i].isEmpty() && !boxes[j].isEmpty()) {
          const Eigen::AlignedBox3d wide(boxes[i].min() - rounding, boxes[i].max() + rounding);
          if (boxes[i].intersects(boxes[j])) overlapping.emplace_back(i, j);
          if (wide.intersects(boxes[j])) touching.emplace_back(i, j);
        }
      }
    finder.leave_out(left_out);
    finder.close_groups(0, count);
    PartedLoop loop;
    loop.pool = trial % 2 == 0 ? &pool : nullptr;
    std::array<std::vector<Pair>, PartedLoop::most_parts> by_part;
    const int parts = finder.find(loop, [&](int part, const CapsulePairs& pairs) {
      for (std::size_t i = 0; i < pairs.size(); ++i)
        by_part[part].emplace_back(pairs.a[i], pairs.b[i]);
    });
    for (int part = 0; part < parts; ++part)
      found.insert(found.end(), by_part[part].begin(), by_part[part].end());
    EXPECT_TRUE(std::includes(found.begin(), found.end(), overlapping.begin(), overlapping.end()));
    EXPECT_TRUE(std::includes(touching.begin(), touching.end(), found.begin(), found.end()));
    CapsulePairs with;
    const int box = trial * 7 % count;
    finder.find_with(box, with);
    std::vector<Pair> with_box, of_box;
    for (std::size_t i = 0; i < with.size(); ++i) with_box.emplace_back(with.a[i], with.b[i]);
    std::ranges::copy_if(found, std::back_inserter(of_box),
                         [&](const Pair& pair) { return pair.first == box || pair.second == box; });
    EXPECT_THAT(with_box, testing::UnorderedElementsAreArray(of_box));
  }
  use_instruction_set("");
}

TEST(SelfContact, GivesTwoContactsThatCarryTheForceOfOneSpring) {
  const double radius = 0.003, above = 0.02;
  const RodModel model = crossing_rods(above, radius);
  SelfContactSettings settings;
  SelfContact source(model, settings);
  const RodState start = drawn_state(model);
  EXPECT_TRUE(contacts_of(source, model, start, start).empty());

  const double overlap = 0.0005;
  const RodState state = lowered(model, above - 2 * radius + overlap);
  const auto found = contacts_of(source, model, start, state);
  ASSERT_EQ(found.size(), 2u);
  const ContactPoint &under = found[0], &over = found[1];
  EXPECT_EQ(under.shape, 2);
  EXPECT_EQ(under.collider, self_contact_base + 6);
  EXPECT_EQ(over.shape, 6);
  EXPECT_EQ(over.collider, self_contact_base + 2);
  EXPECT_TRUE(is_self_contact(over.collider));
  EXPECT_NEAR(under.normal_W.z(), -1, 1e-6);
  EXPECT_NEAR(over.normal_W.z(), 1, 1e-6);
  EXPECT_NEAR(under.back, 0.04, 1e-5);
  EXPECT_NEAR(over.back, 0.05, 1e-5);
  for (const ContactPoint& point : found) {
    EXPECT_NEAR(point.gap, -0.5 * overlap, 1e-8);
    const double force = point.stiffness * (point.margin - point.gap);
    // k = min(stiffness, m / dt^2) and F = k o (1 + o / margin).
    const double k = std::min(model.elements[2].mass, model.elements[6].mass) / (0.01 * 0.01);
    ASSERT_LT(k, settings.stiffness);
    const double o = settings.margin + overlap;
    EXPECT_NEAR(force, k * o * (1 + o / settings.margin), 1e-6);
    // Half of the gap moves each side's plane: its slope is twice dF/do.
    EXPECT_NEAR(point.stiffness, 2 * k * (1 + 2 * o / settings.margin), 1e-6 * point.stiffness);
    // Only the upper rod moved: the middle moves with half of its motion.
    EXPECT_NEAR(point.surface_motion_W.z(), -0.5 * (above - 2 * radius + overlap), 1e-9);
  }
}

// The rows need not be told again where contacts act that press on as they did: not of the first
// ones, of those that press deeper or less, of those that have let go, and then of those that have
// stayed apart.
TEST(ContactTerms, SayWhetherTheirBlocksStay) {
  const double radius = 0.003, above = 0.02, touching = above - 2 * radius;
  const RodModel model = crossing_rods(above, radius);
  SelfContact source(model, {});
  ContactSource* const pointer = &source;
  const RodState start = drawn_state(model);
  ContactTerms terms;
  source.begin_step(model, start, 0.01);
  terms.find(model, start, lowered(model, touching + 5e-4), 0.01, {&pointer, 1});
  const auto pressing = [&] {
    return std::ranges::count_if(terms.blocks().elements, [](int e) { return e >= 0; });
  };
  EXPECT_FALSE(terms.blocks_stay());
  EXPECT_EQ(pressing(), 2);
  for (const double depth : {6e-4, 3e-4}) {
    terms.follow(lowered(model, touching + depth));
    EXPECT_TRUE(terms.blocks_stay()) << depth;
    EXPECT_EQ(pressing(), 2);
  }
  const RodState apart = lowered(model, touching - 1e-3);
  terms.follow(apart);
  EXPECT_FALSE(terms.blocks_stay());
  EXPECT_EQ(pressing(), 0);
  terms.follow(apart);
  EXPECT_TRUE(terms.blocks_stay());
}

TEST(SelfContact, PushesBackAnAxisThatWentThroughInOneStep) {
  const double radius = 0.003, above = 0.02;
  const RodModel model = crossing_rods(above, radius);
  SelfContact source(model, {});
  const RodState state = lowered(model, above + 0.001);  // its axis is 1 mm under the other's
  const auto found = contacts_of(source, model, drawn_state(model), state);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].normal_W.z(), -1, 1e-6);
  EXPECT_NEAR(found[0].gap, -0.5 * (0.001 + 2 * radius), 1e-9);
}

TEST(SelfContact, LeavesOutWhatOverlapsAsDrawn) {
  const RodModel model = crossing_rods(0.005, 0.003);  // overlaps by 1 mm where it was drawn
  SelfContact source(model, {});
  const RodState state = lowered(model, 0.001);
  EXPECT_TRUE(contacts_of(source, model, drawn_state(model), state).empty());
}

// A rod folded onto itself: each pair of segments lies on each other, but those at most two joints
// apart never touch.
TEST(SelfContact, LeavesOutNeighboursUpToTwoJoints) {
  RodModel model;
  for (int e = 0; e < 6; ++e) add_stem(model, e - 1, {0.02 * (e + 1), 0, 0}, 0.002);
  finish(model);
  SelfContact source(model, {});
  RodState folded = drawn_state(model);
  for (int e = 0; e < 6; ++e) {
    folded.position[e] = Vec3(e % 2 ? 0.0 : 0.02, 0.0005 * e, 0);
    if (e % 2)
      folded.orientation[e] = Quat(Eigen::AngleAxisd(M_PI, Vec3::UnitZ())) * folded.orientation[e];
  }
  std::set<Pair> pairs;
  for (const ContactPoint& point : contacts_of(source, model, folded, folded))
    pairs.emplace(model.shapes[point.shape].element,
                  model.shapes[point.collider - self_contact_base].element);
  std::set<Pair> expected;
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b)
      if (std::abs(a - b) > 2) expected.emplace(a, b);
  EXPECT_EQ(pairs, expected);
}

TEST(SelfContact, TreatsWeldedElementsAsNeighbours) {
  RodModel model = crossing_rods(0.02, 0.003);
  const RodState state = lowered(model, 0.0145);
  SelfContact free(model, {});
  EXPECT_EQ(contacts_of(free, model, drawn_state(model), state).size(), 2u);
  model.welds.push_back({2, 6, 1.0, Vec3::Ones(), Quat::Identity()});
  SelfContact welded(model, {});
  EXPECT_TRUE(contacts_of(welded, model, drawn_state(model), state).empty());
}

// Random bundles of stems with fruits against all pairs of shapes, sampled densely.
TEST(SelfContact, FindsThePairsOfABruteForceSearch) {
  Random random(3);
  for (int trial = 0; trial < 10; ++trial) {
    RodModel model;
    for (int branch = 0; branch < 8; ++branch) {
      int parent = -1;
      for (int i = 0; i < 3; ++i) {
        // Drawn far apart, so that nothing is left out for its drawn overlap.
        const Vec3 end(branch + 1.0, 1.0, 0.1 * (i + 1));
        add_stem(model, parent, end, random.uniform(0.004, 0.01));
        parent = model.size() - 1;
      }
      model.fruits.push_back({"fruit", parent, 0.0, random.uniform(0.01, 0.03), 900, {}});
    }
    finish(model);
    // Short shapes, for the brute-force search's sake.
    for (CollisionShape& shape : model.shapes)
      if (shape.fruit < 0) shape.back_near = 0.1;
    SelfContactSettings settings;
    SelfContact source(model, settings);
    RodState state = drawn_state(model);
    for (int e = 0; e < model.size(); ++e) {
      state.position[e] = random_point(random, 0.12);
      state.orientation[e] = Quat::FromTwoVectors(Vec3::UnitZ(), random_point(random, 1));
    }
    state.alive[5] = 0;
    state.fruit_gone[1] = true;

    std::set<Pair> found;
    for (const ContactPoint& point : contacts_of(source, model, state, state))
      found.emplace(point.shape, point.collider - self_contact_base);
    const auto axis_point = [&](const CollisionShape& shape, int i) -> Vec3 {
      const double back = shape.back_near + 0.02 * i * (shape.back_far - shape.back_near);
      return state.position[shape.element] -
             back * (state.orientation[shape.element] * Vec3::UnitZ());
    };
    for (int a = 0; a < static_cast<int>(model.shapes.size()); ++a)
      for (int b = 0; b < static_cast<int>(model.shapes.size()); ++b) {
        const CollisionShape &first = model.shapes[a], &second = model.shapes[b];
        const bool gone =
            first.element == 5 || second.element == 5 || first.fruit == 1 || second.fruit == 1;
        double nearest = 1.0e9;
        for (int i = 0; i <= 50; ++i)
          for (int j = 0; j <= 50; ++j)
            nearest = std::min(nearest, (axis_point(first, i) - axis_point(second, j)).norm());
        const double gap = nearest - first.radius_near - second.radius_near;
        // Roots of all branches are siblings; within a branch all three are neighbours.
        const bool neighbours = first.element / 3 == second.element / 3 ||
                                (first.element % 3 == 0 && second.element % 3 == 0);
        if (gone || neighbours) {
          EXPECT_FALSE(found.count({a, b})) << a << " " << b;
        } else if (gap < settings.margin - 2.0e-3) {
          EXPECT_TRUE(found.count({a, b})) << a << " " << b << " gap " << gap;
        } else if (gap > settings.margin + 2.0e-3) {
          EXPECT_FALSE(found.count({a, b})) << a << " " << b << " gap " << gap;
        }
      }
  }
}

// A cloud of segments that fly and turn, a few of which are hit at times and fly elsewhere; fast
// and falling, or so slowly that nothing gets a course. Lists that are kept from step to step, in
// parts of two threads, give what lists made for the one step by one thread give, in the same
// order, and are made rarely.
TEST(SelfContact, KeepsNoPairFromMeetingByItsLists) {
  constexpr double dt = 1.0 / 240.0;
  constexpr int count = 300;  // enough for two threads
  ThreadPool pool(2);
  RodModel model;
  // Drawn far apart, so that nothing is left out for its drawn overlap.
  for (int i = 0; i < count; ++i) add_stem(model, -1, {0.1 * i, 0, 0.02}, 0.002);
  model.organs = {"plant/stem"};
  finish(model);
  for (CollisionShape& shape : model.shapes) shape.back_near = 0.02;
  // Segments of one clamp are siblings, which are left out: each fifth one is its own.
  for (int i = 1; i < model.size(); ++i) model.elements[i].parent = i % 5 == 0 ? -1 : i - 1;
  const auto places = [](const std::vector<ContactPoint>& contacts) {
    std::vector<std::tuple<int, int, double>> result;
    for (const ContactPoint& c : contacts) result.emplace_back(c.shape, c.collider, c.gap);
    return result;
  };
  for (const double speed : {0.3, 0.04}) {  // m/s
    Random random(5);
    SelfContact kept(model, {});
    kept.use(&pool);
    RodState start = drawn_state(model);
    std::vector<Vec3> velocity(model.size()), turning(model.size());
    for (int i = 0; i < model.size(); ++i) {
      start.position[i] = random_point(random, 0.08);
      start.orientation[i] = Quat::FromTwoVectors(Vec3::UnitZ(), random_point(random, 1));
      velocity[i] = random_point(random, speed);
      turning[i] = random_point(random, 30.0 * speed);
    }
    contacts_of(kept, model, start, start);
    std::size_t met = 0;
    constexpr int steps = 60;
    for (int step = 0; step < steps; ++step) {
      RodState end = start;
      for (int hit = 0; hit < 2; ++hit) velocity[random.integer(0, count - 1)] *= -1.0;
      for (int i = 0; i < model.size(); ++i) {
        if (speed > 0.1) velocity[i].z() -= 9.81 * dt;
        end.position[i] += velocity[i] * dt;
        end.orientation[i] = exp_map(turning[i] * dt) * start.orientation[i];
      }
      SelfContact fresh(model, {});
      const auto found = places(contacts_of(kept, model, start, end));
      ASSERT_EQ(found, places(contacts_of(fresh, model, start, end)))
          << speed << " m/s, step " << step;
      met += found.size();
      start = end;
    }
    EXPECT_GT(met, 1000u) << speed << " m/s";
    EXPECT_LT(kept.work().collections, steps / 3) << speed << " m/s";
  }
}

TEST(SelfContact, DoesNotAllocateOnceWarm) {
  const RodModel model = crossing_rods(0.02, 0.003);
  SelfContact source(model, {});
  const RodState start = drawn_state(model), state = lowered(model, 0.0145);
  std::vector<ContactPoint> found;
  const auto step = [&] {
    found.clear();
    source.begin_step(model, start, 0.01);
    source.find(model, start, 0.01, found);
    source.find(model, state, 0.01, found);
  };
  step();
  step();
  const long before = allocations();
  step();
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(found.size(), 2u);
}

TEST(SelfContact, RefusesSettingsOutOfBounds) {
  const RodModel model = crossing_rods(0.02, 0.003);
  const auto words = [&](SelfContactSettings settings) -> std::string {
    try {
      SelfContact source(model, settings);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "taken";
  };
  SelfContactSettings settings;
  EXPECT_EQ(words(settings), "taken");
  settings.stiffness = 0;
  EXPECT_THAT(words(settings),
              testing::HasSubstr("SelfContactSettings.stiffness = 0.000000: must be > 0"));
  settings = {};
  settings.fruit_stiffness = -1;
  EXPECT_THAT(words(settings), testing::HasSubstr("fruit_stiffness = -1.000000: must be > 0"));
  settings = {};
  settings.friction = -0.1;
  EXPECT_THAT(words(settings), testing::HasSubstr("friction = -0.100000: must be >= 0"));
  settings = {};
  settings.margin = std::nan("");
  EXPECT_THAT(words(settings), testing::HasSubstr("margin = nan: must be > 0"));
}

}  // namespace
}  // namespace pedicel::cosserat
