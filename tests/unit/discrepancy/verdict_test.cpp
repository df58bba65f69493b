// verdict.json against the manual's page Verdict: its fields, null where there is no value, and the
// exit codes.
#include "plugins/discrepancy/select/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace pedicel::discrepancy {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = nlohmann::ordered_json;

Verdict full() {
  Verdict v;
  v.outcome = Outcome::ambiguous;
  NamedCause spring;
  spring.name = "base_compliance";
  spring.parameters["stiffness"] = {{0.81, 0.77, INFINITY, "N m/rad"}};
  spring.where = plant::CurvePlace{"stem", 0.0, {}};
  spring.because = "It turns about its root.";
  spring.evidence = 143.2;
  spring.share = {0.93, {}};
  spring.change = {0.004, 0.2};
  NamedCause offset;
  offset.name = "marker_offset";
  offset.parameters["offset"] = {
      {0.001, 0.0, 0.002, "m"}, {0.0, -0.001, 0.001, "m"}, {0.003, 0.002, NAN, "m"}};
  offset.words["marker"] = "m2";
  v.causes = {spring, offset};
  v.competing = {{"weak_segment", 88.1}};
  v.parameters["youngs_modulus"] = {3.1e8, 3.0e8, 3.2e8, "Pa"};
  v.ratios["youngs_modulus/density"] = {1.02, 1.0, 1.04, "1"};
  v.fit = {4.1, 2.2, 1.03};
  v.check = {4.4, 2.6, 1.08};
  v.gain = 0.96;
  v.left = {{0.02, {}}, {1.03, 1.08}, {{"force", 1.2, {}}}, {"time_shift"}};
  v.detectable_limits = {{"extra_mass", "mass", 0.004, "kg"}, {"gust", "", INFINITY, "1"}};
  v.next_experiment = "Pull \"stem\".";
  v.extended_plant = "extended.plant.yaml";
  v.simulations = 412;
  v.seconds = 38.5;
  return v;
}

std::vector<std::string> keys(const Json& json) {
  std::vector<std::string> names;
  for (const auto& [key, value] : json.items()) names.push_back(key);
  return names;
}

TEST(Verdict, HasTheFieldsOfTheFormat) {
  const Json json = Json::parse(to_json(full()));
  EXPECT_THAT(keys(json), ElementsAre("format", "version", "verdict", "causes", "details",
                                      "nearest", "competing", "parameters", "ratios", "error",
                                      "gain", "gain_over_nominal", "remainder", "left",
                                      "detectable_limits", "next_experiment", "extended_plant",
                                      "next", "simulations", "seconds", "rivals", "could_hide"));
  EXPECT_EQ(json["format"], "pedicel-verdict");
  EXPECT_EQ(json["version"], 2);
  EXPECT_EQ(json["verdict"], "ambiguous");
  const Json& cause = json["causes"][0];
  EXPECT_EQ(cause["name"], "base_compliance");
  EXPECT_EQ(cause["parameters"]["stiffness"]["value"], 0.81);
  EXPECT_EQ(cause["parameters"]["stiffness"]["low"], 0.77);
  EXPECT_EQ(cause["parameters"]["stiffness"]["unit"], "N m/rad");
  EXPECT_EQ(cause["where"], Json({{"curve", "stem"}, {"at", 0.0}}));
  EXPECT_EQ(cause["because"], "It turns about its root.");
  EXPECT_EQ(cause["evidence"], 143.2);
  EXPECT_EQ(cause["share"], Json::parse(R"({"fit": 0.93, "check": null})"));
  EXPECT_EQ(cause["change"], Json::parse(R"({"marker": {"value": 0.004, "unit": "m"},
                                             "force": {"value": 0.2, "unit": "N"}})"));
  EXPECT_EQ(json["ratios"]["youngs_modulus/density"]["value"], 1.02);
  EXPECT_EQ(json["competing"], Json::parse(R"([{"name": "weak_segment", "behind": 88.1}])"));
  EXPECT_EQ(json["parameters"]["youngs_modulus"]["high"], 3.2e8);
  EXPECT_EQ(json["error"]["fit"],
            Json::parse(R"({"nominal": 4.1, "refitted": 2.2, "extended": 1.03})"));
  EXPECT_EQ(json["error"]["check"]["extended"], 1.08);
  EXPECT_EQ(json["error"]["unit"], "rms residual over the noise floor");
  EXPECT_EQ(json["gain"], 0.96);
  EXPECT_EQ(json["remainder"], "");
  EXPECT_EQ(json["left"], Json::parse(R"({"share": {"fit": 0.02, "check": null},
      "times_noise": {"fit": 1.03, "check": 1.08},
      "channels": [{"name": "force", "times_noise": 1.2, "share": null}],
      "symptoms": ["time_shift"]})"));
  EXPECT_EQ(json["detectable_limits"][0]["smallest_seen"], 0.004);
  EXPECT_EQ(json["detectable_limits"][0]["unit"], "kg");
  EXPECT_EQ(json["next_experiment"], "Pull \"stem\".");
  EXPECT_EQ(json["extended_plant"], "extended.plant.yaml");
  EXPECT_EQ(json["simulations"], 412);
  EXPECT_EQ(json["seconds"], 38.5);
}

TEST(Verdict, HasItsOldKeysForOneRelease) {
  const Json json = Json::parse(to_json(full()));
  EXPECT_EQ(json["rivals"], json["competing"]);
  EXPECT_EQ(json["could_hide"], json["detectable_limits"]);
}

