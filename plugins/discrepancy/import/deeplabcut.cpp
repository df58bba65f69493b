// DeepLabCut: a line of scorers, of individuals where there are several, of body parts and of
// coordinates, then rows that begin with the frame: x, y in pixels and a likelihood, or x, y, z
// where two cameras were triangulated.
#include <cmath>
#include <limits>

#include "engine/io/csv.h"
#include "plugins/discrepancy/import/headed_table.h"
#include "plugins/discrepancy/import/recording_reader.h"

namespace pedicel::discrepancy {

namespace {

bool is_deeplabcut(std::string_view head) {
  return separator_behind(head, "scorer") != '\0';
}

/// Columns of one body part; 0: absent.
struct DeepLabCutPoint {
  std::size_t x = 0, y = 0, z = 0, likelihood = 0;
};

class DeepLabCutReader {
 public:
  explicit DeepLabCutReader(const RecordingSource& source)
      : table_(source.bytes, source.file.string(), separator_behind(source.bytes, "scorer"),
               source.diagnostics),
        least_(source.options.least_likelihood) {}

  Recording read() {
    if (!read_head() || !find_points() || !table_.find_decimal_mark()) return {};
    read_rows();
    if (unlikely_ > 0)
      recording_.remarks.push_back(std::to_string(unlikely_) + " points less likely than " +
                                   io::format_number(least_) + " count as not seen (--likelihood)");
    return std::move(recording_);
  }

 private:
  static std::vector<std::string> words(const HeadedTable& table) {
    std::vector<std::string> found;
    for (const io::TableCell& cell : table.cells()) found.emplace_back(cell.text);
    return found;
  }

  bool read_head() {
    while (table_.next()) {
      if (table_.cell(0) == "individuals") individuals_ = words(table_);
      if (table_.cell(0) == "bodyparts") parts_ = words(table_);
      if (table_.cell(0) == "coords") {
        coordinates_ = words(table_);
        if (parts_.size() == coordinates_.size()) return true;
        table_.error(0, "no line of body parts of that length above, expected bodyparts,...");
        return false;
      }
      if (table_.is_number(0)) break;
    }
    table_.error(0, "the head has no line of coordinates, expected coords,x,y,likelihood,...");
    return false;
  }

  std::string name_of(std::size_t c) const {
    if (c >= individuals_.size() || individuals_[c] == "single") return parts_[c];
    return individuals_[c] + "." + parts_[c];
  }

  bool find_points() {
    for (std::size_t c = 1; c < parts_.size(); ++c) {
      const std::string name = name_of(c);
      int index = recording_.index_of(name);
      if (index < 0) {
        index = static_cast<int>(points_.size());
        recording_.names.push_back(name);
        points_.emplace_back();
      }
      DeepLabCutPoint& point = points_[index];
      const std::string& axis = coordinates_[c];
      std::size_t* place = axis == "x"            ? &point.x
                           : axis == "y"          ? &point.y
                           : axis == "z"          ? &point.z
                           : axis == "likelihood" ? &point.likelihood
                                                  : nullptr;
      if (place == nullptr || *place != 0) {
        table_.error(c, "coordinate " + in_quotes(axis) + " of " + in_quotes(name) +
                            ", expected x, y, z and likelihood, each at most once");
        return false;
      }
      *place = c;
    }
    return check_axes();
  }

  bool check_axes() {
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (points_[i].x == 0 || points_[i].y == 0 || (points_[i].z == 0) != (points_[0].z == 0)) {
        table_.error(0, "the coordinates of " + in_quotes(recording_.names[i]) +
                            " are not whole, expected x and y, or x, y and z of all");
        return false;
      }
    recording_.in_pixels = recording_.flat = !points_.empty() && points_[0].z == 0;
    return true;
  }

  void read_rows() {
    std::vector<double> rows;
    while (table_.next() && table_.count_row(parts_.size())) {
      recording_.frame.push_back(table_.number(0, true));
      for (const DeepLabCutPoint& point : points_) add_point(rows, point);
    }
    recording_.value = matrix_of_rows(rows, 3 * points_.size());
  }

  void add_point(std::vector<double>& rows, const DeepLabCutPoint& point) {
    std::vector<double> axes =
        point.z > 0 ? table_.point({point.x, point.y, point.z}) : table_.point({point.x, point.y});
    if (point.z == 0) axes.push_back(std::isnan(axes[0]) ? axes[0] : 0.0);
    if (recording_.in_pixels) axes[1] = -axes[1];  // pictures count downwards
    if (point.likelihood > 0 && table_.number(point.likelihood) < least_) {
      ++unlikely_;
      axes.assign(3, std::numeric_limits<double>::quiet_NaN());
    }
    for (const double x : axes) rows.push_back(x);
  }

  HeadedTable table_;
  Recording recording_;
  std::vector<std::string> individuals_, parts_, coordinates_;
  std::vector<DeepLabCutPoint> points_;
  double least_;
  std::size_t unlikely_ = 0;
};

}  // namespace

const RecordingFormat deeplabcut_format = {"deeplabcut",
                                           "DeepLabCut CSV",
                                           true,
                                           is_deeplabcut,
                                           read_with<DeepLabCutReader>,
                                           "does not begin with scorer"};

}  // namespace pedicel::discrepancy
