#include "app/verbs/validate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "engine/io/atomic_file.h"
#include "tests/support/places.h"

namespace pedicel::app {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class Validate : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    const auto path = std::filesystem::path(::testing::TempDir()) / "validate" / name;
    io::write_file_atomically(path, text);
    return path.string();
  }
  int validate(const std::vector<std::string>& files) {
    std::ostringstream out;
    const int code = validate_files(files, {}, out);
    text_ = out.str();
    return code;
  }
  std::string text_;
};

TEST_F(Validate, EveryShippedFileIsGood) {
  std::vector<std::string> files;
  for (const char* folder : {"plants", "assets"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(pedicel::test::source_folder() / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension == ".yaml" || extension == ".urdf") files.push_back(entry.path().string());
    }
  std::sort(files.begin(), files.end());
  ASSERT_FALSE(files.empty());
  EXPECT_EQ(validate(files), 0) << text_;
}

// What the program writes anywhere, with leaves of its own assets, it reads there.
TEST_F(Validate, LeavesOfTheProgramAreFoundFromAnyFolder) {
  const std::string folder = pedicel::test::source_folder();
  const std::string text = io::read_file(folder + "/plants/cherry_tomato.plant.yaml");
  EXPECT_EQ(validate({write("elsewhere/saved.plant.yaml", text)}), 0) << text_;
  EXPECT_EQ(validate({write("elsewhere/saved.scene.yaml",
                            "format: pedicel-scene\nversion: 1\npurpose: a\nsee: b\nduration: 1\n"
                            "plants:\n  - {name: p, file: saved.plant.yaml}\n")}),
            0)
      << text_;
}

TEST_F(Validate, OneBadFileIsEnough) {
  const std::string good =
      pedicel::test::source_folder().string() + "/plants/cherry_tomato.plant.yaml";
  const std::string bad = write("bad.plant.yaml", "format: pedicel-plant\nversion: 1\n");
  EXPECT_EQ(validate({bad, good}), 3);
  EXPECT_THAT(text_, HasSubstr("bad.plant.yaml:1:1: error: missing key"));
  EXPECT_THAT(text_, HasSubstr("cherry_tomato.plant.yaml: plant, good"));
}

// Whatever builds a plant says how far it settles from its drawing.
TEST_F(Validate, SaysHowAPlantStands) {
  const std::string folder = pedicel::test::source_folder();
  EXPECT_EQ(validate({folder + "/plants/cherry_tomato.plant.yaml"}), 0);
  EXPECT_THAT(text_, ContainsRegex("plant, good; settles [0-9.e-]+ mm from its drawing at "
                                   "cherry tomato/[a-z0-9_]+, [0-9.e-]+ mm rms\n"));
  EXPECT_EQ(validate({folder + "/plants/young_plant.plant.yaml"}), 0);  // shape: rest
  EXPECT_THAT(text_, HasSubstr("plant, good\n"));
}

TEST_F(Validate, SaysWhatItKnowsWhereTheKindIsUnknown) {
  EXPECT_EQ(validate({write("a.txt", "hello")}), 3);
  EXPECT_THAT(text_, HasSubstr("a.txt: error: kind of file is unknown, expected one of: "
                               "pedicel-plant, pedicel-experiment, pedicel-scene"));
  EXPECT_EQ(validate({write("b.yaml", "format: pedicel-poem\n")}), 3);
  EXPECT_THAT(text_, HasSubstr("kind of file is unknown"));
}

TEST_F(Validate, SaysWhatCannotBeRead) {
  EXPECT_EQ(validate({"/nowhere/a.scene.yaml"}), 3);
  EXPECT_THAT(text_, HasSubstr("/nowhere/a.scene.yaml"));
  EXPECT_EQ(validate({write("c.yaml", "a: [1\n")}), 3);
  EXPECT_THAT(text_, HasSubstr("not valid YAML"));
}

TEST_F(Validate, ASceneIsBadWhereAFileThatItNamesIs) {
  write("bad.plant.yaml", "format: pedicel-plant\nversion: 1\n");
  const std::string scene = write("s.scene.yaml",
                                  "format: pedicel-scene\nversion: 1\npurpose: p\nsee: s\n"
                                  "duration: 1\nplants: [{name: a, file: bad.plant.yaml}]\n");
  EXPECT_EQ(validate({scene}), 3);
  EXPECT_THAT(text_, HasSubstr("bad.plant.yaml:1:1: error: missing key"));
}

TEST_F(Validate, TellsATableByItsHeader) {
  const auto good = [&](const std::string& text, const std::string& said) {
    EXPECT_EQ(validate({write("t.csv", text)}), 0) << text_;
    EXPECT_THAT(text_, HasSubstr(said));
  };
  good("x,y,z,parentid,vid,edgetype\n0,0,0,,1,<\n0,0,0.1,1,2,<\n0,0,0.2,2,3,<\n",
       "t.csv: notice: 0.2 m tall, 3 nodes");
  EXPECT_THAT(text_, HasSubstr("t.csv: skeleton, good; settles "));
  good(
      "id,parent_id,start_x,start_y,start_z,end_x,end_y,end_z,radius\n1,0,0,0,0,0,0,0.1,0.004\n"
      "2,1,0,0,0.1,0,0,0.2,0.003\n",
      "t.csv: cylinders, good");
  good("time;m1.x;m1.y;m1.z\n0;0,5;1;2\n0,1;;;\n", "t.csv: markers, good; 1 markers, 2 samples");
  good("time,x,y,z\n0,1,2,3\n", "t.csv: path, good; 1 rows");
  good("time,fx,fy,fz\n0,1,2,3\n", "t.csv: force, good; 1 samples");
  good("time,event,what\n1,detached,fruit_1\n", "t.csv: events, good; 1 events");
  good("time_s,joint1,joint2\n0,1,2\n", "t.csv: table over time (trajectory or log), good");
}

TEST_F(Validate, TellsPlantsOfOtherPrograms) {
  EXPECT_EQ(validate({write("t.ply",
                            "ply\nformat ascii 1.0\ncomment radius: 0.004\nelement vertex 2\n"
                            "property float x\nproperty float y\nproperty float z\n"
                            "element edge 1\nproperty int vertex1\nproperty int vertex2\n"
                            "end_header\n0 0 0\n0 0 0.5\n0 1\n")}),
            0)
      << text_;
  EXPECT_THAT(text_, HasSubstr("t.ply: notice: 0.5 m tall, 2 nodes"));
  EXPECT_THAT(text_, HasSubstr("t.ply: skeleton, good"));
  EXPECT_EQ(validate({write("t.xml",
                            "<?xml version=\"1.0\"?>\n<helios><plant_instance ID=\"0\">"
                            "<shoot ID=\"0\"><phytomer><internode>"
                            "<internode_length>0.5</internode_length>"
                            "<internode_radius>0.004</internode_radius>"
                            "</internode></phytomer></shoot></plant_instance></helios>\n")}),
            0)
      << text_;
  EXPECT_THAT(text_, HasSubstr("t.xml: plant structure of Helios, good"));
}

TEST_F(Validate, WhatNothingReadsIsNotGood) {
  EXPECT_EQ(validate({write("t.csv", "apples,pears\n1,2\n")}), 3);
  EXPECT_THAT(text_, HasSubstr("t.csv:1:1: error: nothing reads a table with the columns apples, "
                               "pears, expected a skeleton"));
  EXPECT_EQ(validate({write("t.csv", "\x1F\x8B\x08 gz")}), 3);
  EXPECT_THAT(text_, HasSubstr("t.csv: error: is compressed with gzip"));
  EXPECT_EQ(validate({write("t.csv", "id,parent_id,start_x,start_y,start_z,radius\n")}), 3);
  EXPECT_THAT(text_, HasSubstr("a column is missing (end_x, end_y, end_z)"));
}

TEST_F(Validate, SaysTheHeightAndDoubtsTheUnit) {
  const std::string tree = write("tree.mtg",
                                 "CODE:\tFORM-A\nMTG:\nENTITY-CODE\t\tXX\tYY\tZZ\n/P1\n"
                                 "^/S1\t\t0\t0\t0\n^<S2\t\t0\t0\t0.15\n^<S3\t\t0.02\t0\t0.3\n");
  validate({tree});
  EXPECT_THAT(text_, HasSubstr("is 0.3 mm large and its thinnest stem 4 mm thick"));
  std::ostringstream out;
  EXPECT_EQ(validate_files({tree}, {}, out, 1.0), 0) << out.str();
  EXPECT_THAT(out.str(), HasSubstr("tree.mtg: notice: 0.3 m tall, 3 nodes"));
  validate({write("mm.csv", "x,y,z,parentid,vid,edgetype\n0,0,0,,1,<\n0,0,300,1,2,<\n")});
  EXPECT_THAT(text_, HasSubstr("is 300 m large, expected at most 100 m: are its lengths in mm"));
}

TEST_F(Validate, ReadsScriptsAndMeshes) {
  EXPECT_EQ(validate({write("s.txt", "# a script\nnew\nstep 3\n")}), 0) << text_;
  EXPECT_THAT(text_, HasSubstr("s.txt: script, good; 2 commands"));
  EXPECT_EQ(validate({write("s.txt", "new\nfly away\n")}), 3);
  EXPECT_THAT(text_, HasSubstr("s.txt:2:1: error: unknown command"));
  EXPECT_EQ(validate({write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")}), 0) << text_;
  EXPECT_THAT(text_, HasSubstr("m.obj: mesh, good; 1 triangles"));
}

TEST_F(Validate, ChecksRobotsAndTables) {
  EXPECT_EQ(validate({write("a.urdf", "<robot name=\"a\"/>")}), 3);
  EXPECT_THAT(text_, HasSubstr("a.urdf"));
  EXPECT_EQ(validate({write("b.URDF", "<robot name=\"b\"><link name=\"l\"/></robot>")}), 0)
      << text_;
  EXPECT_EQ(validate({write("a.csv", "time,x\n0,1\n0,2\n")}), 3);
  EXPECT_THAT(text_, HasSubstr("a.csv:3:1: error: time 0 does not increase"));
}

}  // namespace
}  // namespace pedicel::app
