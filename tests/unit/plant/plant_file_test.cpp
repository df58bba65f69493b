// The plant file: every key is read, and what is written reads back as the same plant.
#include "plugins/plant/plant_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "engine/core/random.h"

namespace pedicel::plant {
namespace {

const std::string every_key = R"(format: pedicel-plant
version: 1
name: cherry tomato truss
shape: rest
look: apple
material: {youngs_modulus: 2.0e7, poisson_ratio: 0.35, density: 700, damping_time: 0.01, known_to: {youngs_modulus: 0.1, density: 0.05, damping_time: 0.5}}
sampling: {connect: 0.01, distance: 0.02}
root: [0, 0, 0.001]
supports:
  - {curve: stem, at: 1.0}
curves:
  - name: stem
    interpolation: linear
    points: [[0, 0, 0], [0, 0, 0.1], [0.01, 0, 0.2]]
    radius: [0.004, 0.0035, 0.003]
    section: {kind: circle}
    material: {youngs_modulus: 3.0e7}
  - name: truss
    points: [[0, 0, 0.1], [0.1, 0, 0.1]]
    radius: 0.002
    section: {kind: ellipse, ratio: 0.6, normal: [0, 1, 0]}
  - name: blade
    interpolation: smooth
    points: [[0.01, 0, 0.2], [0.2, 0, 0.2]]
    section: {kind: rectangle, width: 0.08, height: 0.001, normal: [0, 0, 2]}
fruits:
  - {name: fruit_1, curve: truss, at: 1.0, radius: 0.012, density: 950,
     detach: {stretch: 0.1, bend: 0.31, force: 5, moment: 0.2, torsion: 0.1}}
leaves:
  - {name: leaf_1, curve: stem, at: 0.5, template: tomato, size: 0.08, normal: [0, 0, 1],
     direction: [1, 0, 0]}
masses:
  - {curve: stem, at: 0.9, mass: 0.02}
effects:
  - {name: base_compliance, stiffness: 0.8}
  - {name: weak_segment, factor: 0.5, length: 0.03, where: {curve: stem, at: 0.25}}
  - {name: wind, velocity: [1, 0, -0.5], drag_area: 0.01}
)";

PlantFile parsed(const std::string& text) {
  Diagnostics diagnostics;
  const auto plant = parse_plant(text, "p.plant.yaml", diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  return plant.value_or(PlantFile{});
}

TEST(PlantFileReader, ReadsThePlant) {
  const PlantFile plant = parsed(every_key);
  EXPECT_EQ(plant.name, "cherry tomato truss");
  EXPECT_EQ(plant.shape, Shape::rest);
  EXPECT_EQ(plant.look, Look::apple);
  EXPECT_EQ(plant.material, (MaterialValues{2.0e7, 0.35, 700.0, 0.01, {0.1, 0.05, 0.5}}));
  EXPECT_EQ(plant.connect, 0.01);
  EXPECT_EQ(plant.distance, 0.02);
  EXPECT_EQ(plant.root, Vec3(0, 0, 0.001));
  ASSERT_EQ(plant.supports.size(), 1u);
  EXPECT_EQ(plant.supports[0], (CurvePlace{"stem", 1.0, {}}));
  ASSERT_EQ(plant.masses.size(), 1u);
  EXPECT_EQ(plant.masses[0], (PlantMass{{"stem", 0.9, {}}, 0.02}));
}

TEST(PlantFileReader, ReadsCurves) {
  const PlantFile plant = parsed(every_key);
  ASSERT_EQ(plant.curves.size(), 3u);
  const PlantCurve& stem = plant.curves[0];
  EXPECT_EQ(stem.name, "stem");
  EXPECT_EQ(stem.interpolation, Interpolation::linear);
  EXPECT_EQ(stem.points, (std::vector<Vec3>{{0, 0, 0}, {0, 0, 0.1}, {0.01, 0, 0.2}}));
  EXPECT_EQ(stem.radius, (std::vector<double>{0.004, 0.0035, 0.003}));
  EXPECT_EQ(stem.section, SectionShape{});
  EXPECT_EQ(stem.material, (MaterialValues{3.0e7, {}, {}, {}}));
  EXPECT_EQ(stem.where.line, 12);
  EXPECT_EQ(stem.where.column, 5);
  const PlantCurve& truss = plant.curves[1];
  EXPECT_EQ(truss.interpolation, Interpolation::smooth);
  EXPECT_EQ(truss.radius, std::vector<double>{0.002});
  EXPECT_EQ(truss.section, (SectionShape{SectionKind::ellipse, 0.6, 0.0, 0.0, Vec3(0, 1, 0)}));
  EXPECT_EQ(truss.material, MaterialValues{});
  const PlantCurve& blade = plant.curves[2];
  EXPECT_TRUE(blade.radius.empty());
  EXPECT_EQ(blade.section, (SectionShape{SectionKind::rectangle, 1.0, 0.08, 0.001, Vec3(0, 0, 2)}));
}

TEST(PlantFileReader, ReadsFruitsLeavesAndEffects) {
  const PlantFile plant = parsed(every_key);
  ASSERT_EQ(plant.fruits.size(), 1u);
  EXPECT_EQ(
      plant.fruits[0],
      (PlantFruit{"fruit_1", {"truss", 1.0, {}}, 0.012, 950.0, {0.1, 0.31, 5.0, 0.2, 0.1}, {}}));
  ASSERT_EQ(plant.leaves.size(), 1u);
  EXPECT_EQ(
      plant.leaves[0],
      (PlantLeaf{"leaf_1", {"stem", 0.5, {}}, "tomato", 0.08, Vec3(0, 0, 1), Vec3(1, 0, 0), {}}));
  ASSERT_EQ(plant.effects.size(), 3u);
  EXPECT_EQ(plant.effects[0].number("stiffness"), 0.8);
  EXPECT_FALSE(plant.effects[0].place);
  EXPECT_EQ(plant.effects[1].number("factor"), 0.5);
  EXPECT_EQ(plant.effects[1].number("length"), 0.03);
  EXPECT_EQ(plant.effects[1].place, (CurvePlace{"stem", 0.25, {}}));
  EXPECT_EQ(plant.effects[2].numbers.at("velocity"), (std::vector<double>{1, 0, -0.5}));
}

TEST(PlantFileReader, FillsInTheDefaults) {
  const PlantFile plant = parsed(
      "format: pedicel-plant\nversion: 1\nname: p\n"
      "sampling: {connect: 0.01, distance: 0.02}\nroot: [0, 0, 0]\n"
      "curves: [{name: a, points: [[0, 0, 0], [0, 0, 1]], radius: 0.01,\n"
      "  material: {youngs_modulus: 5.0e+8, poisson_ratio: 0, density: 1, damping_time: 0}}]\n");
  EXPECT_EQ(plant.shape, Shape::drawn);
  EXPECT_EQ(plant.look, Look::tomato);
  EXPECT_EQ(plant.material, MaterialValues{});
  ASSERT_EQ(plant.curves.size(), 1u);
  EXPECT_EQ(plant.curves[0].interpolation, Interpolation::smooth);
  EXPECT_EQ(plant.curves[0].section, SectionShape{});
  EXPECT_EQ(plant.curves[0].material, (MaterialValues{5.0e8, 0.0, 1.0, 0.0}));
}

TEST(PlantFile, FindsCurvesByName) {
  const PlantFile plant = parsed(every_key);
  EXPECT_EQ(plant.curve_index("stem"), 0);
  EXPECT_EQ(plant.curve_index("blade"), 2);
  EXPECT_EQ(plant.curve_index("twig"), -1);
}

TEST(PlantWriter, EveryKeyReadsBack) {
  const PlantFile plant = parsed(every_key);
  const std::string text = plant_text(plant);
  EXPECT_EQ(parsed(text), plant) << text;
  EXPECT_EQ(plant_text(parsed(text)), text);
}

TEST(PlantWriter, WritesAFileThatReadsBack) {
  const PlantFile plant = parsed(every_key);
  const auto path = std::filesystem::path(::testing::TempDir()) / "pedicel_written.plant.yaml";
  write_plant_file(path, plant);
  Diagnostics diagnostics;
  EXPECT_EQ(read_plant_file(path, diagnostics), plant);
  EXPECT_EQ(diagnostics.text(), "");
  std::filesystem::remove(path);
}

TEST(PlantFileReader, ReportsAFileThatIsNotThere) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_plant_file("no/such.plant.yaml", diagnostics));
  EXPECT_THAT(diagnostics.text(), ::testing::HasSubstr("no/such.plant.yaml"));
}

