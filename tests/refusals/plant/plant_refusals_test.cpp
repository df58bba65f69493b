// Each rule of the plant file with the smallest file that breaks it: where the error stands, and
// its words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugins/plant/plant_file.h"

namespace pedicel::plant {
namespace {

using ::testing::HasSubstr;

const std::string head =
    "format: pedicel-plant\n"
    "version: 1\n"
    "name: p\n";
const std::string material =
    "material: {youngs_modulus: 1e9, poisson_ratio: 0.3, density: 900, damping_time: 0.01}\n";
const std::string sampling = "sampling: {connect: 0.01, distance: 0.02}\n";
const std::string root = "root: [0, 0, 0]\n";
const std::string frame = head + material + sampling + root;  // 6 lines
const std::string points = "points: [[0, 0, 0], [0, 0, 1]]";
const std::string stem = "  - {name: stem, " + points + ", radius: 0.01}\n";
const std::string whole = frame + "curves:\n" + stem;  // 8 lines

std::string with_curve(const std::string& keys) {
  return frame + "curves:\n  - {name: stem, " + keys + "}\n";
}

struct Case {
  std::string name;
  std::string text;
  std::string expected;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

class PlantRefusal : public ::testing::TestWithParam<Case> {};

TEST(PlantFrame, IsAGoodPlant) {
  Diagnostics diagnostics;
  EXPECT_TRUE(parse_plant(whole, "p.plant.yaml", diagnostics));
  EXPECT_EQ(diagnostics.text(), "");
}

TEST_P(PlantRefusal, IsDiagnosedWithPlaceAndWords) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_plant(GetParam().text, "p.plant.yaml", diagnostics));
  EXPECT_THAT(diagnostics.text(), HasSubstr(GetParam().expected));
}

const Case head_cases[] = {
    {"other_format", "format: pedicel-scene\nversion: 1\n", "p.plant.yaml:1:"},
    {"other_version", "format: pedicel-plant\nversion: 2\n", "p.plant.yaml:2:"},
    {"no_yaml", "format: [\n", "p.plant.yaml"},
    {"unknown_key", whole + "colour: red\n",
     "p.plant.yaml:9:1: error: unknown key \"colour\" in a plant file"},
    {"no_name", "format: pedicel-plant\nversion: 1\n", "missing key \"name\""},
    {"no_sampling", head + material + root + "curves:\n" + stem, "missing key \"sampling\""},
    {"no_root", head + material + sampling + "curves:\n" + stem, "missing key \"root\""},
    {"no_curves", frame, "missing key \"curves\""},
    {"empty_curves", frame + "curves: []\n",
     "p.plant.yaml:1:1: error: a plant without curves, expected at least one"},
    {"look", whole + "look: pear\n",
     "9:7: error: look is \"pear\", expected one of: tomato, apple"},
    {"shape", whole + "shape: bent\n",
     "9:8: error: shape is \"bent\", expected one of: drawn, rest"},
    {"connect_zero", head + material + root + "sampling: {connect: 0, distance: 1}\n",
     "6:21: error: connect is \"0\", expected a number > 0"},
    {"distance_negative", head + material + root + "sampling: {connect: 1, distance: -1}\n",
     "distance is \"-1\", expected a number > 0"},
    {"root_short", head + "root: [0, 0]\n", "4:7: error: root is a list of 2, expected [x, y, z]"},
    {"root_far", head + material + sampling + "root: [0, 0, 0.5]\ncurves:\n" + stem,
     "p.plant.yaml:1:1: error: the root is 0.5 m from the nearest curve end, of curve \"stem\", "
     "expected at most connect = 0.01 m"},
};

const Case material_cases[] = {
    {"modulus_negative", head + "material: {youngs_modulus: -1}\n",
     "4:28: error: youngs_modulus is \"-1\", expected a number > 0"},
    {"modulus_nan", head + "material: {youngs_modulus: .nan}\n", "youngs_modulus is \".nan\""},
    {"poisson_high", head + "material: {poisson_ratio: 0.6}\n",
     "poisson_ratio is \"0.6\", expected a number > -1 and at most 0.5"},
    {"poisson_low", head + "material: {poisson_ratio: -1}\n", "poisson_ratio is \"-1\""},
    {"density_zero", head + "material: {density: 0}\n", "density is \"0\", expected a number > 0"},
    {"damping_negative", head + "material: {damping_time: -1}\n",
     "damping_time is \"-1\", expected a number >= 0"},
    {"material_key", head + "material: {modulus: 1}\n", "unknown key \"modulus\" in material"},
    {"no_modulus", head + sampling + root + "curves:\n" + stem,
     "p.plant.yaml:7:5: error: curve \"stem\" has no youngs_modulus, expected it in its own "
     "material or in the plant's"},
    {"no_poisson", head + sampling + root + "curves:\n" + stem, "has no poisson_ratio, expected"},
    {"no_density", head + sampling + root + "curves:\n" + stem, "has no density, expected"},
    {"no_damping", head + sampling + root + "curves:\n" + stem, "has no damping_time, expected"},
};

const Case curve_cases[] = {
    {"curve_without_name", frame + "curves: [{" + points + ", radius: 1}]\n",
     "7:10: error: missing key \"name\""},
    {"curve_twice", whole + stem,
     "p.plant.yaml:9:5: error: curve \"stem\" appears twice, expected each name once"},
    {"curve_key", with_curve(points + ", radius: 1, bark: 1"), "unknown key \"bark\" in a curve"},
    {"interpolation", with_curve(points + ", radius: 1, interpolation: cubic"),
     "interpolation is \"cubic\", expected one of: smooth, linear"},
    {"no_points", with_curve("radius: 1"), "missing key \"points\""},
    {"one_point", with_curve("points: [[0, 0, 0]], radius: 1"),
     "p.plant.yaml:8:5: error: curve \"stem\" has 1 point, expected at least 2"},
    {"no_point_at_all", with_curve("points: [], radius: 1"), "has 0 points, expected at least 2"},
    {"flat_point", with_curve("points: [[0, 0], [0, 0, 1]], radius: 1"),
     "8:27: error: point 1 is a list of 2, expected [x, y, z]"},
    {"nan_point", with_curve("points: [[0, 0, .nan], [0, 0, 1]], radius: 1"),
     "point 1 is \".nan\", expected a finite number"},
    {"far_point", with_curve("points: [[0, 0, 0], [0, 0, 1e308]], radius: 1"),
     "8:5: error: curve \"stem\": point 2 is 1e+308 m from the origin, expected at most 1e+07 m"},
    {"equal_points", with_curve("points: [[0, 0, 0], [0, 0, 1], [0, 0, 1]], radius: 1"),
     "p.plant.yaml:8:5: error: curve \"stem\": points 2 and 3 are equal, expected them apart"},
    {"no_radius", with_curve(points), "8:5: error: missing key \"radius\""},
    {"ellipse_without_radius",
     with_curve(points + ", section: {kind: ellipse, ratio: 0.5, normal: [1, 0, 0]}"),
     "missing key \"radius\""},
    {"radius_zero", with_curve(points + ", radius: 0"), "radius is \"0\", expected a number > 0"},
    {"radius_list", with_curve(points + ", radius: [1, 1, 1]"),
     "p.plant.yaml:8:5: error: curve \"stem\" has 3 radii for 2 points, expected one number or one "
     "a point"},
};

std::string with_section(const std::string& section) {
  return with_curve(points + ", radius: 0.01, section: {" + section + "}");
}

const Case section_cases[] = {
    {"section_kind", with_section("kind: star"),
     "kind is \"star\", expected one of: circle, ellipse, rectangle"},
    {"circle_with_ratio", with_section("kind: circle, ratio: 0.5"),
     "unknown key \"ratio\" in section"},
    {"ellipse_ratio_absent", with_section("kind: ellipse, normal: [1, 0, 0]"),
     "missing key \"ratio\""},
    {"ellipse_ratio_high", with_section("kind: ellipse, ratio: 1.5, normal: [1, 0, 0]"),
     "ratio is \"1.5\", expected a number > 0 and at most 1"},
    {"ellipse_normal_absent", with_section("kind: ellipse, ratio: 0.5"), "missing key \"normal\""},
    {"normal_zero", with_section("kind: ellipse, ratio: 0.5, normal: [0, 0, 0]"),
     "normal has length 0, expected a direction [x, y, z]"},
    {"normal_along", with_section("kind: ellipse, ratio: 0.5, normal: [0, 0, 2]"),
     "p.plant.yaml:8:5: error: curve \"stem\": its normal runs along the curve from point 1 to 2, "
     "expected a direction across it"},
    {"rectangle_width_absent", with_section("kind: rectangle, height: 1, normal: [1, 0, 0]"),
     "missing key \"width\""},
    {"rectangle_height_zero",
     with_section("kind: rectangle, width: 1, height: 0, normal: [1, 0, 0]"),
     "height is \"0\", expected a number > 0"},
    {"rectangle_upright",
     with_section("kind: rectangle, width: 0.001, height: 0.08, normal: [1, 0, 0]"),
     "p.plant.yaml:8:5: error: curve \"stem\": the height 0.08 m is over the width 0.001 m, "
     "expected the height, along normal, to be the smaller extent"},
};

const std::string fruit = "  - {name: f, curve: stem, at: 1, radius: 0.01, density: 900";
const std::string leaf =
    "  - {name: l, curve: stem, at: 1, template: t, size: 0.1, normal: [0, 0, 1]";

const Case carried_cases[] = {
    {"support_unknown", whole + "supports:\n  - {curve: twig, at: 1}\n",
     "p.plant.yaml:10:13: error: a support is on curve \"twig\", which is unknown, expected one "
     "of: stem"},
    {"support_at", whole + "supports:\n  - {curve: stem, at: 1.5}\n",
     "10:23: error: at is \"1.5\", expected a number between 0 and 1"},
    {"fruit_unknown", whole + "fruits: [{name: f, curve: twig, at: 1, radius: 1, density: 1}]\n",
     "p.plant.yaml:9:27: error: fruit \"f\" is on curve \"twig\", which is unknown"},
    {"fruit_twice", whole + "fruits:\n" + fruit + "}\n" + fruit + "}\n",
     "p.plant.yaml:11:5: error: fruit \"f\" appears twice, expected each name once"},
    {"fruit_without_density", whole + "fruits: [{name: f, curve: stem, at: 1, radius: 1}]\n",
     "missing key \"density\""},
    {"fruit_limit", whole + "fruits:\n" + fruit + ", detach: {bend: 0}}\n",
     "bend is \"0\", expected a number > 0"},
    {"fruit_limit_key", whole + "fruits:\n" + fruit + ", detach: {pull: 1}}\n",
     "unknown key \"pull\" in detach"},
    {"leaf_unknown",
     whole + "leaves: [{name: l, curve: twig, at: 1, template: t, size: 1, normal: [0, 0, 1]}]\n",
     "p.plant.yaml:9:27: error: leaf \"l\" is on curve \"twig\", which is unknown"},
    {"leaf_twice", whole + "leaves:\n" + leaf + "}\n" + leaf + "}\n",
     "p.plant.yaml:11:5: error: leaf \"l\" appears twice"},
    {"leaf_without_template",
     whole + "leaves: [{name: l, curve: stem, at: 1, size: 1, normal: [0, 0, 1]}]\n",
     "missing key \"template\""},
    {"mass_unknown", whole + "masses: [{curve: twig, at: 1, mass: 1}]\n",
     "p.plant.yaml:9:18: error: a mass is on curve \"twig\", which is unknown"},
    {"mass_zero", whole + "masses: [{curve: stem, at: 1, mass: 0}]\n",
     "mass is \"0\", expected a number > 0"},
};

std::string with_effect(const std::string& keys) {
  return whole + "effects: [{" + keys + "}]\n";
}

const Case effect_cases[] = {
    {"effect_without_name", with_effect("stiffness: 1"), "9:11: error: missing key \"name\""},
    {"effect_unknown", with_effect("name: magic"),
     "9:18: error: effect \"magic\" is unknown, expected one of: youngs_modulus"},
    {"effect_of_the_experiment", with_effect("name: latency, delay: 1"),
     "effect \"latency\" is expected in experiment.yaml, not here"},
    {"effect_parameter_absent", with_effect("name: base_compliance"), "missing key \"stiffness\""},
    {"effect_parameter_zero", with_effect("name: base_compliance, stiffness: 0"),
     "stiffness is \"0\", expected a number > 0"},
    {"effect_parameter_unknown", with_effect("name: base_compliance, stiffness: 1, size: 1"),
     "unknown key \"size\" in an effect"},
    {"effect_without_place", with_effect("name: extra_mass, mass: 1"), "missing key \"where\""},
    {"effect_on_unknown_curve",
     with_effect("name: extra_mass, mass: 1, where: {curve: twig, at: 1}"),
     "p.plant.yaml:9:54: error: effect \"extra_mass\" is on curve \"twig\", which is unknown"},
    {"friction_with_neither", with_effect("name: internal_friction, ratio: 0.5"),
     "internal_friction gives neither of moment and curvature, expected one of them"},
    {"friction_with_both",
     with_effect("name: internal_friction, ratio: 0.5, moment: 1, curvature: 1"),
     "internal_friction gives both of moment and curvature"},
};

std::string name_of(const ::testing::TestParamInfo<Case>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Head, PlantRefusal, ::testing::ValuesIn(head_cases), name_of);
INSTANTIATE_TEST_SUITE_P(Material, PlantRefusal, ::testing::ValuesIn(material_cases), name_of);
INSTANTIATE_TEST_SUITE_P(Curve, PlantRefusal, ::testing::ValuesIn(curve_cases), name_of);
INSTANTIATE_TEST_SUITE_P(Section, PlantRefusal, ::testing::ValuesIn(section_cases), name_of);
INSTANTIATE_TEST_SUITE_P(Carried, PlantRefusal, ::testing::ValuesIn(carried_cases), name_of);
INSTANTIATE_TEST_SUITE_P(Effects, PlantRefusal, ::testing::ValuesIn(effect_cases), name_of);

// All faults of a file come in one pass.
TEST(PlantRefusals, AreCollected) {
  Diagnostics diagnostics;
  const std::string text = whole + stem + "masses: [{curve: twig, at: 1, mass: 1}]\n";
  EXPECT_FALSE(parse_plant(text, "p.plant.yaml", diagnostics));
  EXPECT_EQ(diagnostics.error_count(), 2) << diagnostics.text();
}

// A plant made in memory has no reader that misses its radius or its normal.
TEST(PlantRefusals, ReachPlantsMadeInMemory) {
  Diagnostics diagnostics;
  PlantFile plant = parse_plant(whole, "p", diagnostics).value();
  plant.curves[0].radius.clear();
  EXPECT_FALSE(check_plant(plant, diagnostics));
  EXPECT_THAT(diagnostics.text(), HasSubstr("curve \"stem\" has no radius, expected one"));
  plant.curves[0].section = {SectionKind::rectangle, 1.0, 0.1, 0.01, Vec3::Zero()};
  EXPECT_FALSE(check_plant(plant, diagnostics));
  EXPECT_THAT(diagnostics.text(), HasSubstr("its normal has length 0"));
  plant.curves[0].section.normal = Vec3::UnitX();
  Diagnostics none;
  EXPECT_TRUE(check_plant(plant, none)) << none.text();
}

}  // namespace
}  // namespace pedicel::plant
