// Each rule of the experiment folder with the smallest folder that breaks it: where the error
// stands, and its words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "engine/io/atomic_file.h"
#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::discrepancy {
namespace {

using ::testing::HasSubstr;

const std::string head = "format: pedicel-experiment\nversion: 1\nplant: plant.yaml\n";
const std::string markers = "markers: [{name: m, curve: stem, at: 1}]\n";  // line 4
const std::string hold = "{kind: hold, curve: stem, at: 1, path: hold.csv}";

std::string trial(const std::string& drive, const std::string& more = "") {
  return "trials:\n  - {name: t, folder: t, " + more + "drive: [" + drive + "]}\n";  // line 6
}
std::string whole(const std::string& drive, const std::string& more = "") {
  return head + markers + trial(drive, more);
}

/// A good folder.
std::map<std::string, std::string> good_files() {
  return {{"experiment.yaml", whole(hold)},
          {"plant.yaml",
           "format: pedicel-plant\nversion: 1\nname: p\n"
           "material: {youngs_modulus: 5e+08, poisson_ratio: 0.3, density: 900, damping_time: 0}\n"
           "sampling: {connect: 0.01, distance: 0.1}\nroot: [0, 0, 0]\n"
           "curves: [{name: stem, points: [[0, 0, 0], [0, 0, 1]], radius: 0.01}]\n"},
          {"t/markers.csv", "time,m.x,m.y,m.z\n0,0,0,1\n0.1,,,\n"},
          {"t/hold.csv", "time,x,y,z\n0,0,0,1\n"},
          {"t/force.csv", "time,fx,fy,fz\n0,0,0,0\n"}};
}

struct Case {
  std::string name, file, text, expected;
};
std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

std::string faults_of(const std::map<std::string, std::string>& files) {
  const TemporaryFolder folder;
  for (const auto& [name, text] : files) io::write_file_atomically(folder / name, text);
  Diagnostics diagnostics;
  const auto experiment = read_experiment(folder / "", diagnostics);
  EXPECT_EQ(experiment.has_value(), !diagnostics.has_errors());
  return diagnostics.text();
}

TEST(ExperimentFolder, IsGood) {
  EXPECT_EQ(faults_of(good_files()), "");
}

TEST(ExperimentFolder, MarkersMayComeInAnyOrder) {
  auto files = good_files();
  files["t/markers.csv"] = "time,m.z,m.x,m.y\n0,3,1,2\n";
  EXPECT_EQ(faults_of(files), "");
}

TEST(ExperimentFolder, ShowsEveryFaultAtOnce) {
  auto files = good_files();
  files["experiment.yaml"] = head + "markers: [{name: m, curve: twig, at: 2}]\n" +
                             trial("{kind: load, curve: stem, at: 1, force: [0, 0]}", "use: no, ");
  files["t/markers.csv"] = "time,k.x\n0,1\n";
  const std::string text = faults_of(files);
  for (const char* part :
       {"4:28: error: curve \"twig\" is unknown, expected one of: stem", "4:38: error: at is \"2\"",
        "use is \"no\", expected one of: fit, check", "force is a list of 2",
        "t/markers.csv:1:6: error: column \"k.x\" is unknown"})
    EXPECT_THAT(text, HasSubstr(part));
}

TEST(ExperimentFolder, AForceWhereNothingIsHeldIsAWarning) {
  auto files = good_files();
  files["experiment.yaml"] = whole("{kind: none}");
  EXPECT_THAT(faults_of(files), HasSubstr("force.csv:1:1: warning: a force was measured"));
}

class ExperimentRefusal : public ::testing::TestWithParam<Case> {};

TEST_P(ExperimentRefusal, IsDiagnosedWithPlaceAndWords) {
  auto files = good_files();
  files[GetParam().file] = GetParam().text;
  EXPECT_THAT(faults_of(files), HasSubstr(GetParam().expected));
}

const char* const yaml = "experiment.yaml";
const Case yaml_cases[] = {
    {"other_format", yaml, "format: pedicel-plant\nversion: 1\n", "experiment.yaml:1:"},
    {"other_version", yaml, "format: pedicel-experiment\nversion: 2\n", "experiment.yaml:2:"},
    {"unknown_key", yaml, whole(hold) + "colour: red\n",
     "experiment.yaml:7:1: error: unknown key \"colour\" in an experiment"},
    {"no_plant", yaml, "format: pedicel-experiment\nversion: 1\n" + markers + trial(hold),
     "missing key \"plant\""},
    {"plant_missing", yaml,
     "format: pedicel-experiment\nversion: 1\nplant: p.yaml\n" + markers + trial(hold),
     "p.yaml: error: cannot be read"},
    {"no_markers", yaml, head + trial(hold), "missing key \"markers\""},
    {"empty_markers", yaml, head + "markers: []\n" + trial(hold),
     "4:10: error: no markers, expected at least one"},
    {"marker_twice", yaml,
     head + "markers: [{name: m, curve: stem, at: 1}, {name: m, curve: stem, at: 0}]\n" +
         trial(hold),
     "4:42: error: markers: \"m\" appears twice"},
    {"marker_curve", yaml, head + "markers: [{name: m, curve: twig, at: 1}]\n" + trial(hold),
     "4:28: error: curve \"twig\" is unknown, expected one of: stem"},
    {"noise_zero", yaml, head + "noise: {position_std: 0}\n" + markers + trial(hold),
     "4:23: error: position_std is \"0\", expected a number > 0"},
    {"noise_key", yaml, head + "noise: {position: 1}\n" + markers + trial(hold),
     "unknown key \"position\" in noise"},
    {"no_trials", yaml, head + markers, "missing key \"trials\""},
    {"empty_trials", yaml, head + markers + "trials: []\n",
     "5:9: error: no trials, expected at least one"},
    {"trial_folder", yaml,
     head + markers + "trials: [{name: t, folder: u, drive: [{kind: none}]}]\n",
     "5:28: error: folder "},
    {"trial_twice", yaml, whole(hold) + "  - {name: t, folder: t, drive: [{kind: none}]}\n",
     "7:5: error: trial \"t\" appears twice"},
    {"use", yaml, whole(hold, "use: test, "), "use is \"test\", expected one of: fit, check"},
    {"clock", yaml, whole(hold, "clock: noon, "), "clock is \"noon\""},
    {"gravity", yaml, whole(hold, "gravity: [1], "), "gravity is a list of 1"},
    {"mass", yaml, whole(hold, "masses: [{curve: stem, at: 1, mass: -1}], "),
     "mass is \"-1\", expected a number > 0"},
    {"mass_curve", yaml, whole(hold, "masses: [{curve: twig, at: 1, mass: 1}], "),
     "curve \"twig\" is unknown"},
    {"no_drive", yaml, head + markers + "trials: [{name: t, folder: t}]\n",
     "missing key \"drive\""},
    {"drive_kind", yaml, whole("{kind: push}"),
     "kind is \"push\", expected one of: hold, load, base, none"},
    {"none_and_more", yaml, whole("{kind: none}, " + hold), "kind none beside another drive"},
    {"two_bases", yaml, whole("{kind: base, path: hold.csv}, {kind: base, path: hold.csv}"),
     "a second base, expected one at most"},
    {"hold_curve", yaml, whole("{kind: hold, curve: twig, at: 1, path: hold.csv}"),
     "curve \"twig\" is unknown"},
    {"hold_no_path", yaml, whole("{kind: hold, curve: stem, at: 1}"), "missing key \"path\""},
    {"hold_path", yaml, whole("{kind: hold, curve: stem, at: 1, path: no.csv}"),
     "t/no.csv: error: cannot be read"},
    {"hold_stiffness", yaml,
     whole("{kind: hold, curve: stem, at: 1, path: hold.csv, stiffness: 0}"),
     "stiffness is \"0\", expected a number > 0"},
    {"hold_release", yaml, whole("{kind: hold, curve: stem, at: 1, path: hold.csv, release: -1}"),
     "release is \"-1\", expected a number > 0"},
    {"load_order", yaml,
     whole("{kind: load, curve: stem, at: 1, force: [1, 0, 0], from: 2, to: 1}"),
     "the load ends before it begins"},
    {"effect_unknown", yaml, whole(hold) + "effects: [{name: magic}]\n",
     "effect \"magic\" is unknown"},
    {"effect_of_plant", yaml, whole(hold, "effects: [{name: base_compliance, stiffness: 1}], "),
     "effect \"base_compliance\" is expected in the plant file, not here"},
    {"effect_marker", yaml,
     whole(hold) + "effects: [{name: marker_offset, marker: q, offset: [0, 0, 0]}]\n",
     "7:11: error: marker \"q\" is unknown, expected one of: m"},
};
INSTANTIATE_TEST_SUITE_P(Yaml, ExperimentRefusal, ::testing::ValuesIn(yaml_cases),
                         [](const auto& one) { return one.param.name; });

const Case table_cases[] = {
    {"plant", "plant.yaml", "format: pedicel-plant\nversion: 1\n",
     "plant.yaml:1:1: error: missing"},
    {"no_time", "t/markers.csv", "m.x,m.y,m.z\n0,0,1\n",
     "t/markers.csv:1:1: error: the first column is \"m.x\", expected time, and no other column"},
    {"time_empty", "t/markers.csv", "time,m.x,m.y,m.z\n,0,0,1\n",
     "t/markers.csv:2:1: error: time is empty, expected a time"},
    {"other_names", "t/markers.csv", "time,a,b,c\n1,0,0,1\n",
     "t/markers.csv:1:6: error: columns \"a\", \"b\", \"c\" are unknown and there is no m.x, m.y, "
     "m.z, expected time and x, y, z of each marker: m"},
    {"time_negative", "t/markers.csv", "time,m.x,m.y,m.z\n-1,0,0,1\n",
     "t/markers.csv:2:1: error: time -1 is before the trial begins"},
    {"time_order", "t/markers.csv", "time,m.x,m.y,m.z\n1,0,0,1\n1,0,0,1\n",
     "t/markers.csv:3:1: error: time 1 does not increase"},
    {"marker_column", "t/markers.csv", "time,m.x,m.y,m.z,n.x\n0,0,0,1,1\n",
     "t/markers.csv:1:18: error: column \"n.x\" is unknown, expected time and x, y, z of each "
     "marker: m"},
    {"column_missing", "t/hold.csv", "time,x,y\n0,0,0\n", "t/hold.csv:1:1: error: no column z"},
    {"column_twice", "t/markers.csv", "time,m.x,m.y,m.z,m.x\n0,0,0,1,1\n",
     "t/markers.csv:1:18: error: column m.x appears twice"},
    {"half_a_point", "t/markers.csv", "time,m.x,m.y,m.z\n0,0,0,1\n1,12,,0\n",
     "t/markers.csv:3:6: error: m.y is empty where the other axes are not"},
    {"no_number", "t/markers.csv", "time,m.x,m.y,m.z\n0,0,zero,1\n",
     "t/markers.csv:2:5: error: m.y: \"zero\" is not a finite number"},
    {"cells", "t/markers.csv", "time,m.x,m.y,m.z\n0,0,1\n",
     "t/markers.csv:2:1: error: 3 cells, expected 4"},
    {"hold_gap", "t/hold.csv", "time,x,y,z\n0,0,,1\n", "t/hold.csv:2:5: error: y: \"\""},
    {"hold_columns", "t/hold.csv", "time,x,y,z,qx\n0,0,0,1,0\n",
     "t/hold.csv:1:1: error: no column qy, qz, qw, expected time,x,y,z or time,x,y,z,qx,qy,qz,qw"},
    {"hold_quaternion", "t/hold.csv", "time,x,y,z,qx,qy,qz,qw\n0,0,0,1,0,0,0,0\n",
     "t/hold.csv:2:9: error: the quaternion has length 0"},
    {"force_columns", "t/force.csv", "time,x,y,z\n0,0,0,1\n",
     "t/force.csv:1:6: error: columns \"x\", \"y\", \"z\" are unknown and there is no fx, fy, fz, "
     "expected time,fx,fy,fz"},
    {"events_header", "t/events.csv", "time,what\n",
     "t/events.csv:1:1: error: no column event, expected time,event,what"},
    {"events_cells", "t/events.csv", "time,event,what\n1,detached\n",
     "t/events.csv:2:1: error: 2 cells, expected 3 as in the header"},
    {"events_time", "t/events.csv", "time,event,what\nnow,detached,f\n",
     "t/events.csv:2:1: error: time: \"now\" is not a finite number"},
    {"events_fruit", "t/events.csv", "time,event,what\n1,detached,pear\n",
     "t/events.csv:2:12: error: what: \"pear\" is no fruit of plant"},
};
INSTANTIATE_TEST_SUITE_P(Tables, ExperimentRefusal, ::testing::ValuesIn(table_cases),
                         [](const auto& one) { return one.param.name; });

TEST(ExperimentFolder, WithoutMarkersIsRefused) {
  auto files = good_files();
  files.erase("t/markers.csv");
  EXPECT_THAT(faults_of(files), HasSubstr("t/markers.csv: error: cannot be read"));
}

}  // namespace
}  // namespace pedicel::discrepancy