TEST(Verdict, PutsComponentsIntoLists) {
  const Json offset = Json::parse(to_json(full()))["causes"][1];
  EXPECT_EQ(offset["parameters"]["offset"]["value"], Json({0.001, 0.0, 0.003}));
  EXPECT_EQ(offset["parameters"]["offset"]["high"], Json({0.002, 0.001, nullptr}));
  EXPECT_EQ(offset["parameters"]["offset"]["unit"], "m");
  EXPECT_EQ(offset["marker"], "m2");
}

TEST(Verdict, IsNullWhereThereIsNoValue) {
  const Json json = Json::parse(to_json(full()));
  EXPECT_TRUE(json["causes"][0]["parameters"]["stiffness"]["high"].is_null());
  EXPECT_EQ(json["causes"][1]["where"], Json({{"marker", "m2"}}));  // it has no place on a curve
  EXPECT_TRUE(json["detectable_limits"][1]["smallest_seen"].is_null());
  const Json bare = Json::parse(to_json(Verdict{}));
  EXPECT_EQ(keys(bare), keys(json));
  for (const char* model : {"nominal", "refitted", "extended"}) {
    EXPECT_TRUE(bare["error"]["fit"][model].is_null()) << model;
    EXPECT_TRUE(bare["error"]["check"][model].is_null()) << model;
  }
  EXPECT_TRUE(bare["gain"].is_null());
  EXPECT_TRUE(bare["extended_plant"].is_null());
  EXPECT_EQ(bare["causes"], Json::array());
  EXPECT_EQ(bare["parameters"], Json::object());
}

TEST(Verdict, HasAnExitCodeForEveryOutcome) {
  EXPECT_EQ(exit_code(Outcome::adequate), 0);
  EXPECT_EQ(exit_code(Outcome::named), 10);
  EXPECT_EQ(exit_code(Outcome::ambiguous), 11);
  EXPECT_EQ(exit_code(Outcome::unknown), 12);
  EXPECT_EQ(exit_code(Outcome::bad_data), 13);
  EXPECT_EQ(exit_code(Outcome::numerical), 14);
  EXPECT_EQ(to_string(Outcome::bad_data), "bad_data");
}

TEST(Headline, BeginsWithARefitThatMisleads) {
  Verdict v = full();
  v.check = {1.4, 2.6, 1.3};
  v.refit_misleads = true;
  const std::string first =
      "Refitted to some trials the model is worse in the held-out ones than as the file says (2.6 "
      "times the noise in place of 1.4). ";
  EXPECT_TRUE(headline(v).starts_with(first + "Something is missing")) << headline(v);
  v.partial = true;
  EXPECT_TRUE(headline(v).starts_with("Cut short, so this is what is known: " + first));
}

TEST(Headline, SaysHowSureItIs) {
  Verdict v = full();
  EXPECT_THAT(headline(v), HasSubstr("cannot tell which: a root that turns elastically "
                                     "(base_compliance) or a marker that sits elsewhere"));
  v.outcome = Outcome::named;
  EXPECT_THAT(headline(v), HasSubstr("A root that turns elastically (base_compliance): this "
                                     "explains 93 % of the misfit"));
  EXPECT_THAT(headline(v), HasSubstr("Beside it a marker that sits elsewhere"));
  EXPECT_THAT(headline(v), HasSubstr("it removes 96 % of the error above the noise"));
  v.gain = 1.12;  // the noise of these trials happened to be quiet
  EXPECT_THAT(headline(v), HasSubstr("it removes all of the error above the noise"));
  v.causes[0].share = {};  // the nominal model leaves no more than noise
  EXPECT_THAT(headline(v), HasSubstr("The data show a root that turns elastically "
                                     "(base_compliance) and a marker"));
  v.partial = true;
  EXPECT_THAT(headline(v), HasSubstr("Cut short"));
  v.partial = false;
  v.outcome = Outcome::unknown;
  EXPECT_THAT(headline(v), HasSubstr("Do not extrapolate."));
}

// A swing sees modulus over density. The value of either alone would claim more than the data hold.
TEST(Headline, TellsOfAParameterSeenInARatioHowFarItMayBe) {
  Verdict v = full();
  v.outcome = Outcome::named;
  v.ratios.clear();
  v.causes.resize(1);
  v.causes[0] = {};
  v.causes[0].name = "youngs_modulus";
  v.causes[0].share.fit = 0.98;
  v.causes[0].parameters["factor"] = {{1.44, 1.32, 1.57, "1"}};
  EXPECT_THAT(headline(v), StartsWith("The plant is 44 % stiffer than the file says "
                                      "(youngs_modulus): this explains 98 % of the misfit"));
  v.ratios["density/damping_time"] = {0.9, 0.89, 0.91, "1"};
  EXPECT_THAT(headline(v), HasSubstr("(youngs_modulus): ")) << "a ratio of others";
  v.ratios["youngs_modulus/density"] = {1.402, 1.397, 1.406, "1"};
  EXPECT_THAT(headline(v),
              StartsWith("The plant is 32 to 57 % stiffer than the file says (youngs_modulus; seen "
                         "closely is youngs_modulus/density, 1.4 times the file's): this"));
  v.causes[0].parameters["factor"] = {{0.72, 0.65, 0.8, "1"}};
  EXPECT_THAT(headline(v), StartsWith("The plant is 20 to 35 % softer"));
  v.causes[0].parameters["factor"] = {{3.0, 2.5, 3.6, "1"}};
  EXPECT_THAT(headline(v), StartsWith("The plant is 2.5 to 3.6 times as much stiffer"));
  v.causes[0].parameters["factor"] = {{1.1, 0.9, 1.3, "1"}};
  EXPECT_THAT(headline(v), StartsWith("The plant is 10 % stiffer")) << "it may be either";
}

}  // namespace
}  // namespace pedicel::discrepancy
