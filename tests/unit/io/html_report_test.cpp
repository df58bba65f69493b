#include "engine/io/html_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "engine/io/markup.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::io {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

TEST(Markup, EscapesWhatHtmlWouldRead) {
  EXPECT_EQ(escape_markup("<a href=\"x\">&'</a>\x01\t"),
            "&lt;a href=&quot;x&quot;&gt;&amp;&#39;&lt;/a&gt;\t");
}

// The test vectors of RFC 4648, section 10.
TEST(Markup, Base64) {
  const auto of = [](const std::string& text) {
    return base64(std::vector<std::uint8_t>(text.begin(), text.end()));
  };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(of("\xff\xfe\xfd"), "//79");
}

TEST(HtmlReport, ShowsItsPartsInOrder) {
  HtmlReport report("Run", "seed 1");
  report.heading("First");
  report.paragraph("words");
  report.key_values({{"solver", "direct"}});
  report.plot("<svg></svg>");
  report.pictures({{{'f', 'o', 'o'}, "before"}, {{'f'}, "after"}});
  report.video("out/run 1%.mp4", "all");
  const std::string page = report.text();
  std::size_t last = 0;
  for (const char* part :
       {"<title>Run</title>", "seed 1", "<h2>First</h2>", "<p>words</p>",
        "<dt>solver</dt><dd>direct</dd>", "<svg></svg>", "data:image/png;base64,Zm9v", "before",
        "after", "src=\"out/run%201%25.mp4\"", "out/run 1%.mp4</a>", "</html>"}) {
    const std::size_t at = page.find(part, last);
    ASSERT_NE(at, std::string::npos) << part;
    last = at;
  }
}

TEST(HtmlReport, CardFramesWhatIsAddedInBetween) {
  HtmlReport report("Run");
  report.begin_card();
  report.subheading("Where");
  report.list({"first", "second"});
  report.plots({"<svg>1</svg>", "<svg>2</svg>"});
  report.end_card();
  report.paragraph("behind");
  const std::string page = report.text();
  std::size_t last = 0;
  for (const char* part :
       {"<section class=\"card\">", "<h3>Where</h3>", "<li>first</li>", "<li>second</li>",
        "<div class=\"row\">", "<svg>1</svg>", "<svg>2</svg>", "</section>", "<p>behind</p>"}) {
    const std::size_t at = page.find(part, last);
    ASSERT_NE(at, std::string::npos) << part;
    last = at;
  }
}

TEST(HtmlReport, NumbersStandRight) {
  HtmlReport report("Run");
  report.table({"cause", "time (s)"}, {{"stretch", "1.20"}, {"none", "nan"}});
  const std::string page = report.text();
  EXPECT_THAT(page, HasSubstr("<th>cause</th><th class=\"number\">time (s)</th>"));
  EXPECT_THAT(page, HasSubstr("<td>stretch</td><td class=\"number\">1.20</td>"));
}

TEST(HtmlReport, EscapesEveryText) {
  const std::string evil = "<script>alert('x')</script>";
  HtmlReport report(evil, evil);
  report.heading(evil);
  report.paragraph(evil);
  report.subheading(evil);
  report.list({evil});
  report.note(evil, true);
  report.note(evil, false);
  report.key_values({{evil, evil}});
  report.table({evil}, {{evil}});
  report.pictures({{{}, evil}});
  report.video(evil, evil);
  EXPECT_THAT(report.text(), Not(HasSubstr("<script")));
}

TEST(HtmlReport, NeedsNoNetwork) {
  HtmlReport report("Run");
  report.pictures({{{1, 2, 3}, "picture"}});
  for (const char* word : {"http://", "https://", "<script", "<link", "@import", "url("})
    EXPECT_THAT(report.text(), Not(HasSubstr(word))) << word;
}

TEST(HtmlReport, RefusesRaggedTables) {
  HtmlReport report("Run");
  EXPECT_THAT(
      [&] {
        report.table({"a", "b"}, {{"1"}});
      },
      ThrowsMessage<UsageError>(HasSubstr("row of 1 cells: must have 2 as the header")));
}

TEST(HtmlReport, WritesThePage) {
  TemporaryFolder folder;
  HtmlReport report("Run");
  report.write(folder / "out/report.html");
  EXPECT_EQ(read_file(folder / "out/report.html"), report.text());
}

}  // namespace
}  // namespace pedicel::io
