#include "plugins/discrepancy/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <regex>

#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "plugins/discrepancy/report/plant_sketch.h"
#include "plugins/discrepancy/report/report_words.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/discrepancy/made_diagnosis.h"

namespace pedicel::discrepancy {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr Outcome outcomes[] = {Outcome::adequate, Outcome::named, Outcome::ambiguous,
                                Outcome::unknown, Outcome::bad_data};

std::string page_of(Outcome outcome) {
  const Diagnosis d = made_diagnosis(outcome);
  return report_text(d.admission.experiment, d);
}

/// Every part stands in the page, in this order.
void expect_in_order(const std::string& page, const std::vector<std::string>& parts) {
  std::size_t last = 0;
  for (const std::string& part : parts) {
    const std::size_t at = page.find(part, last);
    ASSERT_NE(at, std::string::npos) << part;
    last = at;
  }
}

TEST(Report, CardComesFirstAndSaysAllThatMatters) {
  expect_in_order(page_of(Outcome::named), {"<section class=\"card\">",
                                            "class=\"note\"",
                                            "base_compliance",
                                            "What is seen",
                                            "turned about its root by 1.0",
                                            "What it is, where, and how large",
                                            "the root",
                                            "0.81 N m/rad (95 %: 0.77 to 0.86)",
                                            "What it gains",
                                            "held-out trials (push)",
                                            "1.03 times with the extended one",
                                            "What else it could have been",
                                            "weak_segment",
                                            "runs to the end of its range (factor)",
                                            "explains none of it",
                                            "not fitted to the end",
                                            "fell far behind on its way",
                                            "What could still hide",
                                            "mass below 0.004 kg",
                                            "stiffness above 900 N/m",
                                            "cannot see at any size: gust",
                                            "What to do next",
                                            "extended.plant.yaml",
                                            "</section>"});
}

TEST(Report, AllElseFollows) {
  expect_in_order(
      page_of(Outcome::named),
      {"</section>", "<h2>Measured against simulated</h2>", "release: m", "weights: m",
       "<h2>The residual over markers and time</h2>", "<h2>Symptoms before and after</h2>",
       "shows, is gone", "<h2>All candidates, refitted in full</h2>", "<h2>What it gains</h2>",
       "<h2>The data</h2>", "m3 &lt;at the top&gt;", "<h2>Noise and numerics</h2>", "0.3 mm",
       "<h2>Parameters</h2>", "youngs_modulus", "density", "cannot see it",
       "<h2>What was done</h2>", "Largest directed statistic 52"});
}

TEST(Report, EachOutcomeHasItsOwnCard) {
  const std::string ambiguous = page_of(Outcome::ambiguous);
  EXPECT_THAT(ambiguous, HasSubstr("What it could be"));
  EXPECT_THAT(ambiguous, HasSubstr("above 0.05, no upper end"));
  EXPECT_THAT(ambiguous, HasSubstr("Pull stem at 0.8 along x by 40 mm and let go."));
  EXPECT_THAT(ambiguous, HasSubstr("What each explanation predicts for it: m3.x"));
  EXPECT_THAT(page_of(Outcome::unknown), HasSubstr(">largest residual<"));
  EXPECT_THAT(page_of(Outcome::unknown),
              HasSubstr("What is known of it: 31 % of what the refitted model left."));
  const char* anything = "Behind what is missing anything may hide.";
  EXPECT_THAT(page_of(Outcome::unknown), HasSubstr(anything));
  EXPECT_THAT(page_of(Outcome::named), Not(HasSubstr(anything)));
  const std::string adequate = page_of(Outcome::adequate);
  EXPECT_THAT(adequate, HasSubstr("Nothing is missing at this noise"));
  EXPECT_THAT(adequate, Not(HasSubstr("extended model")));
  const std::string bad = page_of(Outcome::bad_data);
  EXPECT_THAT(bad, HasSubstr("trial &quot;weights&quot; has no data"));
  EXPECT_THAT(bad, Not(HasSubstr("<svg")));
}

// The place of a force is shown, and where else it may act; a name that was taken back gains
// nothing.
TEST(Report, ForceOfUnknownKindHasItsPlaceInTheDrawing) {
  Diagnosis d = made_diagnosis(Outcome::unknown);
  d.force.found = true;
  d.force.place = plant::CurvePlace{"stem", 0.6, {}};
  d.force.place_error = 0.1;
  d.force.elsewhere = {plant::CurvePlace{"stem", 0.2, {}}};
  d.verdict.gain = -4.6;
  d.exchanged = "push";
  const std::string page = report_text(d.admission.experiment, d);
  EXPECT_THAT(page, HasSubstr(">a force acts here<"));
  EXPECT_THAT(page, HasSubstr(">or here<"));
  EXPECT_THAT(page, Not(HasSubstr(">largest residual<")));
  EXPECT_THAT(page, Not(HasSubstr("That removes")));
  EXPECT_THAT(page, HasSubstr("<h3>What is left</h3>"));
  EXPECT_THAT(page, HasSubstr("&quot;push&quot;, which was to be held out"));
}

TEST(Report, LimitsOfFactorsAreToldByHowFarTheyAreFromOne) {
  Verdict verdict;
  verdict.detectable_limits = {{"marker_scale", "factor", 1.00002, "1"},
                               {"weak_segment", "factor", 0.91632, "1"},
                               {"extra_mass", "mass", 0.004, "kg"}};
  EXPECT_THAT(detectable_limit_texts(verdict).first,
              ::testing::ElementsAre("marker_scale: factor off 1 by less than 2e-05",
                                     "weak_segment: factor off 1 by less than 0.0837",
                                     "extra_mass: mass below 0.004 kg"));
}

TEST(Report, HowMuchTheCausesExplainIsToldOfHeldOutTrials) {
  Verdict verdict;
  verdict.outcome = Outcome::named;
  EXPECT_EQ(explained_text(verdict), "") << "there is nothing to explain";
  verdict.left.share.fit = 0.002;
  EXPECT_EQ(explained_text(verdict),
            "What is named explains all of the misfit that the refitted model leaves above the "
            "noise, on the fitted trials.");
  verdict.left.share.check = 0.17;
  EXPECT_THAT(explained_text(verdict), HasSubstr("explains 83 % of"));
  EXPECT_THAT(explained_text(verdict), HasSubstr("on the held-out trials."));
  verdict.left.share.check = 1.0;
  EXPECT_EQ(explained_text(verdict), "") << "the refitted model itself is told";
}

/// The open element that a closing one does not match, or what is left open; empty where all nest.
/// By hand: std::regex recurses once for each character of a tag, and drawings have long ones.
std::string wrong_nesting(const std::string& page) {
  std::vector<std::string> open;
  for (std::size_t at = page.find('<', page.find("<body>")); at != std::string::npos;
       at = page.find('<', at)) {
    const bool closes = page[++at] == '/';
    if (closes) ++at;
    const std::size_t start = at;
    while (at < page.size() && std::isalnum(static_cast<unsigned char>(page[at]))) ++at;
    const std::string name = page.substr(start, at - start);
    bool quoted = false;
    for (; at < page.size() && (quoted || page[at] != '>'); ++at)
      if (page[at] == '"') quoted = !quoted;
    if (at >= page.size()) return "<" + name;
    if (name.empty() || name == "br" || name == "img" || page[at - 1] == '/') continue;
    if (!closes) {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return "</" + name + ">";
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back();
}

TEST(Report, ElementsNest) {
  EXPECT_EQ(wrong_nesting("<body><p>a</b></p></body>"), "</b>") << "the check itself";
  EXPECT_EQ(wrong_nesting("<body><p title=\"a > b\">a<br></p>"), "body") << "the check itself";
  for (const Outcome outcome : outcomes) {
    std::string page = page_of(outcome);
    page.erase(page.rfind("</html>"));
    EXPECT_EQ(wrong_nesting(page), "") << to_string(outcome);
  }
}

TEST(Report, NothingComesFromElsewhereAndNothingIsNaN) {
  for (const Outcome outcome : outcomes) {
    std::string page = page_of(outcome);
    page = std::regex_replace(page, std::regex("xmlns=\"http://www.w3.org/2000/svg\""), "");
    for (const char* word : {"http", "<script", "<link", "@import", "url(", "src="})
      EXPECT_THAT(page, Not(HasSubstr(word))) << word << " " << to_string(outcome);
    for (const char* word : {"nan", "inf<", "-inf"})
      EXPECT_THAT(std::regex_replace(page, std::regex("resonance|finance"), ""),
                  Not(HasSubstr(word)))
          << word << " " << to_string(outcome);
  }
}

TEST(Report, IsWrittenIntoItsFolder) {
  TemporaryFolder folder;
  const Diagnosis d = made_diagnosis();
  write_report(folder / "out", d.admission.experiment, d);
  EXPECT_EQ(io::read_file(folder / "out/report.html"), report_text(d.admission.experiment, d));
}

/// Boxes of the texts of a drawing, by the canvas's own estimate of their widths.
struct Box {
  double left, top, right, bottom;
};
std::vector<Box> texts_of(const std::string& svg) {
  std::vector<Box> boxes;
  const std::regex text("<text x=\"([-0-9.]+)\" y=\"([-0-9.]+)\"[^>]*>([^<]*)</text>");
  for (auto it = std::sregex_iterator(svg.begin(), svg.end(), text); it != std::sregex_iterator();
       ++it) {
    const double x = std::stod((*it)[1]), y = std::stod((*it)[2]);
    boxes.push_back({x, y - 10, x + 0.58 * 12 * static_cast<double>((*it)[3].length()), y + 2});
  }
  return boxes;
}

TEST(PlantSketch, TextsStayInsideAndApart) {
  MadeData made;
  // Many markers close to each other: names that find no room are left out.
  for (int i = 0; i < 20; ++i)
    made.experiment.markers.push_back({"marker" + std::to_string(i), {"stem", 0.4 + 0.01 * i, {}}});
  NamedCause cause;
  cause.name = "weak_segment";
  cause.where = plant::CurvePlace{"stem", 0.5, {}};
  cause.parameters["length"] = {{0.06, 0.05, 0.07, "m"}};
  const std::string svg =
      plant_sketch(made.experiment, {mark_of(made.experiment, cause, "#d1495b")});
  EXPECT_THAT(svg, HasSubstr(">weak_segment<"));
  EXPECT_THAT(svg, HasSubstr(">m4<"));
  const std::vector<Box> boxes = texts_of(svg);
  EXPECT_GT(boxes.size(), 8u);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_GE(boxes[i].left, 0.0);
    EXPECT_LE(boxes[i].right, 400.0);
    EXPECT_GE(boxes[i].top, 0.0);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(boxes[i].left < boxes[j].right && boxes[j].left < boxes[i].right &&
                   boxes[i].top < boxes[j].bottom && boxes[j].top < boxes[i].bottom)
          << i << " " << j;
  }
}

TEST(PlantSketch, MarksStandWhereTheCauseIs) {
  const MadeData made;
  const auto of = [&](const std::string& name) {
    NamedCause cause;
    cause.name = name;
    return cause;
  };
  EXPECT_EQ(mark_of(made.experiment, of("base_compliance"), "#000").places.at(0).at, 0.0);
  EXPECT_EQ(mark_of(made.experiment, of("grip_slip"), "#000").places.at(0).curve, "stem");
  EXPECT_TRUE(mark_of(made.experiment, of("leaf_drag"), "#000").whole_plant);
  EXPECT_TRUE(mark_of(made.experiment, of("latency"), "#000").markers);
  NamedCause offset = of("marker_offset");
  offset.words["marker"] = "m6";
  EXPECT_EQ(mark_of(made.experiment, offset, "#000").places.at(0).curve, "branch");
  NamedCause wind = of("wind");
  wind.parameters["velocity"] = {{0, 0, 0, "m/s"}, {-2, 0, 0, "m/s"}, {0, 0, 0, "m/s"}};
  const SketchMark mark = mark_of(made.experiment, wind, "#000");
  ASSERT_TRUE(mark.direction);
  EXPECT_NEAR(std::abs(mark.direction->y()), 1.0, 1e-12);
}

}  // namespace
}  // namespace pedicel::discrepancy
