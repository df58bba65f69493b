#include "plugins/discrepancy/import/world_tracks.h"

#include <cmath>
#include <limits>

#include "engine/io/csv.h"
#include "engine/io/unit_text.h"
#include "plugins/discrepancy/import/world_frame.h"

namespace pedicel::discrepancy {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double finest = 1.0e-9;  // m and s: what is finer is rounding of units

double rounded(double value) {
  return std::round(value / finest) * finest;
}

std::string place_text(const SourcePosition& where) {
  return where.line > 0 ? " (line " + std::to_string(where.line) + ")" : "";
}

class TracksMaker {
 public:
  TracksMaker(const Recording& recording, const Statements& statements, ImportNotes& notes)
      : recording_(recording),
        statements_(statements),
        notes_(notes),
        name_(recording.file.filename().string()) {}

  WorldTracks make() {
    WorldTracks tracks;
    tracks.time = times();
    tracks.value = recording_.in_pixels ? from_picture() : from_space();
    for (double& x : tracks.value.reshaped()) x = rounded(x);
    return tracks;
  }

 private:
  void say(const std::string& sentence) { notes_.said.push_back(name_ + ": " + sentence); }
  void miss(const std::string& sentence) {
    notes_.missing.push_back(recording_.file.string() + ": " + sentence);
  }

  /// The person's word, else the file's; where both differ that is said.
  template <class Value, class Text>
  std::optional<Value> taken(const Stated<Value>& stated, const std::optional<Value>& told,
                             const std::string& what, const std::string& option, const Text& text) {
    if (told && stated.value && *told != *stated.value)
      say("warning: " + what + " " + text(*told) + " as " + option +
          " says, though the file states " + text(*stated.value) + place_text(stated.where));
    else if (told)
      say(what + " " + text(*told) + ", as " + option + " says");
    else if (stated.value)
      say(what + " " + text(*stated.value) + ", as the file states" + place_text(stated.where));
    return told ? told : stated.value;
  }

  std::vector<double> times() {
    const auto hertz = [](double rate) { return io::format_number(rate) + " Hz"; };
    if (!recording_.time.empty() && !statements_.rate) {
      say("times as the file has them");
      return recording_.time;
    }
    const auto rate = taken(recording_.rate, statements_.rate, "rate", "--rate", hertz);
    if (!rate) {
      miss("the file counts frames and does not state their rate (" + recording_.program +
           "), expected --rate with frames a second");
      return {};
    }
    std::vector<double> times;
    for (int i = 0; i < recording_.samples(); ++i) {
      const auto& frame = recording_.frame;
      const double count = frame.empty() ? i : frame[static_cast<std::size_t>(i)] - frame.front();
      times.push_back(rounded(count / *rate));
    }
    return times;
  }

  std::optional<Mat3> axes() {
    if (statements_.axes) {
      say("axes as --up or --axes says");
      return statements_.axes;
    }
    if (recording_.up.value) {
      say(std::string("axis ") + *recording_.up.value + " is up, as the file states");
      return turn_of_up(*recording_.up.value);
    }
    miss("the file does not state which axis is up (" + recording_.program +
         "), expected --up x, --up y or --up z, or --axes with the file's axes along the world's");
    return std::nullopt;
  }

  Eigen::MatrixXd from_space() {
    const auto unit = taken(recording_.unit, statements_.unit, "unit", "--units",
                            [](double u) { return io::length_unit_name(u); });
    if (!unit)
      miss("the file does not state its unit of length (" + recording_.program +
           "), expected --units with " + io::expected_length_units());
    const auto turn = axes();
    if (!unit || !turn) return {};
    if (recording_.flat) say_flat(*turn);
    return each([&](const Vec3& x) { return Vec3(*turn * (*unit * x) + statements_.origin); });
  }

  template <class Map>
  Eigen::MatrixXd each(const Map& map) const {
    Eigen::MatrixXd value = recording_.value;
    for (Eigen::Index r = 0; r < value.rows(); ++r)
      for (Eigen::Index c = 0; c + 2 < value.cols(); c += 3) {
        const Vec3 point = value.block<1, 3>(r, c).transpose();
        const Vec3 placed = point.allFinite() ? map(point) : point;
        value.block<1, 3>(r, c) = (placed.allFinite() ? placed : Vec3(nan, nan, nan)).transpose();
      }
    return value;
  }

  void say_flat(const Mat3& turn) {
    int across = 0;
    turn.col(2).cwiseAbs().maxCoeff(&across);
    say(std::string("warning: the file has two axes; the world's ") + "xyz"[across] +
        " was not measured and stays " + io::format_number(statements_.origin[across]) + " m");
  }

  Eigen::MatrixXd from_picture() {
    if (statements_.camera) return through_camera(*statements_.camera);
    if (!statements_.scale)
      miss(
          "the points are in pixels, expected --scale with metres a pixel, or --camera and "
          "--plane");
    if (!statements_.origin_pixel)
      miss(
          "the points are in pixels, expected --origin-pixel with the pixel u,v of the world's "
          "origin");
    const auto turn = axes();
    if (!statements_.scale || !statements_.origin_pixel || !turn) return {};
    const Vec3 zero(statements_.origin_pixel->x(), -statements_.origin_pixel->y(), 0.0);
    say(io::format_number(*statements_.scale) + " m a pixel, as --scale says");
    say_flat(*turn);
    return each([&](const Vec3& x) {
      return Vec3(*turn * (*statements_.scale * (x - zero)) + statements_.origin);
    });
  }

  Eigen::MatrixXd through_camera(const PictureCamera& camera) {
    if (!statements_.plane) {
      miss(
          "one camera sees no depth, expected --plane with the plane in which the points move "
          "(y=0)");
      return {};
    }
    int beside = 0;
    const Eigen::MatrixXd found = each([&](const Vec3& x) {
      const auto ray = camera.ray({x.x(), -x.y()});
      const auto point = ray ? statements_.plane->meets(camera.pose.position, *ray) : std::nullopt;
      beside += point ? 0 : 1;
      return point.value_or(Vec3(nan, nan, nan));
    });
    say(std::string("through --camera into the plane ") + "xyz"[statements_.plane->axis] + " = " +
        io::format_number(statements_.plane->offset) + " m, across which nothing was measured");
    if (beside > 0)
      say("warning: " + std::to_string(beside) +
          " points do not meet the plane and count as not seen");
    return found;
  }

  const Recording& recording_;
  const Statements& statements_;
  ImportNotes& notes_;
  std::string name_;
};

}  // namespace

WorldTracks world_tracks(const Recording& recording, const Statements& statements,
                         ImportNotes& notes) {
  for (const std::string& remark : recording.remarks)
    notes.said.push_back(recording.file.filename().string() + ": " + remark);
  return TracksMaker(recording, statements, notes).make();
}

}  // namespace pedicel::discrepancy
