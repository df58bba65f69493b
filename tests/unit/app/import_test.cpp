// From a laboratory's files to an experiment that `validate` accepts, through the verb.
#include "app/verbs/import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/discrepancy/beam_experiment.h"
#include "tests/unit/import/c3d_file.h"

namespace pedicel::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr int samples = 40;
constexpr double rate = 100.0;  // Hz

/// m, W: the 0.4 m stem of the tests, whose tip swings along x. `m` counts middle and tip.
Vec3 place(int sample, int m) {
  const double way = 0.01 * std::cos(0.7 * sample) * std::exp(-0.02 * sample);
  return m == 0 ? Vec3(0.3125 * way, 0.0001 * std::sin(1.9 * sample), 0.2)
                : Vec3(way, 0.0001 * std::cos(2.3 * sample), 0.4);
}

std::string number(double value) {
  return io::format_number(value, 12);
}

class Import : public ::testing::Test {
 protected:
  Import() {
    plant::write_plant_file(folder_ / "stem.plant.yaml", discrepancy::testing::plant_of({}));
    a_.plant = (folder_ / "stem.plant.yaml").string();
    a_.out = (folder_ / "out").string();
    a_.places = {"P:m1=stem:0.5", "P:m2=stem:1"};
    a_.names = {"P:m1=middle", "P:m2=tip"};
    a_.quiet = true;
  }

  std::string file(const std::string& name, const std::string& text) {
    io::write_file_atomically(folder_ / name, text);
    return (folder_ / name).string();
  }

  /// Y up, in mm.
  std::string motive(const std::string& name) {
    std::string text =
        "Format Version,1.23,Export Frame Rate,100,Length Units,Millimeters,Coordinate "
        "Space,Global\n\n"
        ",Type,Marker,Marker,Marker,Marker,Marker,Marker\n,Name,P:m1,P:m1,P:m1,P:m2,P:m2,P:m2\n"
        ",ID,1,1,1,2,2,2\n,,Position,Position,Position,Position,Position,Position\n"
        "Frame,Time (Seconds),X,Y,Z,X,Y,Z\n";
    for (int s = 0; s < samples; ++s) {
      text += std::to_string(s) + "," + number(s / rate);
      for (int m = 0; m < 2; ++m) {
        const Vec3 x = 1000.0 * place(s, m);
        text += "," + number(x.x()) + "," + number(x.z()) + "," + number(-x.y());
      }
      text += "\n";
    }
    return file(name, text);
  }

  /// Z up, in mm, without a word of either.
  std::string qualisys(const std::string& name) {
    std::string text =
        "NO_OF_FRAMES\t40\nFREQUENCY\t100\nDATA_INCLUDED\t3D\nMARKER_NAMES\tP:m1\tP:m2\n";
    for (int s = 0; s < samples; ++s) {
      std::string row;
      for (int m = 0; m < 2; ++m)
        for (const double x : place(s, m)) row += (row.empty() ? "" : "\t") + number(1000.0 * x);
      text += row + "\n";
    }
    return file(name, text);
  }

  discrepancy::Experiment written() {
    Diagnostics diagnostics;
    const auto read = discrepancy::read_experiment(a_.out, diagnostics);
    EXPECT_TRUE(read) << diagnostics.text();
    return read.value_or(discrepancy::Experiment{});
  }

  /// Every marker where it was, in metres and Z up.
  static void expect_places(const discrepancy::Trial& trial, double across = 1e-8) {
    ASSERT_EQ(trial.markers.size(), samples);
    for (int s = 0; s < samples; ++s) {
      EXPECT_NEAR(trial.markers.time[s], s / rate, 1e-9);
      for (int m = 0; m < 2; ++m) {
        const Vec3 x = trial.markers.value.block<1, 3>(s, 3 * m).transpose();
        const Vec3 off = x - place(s, m);
        EXPECT_NEAR(std::hypot(off.x(), off.z()), 0.0, 1e-8);
        EXPECT_NEAR(off.y(), 0.0, across);
      }
    }
  }

  std::string usage() {
    try {
      import_verb(a_);
    } catch (const UsageError& fault) {
      return fault.what();
    }
    return {};
  }

  TemporaryFolder folder_;
  ImportArguments a_;
};

TEST_F(Import, SeveralMotiveFilesBecomeSeveralTrials) {
  a_.files = {motive("swing.csv"), motive("again.csv")};
  EXPECT_THAT(usage(),
              AllOf(HasSubstr("swing.csv: the file does not state which axis is up "
                              "(OptiTrack Motive CSV), expected --up x, --up y or --up z")));
  EXPECT_FALSE(std::filesystem::exists(a_.out));
  a_.up = "y";
  a_.begins = {"again=0.1"};
  a_.title = "a stem swings";
  import_verb(a_);
  const discrepancy::Experiment found = written();
  EXPECT_EQ(found.title, "a stem swings");
  ASSERT_THAT(found.trials, SizeIs(2));
  ASSERT_THAT(found.markers, SizeIs(2));
  EXPECT_EQ(found.markers[1].name, "tip");
  EXPECT_EQ(found.markers[1].place.at, 1.0);
  expect_places(found.trials[0]);
  ASSERT_EQ(found.trials[1].markers.size(), samples - 10);
  EXPECT_EQ(found.trials[1].markers.time[0], 0.0);
  EXPECT_NEAR(found.trials[1].markers.value(0, 3), place(10, 1).x(), 1e-8);
  EXPECT_TRUE(found.trials[0].holds.empty());
}