class PlantNames : public ::testing::TestWithParam<std::string> {};

TEST_P(PlantNames, ReadBack) {
  PlantFile plant = parsed(every_key);
  plant.name = GetParam();
  plant.leaves[0].name = GetParam();
  EXPECT_EQ(parsed(plant_text(plant)), plant) << plant_text(plant);
}

INSTANTIATE_TEST_SUITE_P(All, PlantNames,
                         ::testing::Values("a: b", "#1", "null", "~", "3", "true", "two\nlines",
                                           "\"quoted\" \\ back", " blank ", "{x}", "- x", "é\t"));

// Numbers of any size, drawn at random: what is written reads back bit for bit.
TEST(PlantWriter, AnyNumberReadsBack) {
  Random random(7);
  const auto any = [&] { return std::pow(10.0, random.uniform(-9.0, 9.0)); };
  for (int round = 0; round < 50; ++round) {
    PlantFile plant = parsed(every_key);
    plant.material = {any(), random.uniform(-0.99, 0.5), any(), any()};
    plant.distance = any();
    for (PlantCurve& curve : plant.curves) {
      for (Vec3& point : curve.points)
        point += 1.0e-3 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      for (double& radius : curve.radius) radius = any();
    }
    plant.root = plant.curves[0].points.front();
    plant.fruits[0].place.at = random.uniform(0, 1);
    plant.fruits[0].detach.bend = any();
    plant.masses[0].mass = any();
    EXPECT_EQ(parsed(plant_text(plant)), plant) << plant_text(plant);
  }
}

