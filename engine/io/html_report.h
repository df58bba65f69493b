#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pedicel::io {

/// A picture of a page with its caption.
struct ReportPicture {
  std::vector<std::uint8_t> png;  ///< the bytes of a PNG file
  std::string caption;
};

/// A page that opens by itself: one HTML file with its style, plots (SVG) and pictures inside and
/// nothing fetched from anywhere. Only a video stays a file of its own beside the page. All texts
/// are shown as they are (escaped). Parts appear in the order in which they are added.
class HtmlReport {
 public:
  explicit HtmlReport(std::string title, std::string subtitle = "");

  void heading(const std::string& text);
  /// Of a part of what a heading() begins.
  void subheading(const std::string& text);
  void paragraph(const std::string& text);
  /// One bullet a text.
  void list(const std::vector<std::string>& texts);
  /// A paragraph that stands out: the result, or what went wrong.
  void note(const std::string& text, bool good);
  void key_values(const std::vector<std::pair<std::string, std::string>>& pairs);
  /// Cells that are numbers are set to the right. Throws UsageError for a row of another length
  /// than the header.
  void table(const std::vector<std::string>& header,
             const std::vector<std::vector<std::string>>& rows);
  /// One picture over the whole width, or several side by side.
  void pictures(const std::vector<ReportPicture>& pictures);
  /// A video that lies at `relative` from the page, with a player and a link.
  void video(const std::string& relative, const std::string& caption);
  /// A moving scene (the bytes of a GLB file) that the page plays by itself and that can be turned:
  /// `viewer` is the text of model-viewer's script, which goes into the page once.
  void moving_scene(std::string_view glb, std::string_view viewer, const std::string& caption);
  /// What to_svg() made.
  void plot(const std::string& svg);
  /// Several of them side by side where the page is wide enough.
  void plots(const std::vector<std::string>& svgs);
  /// What is added in between stands in a frame of its own: the page in short. Not nested.
  void begin_card();
  void end_card();

  /// The whole page.
  std::string text() const;
  /// Throws WriteError.
  void write(const std::filesystem::path& path) const;

 private:
  std::string title_, subtitle_, body_;
  bool in_card_ = false, has_viewer_ = false;
};

}  // namespace pedicel::io