// The records of one swing are good data: validate says so, and the exit code is 0.
TEST_F(Import, WhatIsWrittenIsGood) {
  a_.files = {qualisys("swing.tsv")};
  EXPECT_THAT(usage(), AllOf(HasSubstr("does not state its unit of length (Qualisys TSV), expected "
                                       "--units"),
                             HasSubstr("expected --up")));
  a_.units = "mm";
  a_.up = "z";
  EXPECT_EQ(import_verb(a_), 0);
  expect_places(written().trials.at(0));
  EXPECT_EQ(written().trials.at(0).name, "swing");  // the ending says what the file is
}

TEST_F(Import, TheWrongAxisIsSeenInTheData) {
  a_.files = {qualisys("swing.tsv")};
  a_.units = "mm";
  a_.up = "y";
  EXPECT_EQ(import_verb(a_), 3);
}

TEST_F(Import, PixelsBecomeMetres) {
  std::string text =
      "scorer,n,n,n,n,n,n\nbodyparts,P:m1,P:m1,P:m1,P:m2,P:m2,P:m2\n"
      "coords,x,y,likelihood,x,y,likelihood\n";
  for (int s = 0; s < samples; ++s) {
    text += std::to_string(s);
    for (int m = 0; m < 2; ++m) {
      const Vec3 x = place(s, m) / 0.0005;
      text += "," + number(640 + x.x()) + "," + number(900 - x.z()) + ",0.99";
    }
    text += "\n";
  }
  a_.files = {file("film.csv", text)};
  EXPECT_THAT(usage(), AllOf(HasSubstr("--rate"), HasSubstr("--scale"), HasSubstr("--origin-pixel"),
                             HasSubstr("--up")));
  a_.rate = rate;
  a_.scale = 0.0005;
  a_.origin_pixel = "640,900";
  a_.up = "y";
  import_verb(a_);
  expect_places(written().trials.at(0), 2e-4);
  // The same through a camera: 2 m in front, 4000 pixels of focal length are 0.0005 m a pixel.
  a_.scale.reset();
  a_.origin_pixel.clear();
  a_.camera = file("camera.yaml",
                   "{position: [0, -2, 0], orientation: [-0.70710678118654752, 0, 0, "
                   "0.70710678118654752],\n focal: [4000, 4000], centre: [640, 900]}\n");
  a_.out = (folder_ / "seen").string();
  EXPECT_THAT(usage(), HasSubstr("one camera sees no depth, expected --plane"));
  a_.plane = "y=0";
  import_verb(a_);
  expect_places(written().trials.at(0), 2e-4);
}

TEST_F(Import, ViconTrackerAndC3dComeOutAlike) {
  std::string vicon =
      "Trajectories\n100\n,,P:m1,,,P:m2,,\nFrame,Sub Frame,X,Y,Z,X,Y,Z\n"
      ",,mm,mm,mm,mm,mm,mm\n";
  std::string tracker = "#multi:\n\tP:m1\t\tP:m2\t\nt\tx\ty\tx\ty\n";
  discrepancy::testing::C3dFile c3d;
  c3d.labels = {"P:m1", "P:m2"};
  c3d.unit = "m";
  c3d.up = "+Z";
  c3d.frames.clear();
  for (int s = 0; s < samples; ++s) {
    vicon += std::to_string(s + 1) + ",0";
    tracker += number(s / rate);
    c3d.frames.push_back({place(s, 0), place(s, 1)});
    for (int m = 0; m < 2; ++m) {
      const Vec3 x = place(s, m);
      for (const double coordinate : x) vicon += "," + number(1000.0 * coordinate);
      tracker += "\t" + number(x.x()) + "\t" + number(x.z());
    }
    vicon += "\n";
    tracker += "\n";
  }
  a_.files = {file("swing.c3d", c3d.bytes())};
  EXPECT_EQ(import_verb(a_), 0);
  expect_places(written().trials.at(0));
  a_.up = "z";
  a_.files = {file("vicon.csv", vicon)};
  EXPECT_EQ(import_verb(a_), 0);
  expect_places(written().trials.at(0));
  a_.up = "y";
  a_.units = "m";
  a_.files = {file("tracker.txt", tracker)};
  import_verb(a_);
  expect_places(written().trials.at(0), 2e-4);
}