// Each described number of an entry: one that it may be is written and read back, and one that it
// may not be is refused with its name and bounds.
template <typename Owner, typename Keys>
void expect_numbers_read_back(const Keys& keys, Owner& (*owner)(PlantFile&), int numbers) {
  constexpr double good = 0.0625, bad = -7.0;
  int seen = 0;
  for (const PlantKey<Owner>& key : keys) {
    EXPECT_FALSE(key.sentence.empty()) << key.name;
    EXPECT_EQ(find_key(keys, key.name), &key) << key.name << " is described twice";
    PlantFile plant = parsed(every_key);
    if (!key.is_number() || (key.stands && !key.stands(owner(plant)))) continue;
    ++seen;
    set_number_of(owner(plant), key, good);
    EXPECT_EQ(parsed(plant_text(plant)), plant) << plant_text(plant);
    EXPECT_THAT(plant_text(plant), ::testing::HasSubstr(std::string(key.name) + ": 0.0625"));
    set_number_of(owner(plant), key, bad);
    Diagnostics diagnostics;
    EXPECT_FALSE(parse_plant(plant_text(plant), "p.plant.yaml", diagnostics)) << key.name;
    EXPECT_THAT(diagnostics.text(),
                ::testing::HasSubstr(std::string(key.name) + " is \"-7\", expected " +
                                     io::bounds_text(key.bounds)));
  }
  EXPECT_EQ(seen, numbers);
}

TEST(PlantKeys, NumbersAreWrittenReadAndRefused) {
  const auto of = [](auto&& keys, auto owner, int numbers) {
    expect_numbers_read_back(keys, +owner, numbers);
  };
  of(
      material_keys, [](PlantFile& p) -> MaterialValues& { return p.material; }, 4);
  of(
      material_keys, [](PlantFile& p) -> MaterialValues& { return p.curves[0].material; }, 4);
  of(
      section_keys, [](PlantFile& p) -> SectionShape& { return p.curves[1].section; }, 1);
  of(
      section_keys, [](PlantFile& p) -> SectionShape& { return p.curves[2].section; }, 2);
  of(
      fruit_keys, [](PlantFile& p) -> PlantFruit& { return p.fruits[0]; }, 2);
  of(
      detach_keys, [](PlantFile& p) -> DetachLimits& { return p.fruits[0].detach; }, 5);
  of(
      leaf_keys, [](PlantFile& p) -> PlantLeaf& { return p.leaves[0]; }, 1);
  of(
      mass_keys, [](PlantFile& p) -> PlantMass& { return p.masses[0]; }, 1);
  of(
      sampling_keys, [](PlantFile& p) -> PlantFile& { return p; }, 2);
}

}  // namespace
}  // namespace pedicel::plant
