#include "engine/io/html_report.h"

#include <charconv>

#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "engine/io/markup.h"

namespace pedicel::io {

namespace {

constexpr std::string_view style = R"(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0; background: #f6f7f8; color: #1f2328;
  font: 16px/1.55 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
main { max-width: 960px; margin: 0 auto; padding: 36px 40px 60px; background: #fff;
  min-height: 100vh; }
h1 { font-size: 30px; line-height: 1.2; margin: 0 0 4px; letter-spacing: -0.01em; }
h2 { font-size: 20px; margin: 38px 0 10px; padding-top: 14px; border-top: 1px solid #e3e6ea; }
h3 { font-size: 15.5px; margin: 20px 0 4px; color: #3d444d; }
p { margin: 10px 0; max-width: 44em; }
ul { margin: 8px 0; padding-left: 20px; max-width: 44em; }
li { margin: 3px 0; }
.card { border: 1px solid #c9ced4; border-radius: 10px; padding: 6px 24px 16px; margin: 18px 0;
  box-shadow: 0 1px 4px rgba(0, 0, 0, 0.06); }
.subtitle { color: #57606a; margin-top: 0; }
.note { padding: 12px 16px; border-left: 4px solid #2e8b57; background: #eef7f1;
  border-radius: 0 6px 6px 0; max-width: none; }
.note.bad { border-color: #d1495b; background: #fcf0f1; }
.table { overflow-x: auto; margin: 14px 0; }
table { border-collapse: collapse; font-size: 14.5px; font-variant-numeric: tabular-nums; }
th, td { padding: 6px 20px 6px 0; text-align: left; border-bottom: 1px solid #e3e6ea;
  vertical-align: top; }
th { font-weight: 600; color: #3d444d; border-bottom: 2px solid #c9ced4; }
td.number, th.number { text-align: right; padding-left: 8px; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 4px 24px; margin: 14px 0;
  font-size: 15px; }
dt { color: #57606a; }
dd { margin: 0; font-variant-numeric: tabular-nums; overflow-wrap: anywhere; }
figure { margin: 16px 0; }
figure img, figure video { display: block; width: 100%; border-radius: 8px;
  border: 1px solid #e3e6ea; }
figure svg { display: block; max-width: 100%; height: auto; }
figcaption { color: #57606a; font-size: 14px; margin-top: 6px; }
.row { display: grid; gap: 16px; grid-template-columns: repeat(auto-fit, minmax(260px, 1fr)); }
.row figure { margin: 0; min-width: 0; }
a { color: #1b6ca8; }
@media (max-width: 700px) { main { padding: 24px 16px; } }
@media print { body { background: #fff; } figure { break-inside: avoid; } }
)";

bool is_number(const std::string& cell) {
  if (cell.empty() || cell == "nan" || cell == "-" || cell == "\u2013") return true;
  double value = 0.0;
  const char* first = cell.data() + (cell.front() == '+' ? 1 : 0);
  const char* last = cell.data() + cell.size();
  const auto [end, error] = std::from_chars(first, last, value);
  return error == std::errc{} && end == last;
}

/// Percent encoding of a relative address, slashes kept.
std::string address(const std::string& relative) {
  constexpr std::string_view plain = "-_.~/";
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string out;
  for (const char c : relative) {
    const auto byte = static_cast<unsigned char>(c);
    const bool letter = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (letter || plain.find(c) != std::string_view::npos)
      out += c;
    else
      (out += '%') += {digits[byte >> 4], digits[byte & 15]};
  }
  return out;
}

std::string figure(const std::string& inside, const std::string& caption) {
  return "<figure>" + inside +
         (caption.empty() ? "" : "<figcaption>" + escape_markup(caption) + "</figcaption>") +
         "</figure>\n";
}

}  // namespace

HtmlReport::HtmlReport(std::string title, std::string subtitle)
    : title_(std::move(title)), subtitle_(std::move(subtitle)) {}

void HtmlReport::heading(const std::string& text) {
  body_ += "<h2>" + escape_markup(text) + "</h2>\n";
}

void HtmlReport::subheading(const std::string& text) {
  body_ += "<h3>" + escape_markup(text) + "</h3>\n";
}

void HtmlReport::list(const std::vector<std::string>& texts) {
  body_ += "<ul>\n";
  for (const std::string& text : texts) body_ += "<li>" + escape_markup(text) + "</li>\n";
  body_ += "</ul>\n";
}

void HtmlReport::paragraph(const std::string& text) {
  body_ += "<p>" + escape_markup(text) + "</p>\n";
}

void HtmlReport::note(const std::string& text, bool good) {
  body_ += std::string("<p class=\"note") + (good ? "" : " bad") + "\">" + escape_markup(text) +
           "</p>\n";
}

void HtmlReport::key_values(const std::vector<std::pair<std::string, std::string>>& pairs) {
  body_ += "<dl>\n";
  for (const auto& [key, value] : pairs)
    body_ += "<dt>" + escape_markup(key) + "</dt><dd>" + escape_markup(value) + "</dd>\n";
  body_ += "</dl>\n";
}

void HtmlReport::table(const std::vector<std::string>& header,
                       const std::vector<std::vector<std::string>>& rows) {
  std::vector<bool> numeric(header.size(), !rows.empty());
  for (const auto& row : rows) {
    if (row.size() != header.size())
      throw UsageError("table row of " + std::to_string(row.size()) + " cells: must have " +
                       std::to_string(header.size()) + " as the header");
    for (std::size_t i = 0; i < row.size(); ++i) numeric[i] = numeric[i] && is_number(row[i]);
  }
  const auto cells = [&](const std::vector<std::string>& texts, const std::string& tag) {
    std::string line = "<tr>";
    for (std::size_t i = 0; i < texts.size(); ++i)
      line += "<" + tag + (numeric[i] ? " class=\"number\"" : "") + ">" + escape_markup(texts[i]) +
              "</" + tag + ">";
    return line + "</tr>\n";
  };
  body_ += "<div class=\"table\"><table>\n<thead>" + cells(header, "th") + "</thead>\n<tbody>\n";
  for (const auto& row : rows) body_ += cells(row, "td");
  body_ += "</tbody></table></div>\n";
}

void HtmlReport::pictures(const std::vector<ReportPicture>& pictures) {
  if (pictures.size() > 1) body_ += "<div class=\"row\">\n";
  for (const ReportPicture& picture : pictures)
    body_ += figure("<img alt=\"" + escape_markup(picture.caption) +
                        "\" src=\"data:image/png;base64," + base64(picture.png) + "\">",
                    picture.caption);
  if (pictures.size() > 1) body_ += "</div>\n";
}

void HtmlReport::video(const std::string& relative, const std::string& caption) {
  const std::string where = address(relative);
  body_ += "<figure><video controls preload=\"metadata\" src=\"" + where +
           "\"></video><figcaption>" + escape_markup(caption) + (caption.empty() ? "" : " ") +
           "<a href=\"" + where + "\">" + escape_markup(relative) + "</a></figcaption></figure>\n";
}

void HtmlReport::moving_scene(std::string_view glb, std::string_view viewer,
                              const std::string& caption) {
  if (!has_viewer_) {
    // A script ends at its first closing tag, also where that stands in a text of it.
    std::string script(viewer);
    for (std::size_t at = script.find("</script"); at != std::string::npos;
         at = script.find("</script", at))
      script.replace(at, 2, "<\\/");
    body_ += "<script>" + script + "</script>\n";
  }
  has_viewer_ = true;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(glb.data());
  body_ += figure(
      "<model-viewer style=\"width:100%;height:480px\" autoplay camera-controls "
      "shadow-intensity=\"0.6\" src=\"data:model/gltf-binary;base64," +
          base64({bytes, bytes + glb.size()}) + "\"></model-viewer>",
      caption);
}

void HtmlReport::plot(const std::string& svg) {
  body_ += figure(svg, "");
}

void HtmlReport::plots(const std::vector<std::string>& svgs) {
  body_ += "<div class=\"row\">\n";
  for (const std::string& svg : svgs) body_ += figure(svg, "");
  body_ += "</div>\n";
}

void HtmlReport::begin_card() {
  PEDICEL_ASSERT(!in_card_);
  in_card_ = true;
  body_ += "<section class=\"card\">\n";
}

void HtmlReport::end_card() {
  PEDICEL_ASSERT(in_card_);
  in_card_ = false;
  body_ += "</section>\n";
}

std::string HtmlReport::text() const {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         escape_markup(title_) + "</title>\n<style>" + std::string(style) +
         "</style>\n</head>\n<body>\n<main>\n<h1>" + escape_markup(title_) + "</h1>\n" +
         (subtitle_.empty() ? "" : "<p class=\"subtitle\">" + escape_markup(subtitle_) + "</p>\n") +
         body_ + "</main>\n</body>\n</html>\n";
}

void HtmlReport::write(const std::filesystem::path& path) const {
  write_file_atomically(path, text());
}

}  // namespace pedicel::io