TEST_F(Import, AMachineLeadsAndMeasures) {
  a_.files = {qualisys("pull.tsv")};
  a_.units = "mm";
  a_.up = "z";
  a_.lead = "stem:0.9";
  a_.forces = {
      file("machine.csv", "Time,Extension,Load\n(s),(mm),(N)\n5,10,0\n5.1,11,0.1\n5.2,12,0.2\n")};
  EXPECT_THAT(usage(), AllOf(HasSubstr("expected --force-direction"), HasSubstr("--force-begin"),
                             HasSubstr("--extension-column")));
  a_.force_direction = "x";
  a_.extension = "Extension";
  a_.force_begins = {"5"};
  a_.releases = {"0.15"};
  import_verb(a_);
  const discrepancy::Experiment found = written();
  const discrepancy::Trial& trial = found.trials.at(0);
  ASSERT_THAT(trial.holds, SizeIs(1));
  EXPECT_EQ(trial.holds[0].release, 0.15);
  EXPECT_EQ(trial.holds[0].place.at, 0.9);
  ASSERT_THAT(trial.holds[0].path.time, SizeIs(3));
  EXPECT_NEAR((trial.holds[0].path.position[2] - Vec3(0.002, 0, 0.36)).norm(), 0.0, 1e-9);
  ASSERT_EQ(trial.force.size(), 3);
  EXPECT_NEAR(trial.force.time[1], 0.1, 1e-9);
  EXPECT_NEAR(trial.force.value(2, 0), 0.2, 1e-12);
}

TEST_F(Import, APointLeads) {
  a_.files = {motive("pull.csv")};
  a_.up = "y";
  a_.places = {"P:m1=stem:0.5"};
  a_.names.clear();
  a_.holds = {"P:m2=stem:1"};
  a_.stiffness = 150.0;
  import_verb(a_);
  const discrepancy::Trial trial = written().trials.at(0);
  ASSERT_THAT(trial.holds, SizeIs(1));
  EXPECT_EQ(trial.holds[0].stiffness, 150.0);
  ASSERT_THAT(trial.holds[0].path.position, SizeIs(samples));
  EXPECT_NEAR((trial.holds[0].path.position[7] - place(7, 1)).norm(), 0.0, 1e-8);
}

TEST_F(Import, RefusesByName) {
  a_.files = {motive("swing.csv")};
  a_.up = "y";
  const auto expect = [&](const std::string& sentence, const std::function<void()>& change) {
    const ImportArguments keep = a_;
    change();
    EXPECT_THAT(usage(), HasSubstr(sentence));
    a_ = keep;
  };
  expect("expected --plant with a plant file", [&] { a_.plant.clear(); });
  expect("expected --place POINT=CURVE:AT; the points are \"P:m1\", \"P:m2\", the curves \"stem\"",
         [&] { a_.places.clear(), a_.names.clear(); });
  expect("swing.csv has no point \"m9\", expected one of \"P:m1\", \"P:m2\"",
         [&] { a_.places.push_back("m9=stem:0.1"); });
  expect("the plant has no curve \"twig\", expected one of \"stem\"",
         [&] { a_.places[0] = "P:m1=twig:0.1"; });
  expect("\"2\" is no place, expected a fraction", [&] { a_.places[0] = "P:m1=stem:2"; });
  expect("expected POINT=CURVE:AT", [&] { a_.places[0] = "P:m1"; });
  expect("has no place, expected --place for it", [&] { a_.names = {"m9=tip"}; });
  expect("cannot head a column", [&] { a_.names = {"P:m1=a,b"}; });
  expect("marker \"tip\" comes twice", [&] { a_.names = {"P:m1=tip", "P:m2=tip"}; });
  expect("two files give the trial \"swing\"", [&] { a_.files.push_back(a_.files[0]); });
  expect("--units \"furlong\": expected m, cm, mm", [&] { a_.units = "furlong"; });
  expect("expected a --begin within the recording (0 to 0.39 s)", [&] { a_.begins = {"9"}; });
  expect("a second one for all trials", [&] { a_.begins = {"0", "other=1"}; });
  expect("expected a time in s", [&] { a_.begins = {"soon"}; });
  expect("a force needs what holds the plant", [&] {
    a_.forces = {file("f.csv", "Time (s),Load (N)\n0,1\n")};
    a_.force_direction = "x";
    a_.force_begins = {"0"};
  });
  a_.files = {(folder_ / "none.csv").string()};
  EXPECT_THROW(import_verb(a_), InvalidFile);
}

TEST_F(Import, WhatIsNotThereIsToldBeforeAnythingElse) {
  a_.plant.clear();
  for (const std::string name : {"none.csv", "none.mcap"}) {
    a_.files = {(folder_ / name).string()};
    try {
      import_verb(a_);
      FAIL();
    } catch (const InvalidFile& fault) {
      EXPECT_THAT(fault.what(), HasSubstr(name + ": error: cannot be read: No such file"));
    }
  }
  a_.files = {file("no_log.mcap", "plain text\n")};
  EXPECT_THROW(import_verb(a_), InvalidFile) << "by its name it is a log";
}

TEST_F(Import, WhatIsSomebodyElsesStays) {
  a_.files = {motive("swing.csv")};
  a_.up = "y";
  std::filesystem::create_directories(a_.out);
  file("out/experiment.yaml", "mine\n");
  EXPECT_THROW(import_verb(a_), io::WriteError);
  EXPECT_EQ(io::read_file(folder_ / "out/experiment.yaml"), "mine\n");
}

}  // namespace
}  // namespace pedicel::app
