#include "plugins/plant/spline_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pedicel::plant {

namespace {

using Weights = Eigen::Vector4d;

constexpr int parts = 12;            // places looked at in a piece
constexpr int reparametrised = 3;    // times, before a point is added
constexpr double smallest = 1.0e-9;  // m^1/2, of a knot interval

/// A place on the spline: a piece and its local parameter.
struct Place {
  int piece = 0;
  double u = 0.0;
};

/// What the four points about a piece weigh at a place: the pyramid of P. J. Barry and R. N.
/// Goldman (SIGGRAPH 1988) on unit vectors. `t` are the knots of the four points.
Weights piece_weights(const std::array<double, 4>& t, double u) {
  const double now = t[1] + u * (t[2] - t[1]);
  std::array<Weights, 4> p;
  for (int i = 0; i < 4; ++i) p[i] = Weights::Unit(i);
  for (int level = 1; level <= 3; ++level)
    for (int i = 0; i + level < 4; ++i) {
      const int low = level == 3 ? 1 : i, high = level == 3 ? 2 : i + level;
      const double share = (now - t[low]) / (t[high] - t[low]);
      p[i] = (1.0 - share) * p[i] + share * p[i + 1];
    }
  return p[0];
}

/// The spline through control points, its ends extended by the mirrored neighbour.
class Spline {
 public:
  explicit Spline(std::vector<Vec3> points) : points_(std::move(points)) {
    for (int piece = 0; piece < pieces(); ++piece) knots_.push_back(knots(piece));
    for (int piece = 0; piece < pieces(); ++piece)
      for (int k = 0; k <= parts; ++k) looked_at_.push_back(at({piece, share(k)}));
  }

  int pieces() const { return static_cast<int>(points_.size()) - 1; }
  const std::vector<Vec3>& points() const { return points_; }

  Vec3 at(const Place& place) const {
    const Weights w = piece_weights(knots_[place.piece], place.u);
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < 4; ++i) sum += w[i] * point(place.piece - 1 + i);
    return sum;
  }

  /// What each control point weighs at a place: the mirrored ends are linear in the others.
  void add_row(const Place& place, Eigen::Ref<Eigen::VectorXd> row) const {
    const Weights w = piece_weights(knots_[place.piece], place.u);
    const int last = pieces();
    for (int i = 0; i < 4; ++i) {
      const int index = place.piece - 1 + i;
      if (index < 0) {
        row[0] += 2.0 * w[i];
        row[1] -= w[i];
      } else if (index > last) {
        row[last] += 2.0 * w[i];
        row[last - 1] -= w[i];
      } else {
        row[index] += w[i];
      }
    }
  }

  /// The nearest place of some pieces.
  Place nearest(const Vec3& sample, int first_piece, int last_piece) const {
    Place best;
    double least = std::numeric_limits<double>::infinity();
    for (int piece = std::max(0, first_piece); piece <= std::min(last_piece, pieces() - 1); ++piece)
      for (int k = 0; k <= parts; ++k) {
        const double distance = (looked_at_[piece * (parts + 1) + k] - sample).squaredNorm();
        if (distance >= least) continue;
        least = distance;
        best = {piece, share(k)};
      }
    return refined(best, sample);
  }

 private:
  Vec3 point(int index) const {
    const int last = pieces();
    if (index < 0) return 2.0 * points_[0] - points_[1];
    if (index > last) return 2.0 * points_[last] - points_[last - 1];
    return points_[index];
  }

  std::array<double, 4> knots(int piece) const {
    std::array<double, 4> t{};
    for (int i = 1; i < 4; ++i) {
      const double chord = (point(piece - 1 + i) - point(piece - 2 + i)).norm();
      t[i] = t[i - 1] + std::max(smallest, std::sqrt(chord));
    }
    return t;
  }

  // Golden section between the neighbours of the best place.
  Place refined(const Place& near, const Vec3& sample) const {
    double low = std::max(0.0, near.u - 1.0 / parts), high = std::min(1.0, near.u + 1.0 / parts);
    constexpr double golden = 0.6180339887498949;
    for (int i = 0; i < 16; ++i) {
      const double a = high - golden * (high - low), b = low + golden * (high - low);
      const bool left = (at({near.piece, a}) - sample).squaredNorm() <
                        (at({near.piece, b}) - sample).squaredNorm();
      (left ? high : low) = left ? b : a;
    }
    return {near.piece, 0.5 * (low + high)};
  }

  static double share(int k) { return static_cast<double>(k) / parts; }

  std::vector<Vec3> points_, looked_at_;
  std::vector<std::array<double, 4>> knots_;  // of each piece
};

/// Inner control points by least squares, ends fixed; a little weight on where they are keeps those
/// that no sample sees.
std::vector<Vec3> solve(const Spline& spline, const std::vector<Vec3>& samples,
                        const std::vector<Place>& places) {
  const int count = static_cast<int>(spline.points().size()), inner = count - 2;
  if (inner < 1) return spline.points();
  const int rows = static_cast<int>(samples.size());
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(count, rows);
  Eigen::MatrixXd target(rows, 3);
  for (int s = 0; s < rows; ++s) {
    spline.add_row(places[s], weights.col(s));
    target.row(s) = samples[s].transpose();
  }
  const Eigen::MatrixXd all = weights.transpose();
  target -= all.col(0) * spline.points().front().transpose();
  target -= all.col(count - 1) * spline.points().back().transpose();
  const Eigen::MatrixXd a = all.middleCols(1, inner);
  Eigen::MatrixXd now(inner, 3);
  for (int i = 0; i < inner; ++i) now.row(i) = spline.points()[i + 1].transpose();
  const double keep = 1.0e-4;
  const Eigen::MatrixXd normal = a.transpose() * a + keep * Eigen::MatrixXd::Identity(inner, inner);
  const Eigen::MatrixXd solved = normal.ldlt().solve(a.transpose() * target + keep * now);
  std::vector<Vec3> points = spline.points();
  for (int i = 0; i < inner; ++i) points[i + 1] = solved.row(i).transpose();
  return points;
}

/// Where the samples lie, near the piece that they were between.
std::vector<Place> places_of(const Spline& spline, const std::vector<Vec3>& samples,
                             const std::vector<std::size_t>& seeds) {
  std::vector<Place> places;
  int piece = 0;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    while (piece + 1 < spline.pieces() && s >= seeds[piece + 1]) ++piece;
    places.push_back(spline.nearest(samples[s], piece - 1, piece + 1));
  }
  places.front() = {0, 0.0};
  places.back() = {spline.pieces() - 1, 1.0};
  return places;
}

bool stand_apart(const std::vector<Vec3>& points) {
  for (std::size_t i = 1; i < points.size(); ++i)
    if ((points[i] - points[i - 1]).norm() < 1.0e-5) return false;
  return true;
}

/// The sample in the middle of a piece, by its own length; the piece has one.
std::size_t middle_of(const std::vector<Vec3>& samples, std::size_t from, std::size_t to) {
  double length = 0.0, half = 0.0;
  for (std::size_t s = from; s < to; ++s) length += (samples[s + 1] - samples[s]).norm();
  std::size_t middle = from;
  while (middle + 2 < to && half < 0.5 * length) {
    half += (samples[middle + 1] - samples[middle]).norm();
    ++middle;
  }
  return std::max(middle, from + 1);
}

/// The piece between two seeds in which a sample lies.
std::size_t piece_of(const std::vector<std::size_t>& seeds, std::size_t sample) {
  const auto above = std::upper_bound(seeds.begin() + 1, seeds.end() - 1, sample);
  return static_cast<std::size_t>(above - seeds.begin()) - 1;
}

struct Fit {
  std::vector<Vec3> points;
  std::vector<double> error;  // m, one a sample
};

/// One round of the loop with control points where the seeds are.
Fit fit_with(const std::vector<std::size_t>& seeds, const std::vector<Vec3>& samples) {
  std::vector<Vec3> points;
  for (const std::size_t seed : seeds) points.push_back(samples[seed]);
  Spline spline(points);
  std::vector<Place> places = places_of(spline, samples, seeds);
  for (int i = 0; i < reparametrised; ++i) {
    std::vector<Vec3> solved = solve(spline, samples, places);
    if (!stand_apart(solved)) break;
    spline = Spline(std::move(solved));
    places = places_of(spline, samples, seeds);
  }
  Fit fit{spline.points(), {}};
  for (std::size_t s = 0; s < samples.size(); ++s)
    fit.error.push_back((spline.at(places[s]) - samples[s]).norm());
  return fit;
}

}  // namespace

std::vector<Vec3> fit_spline(const std::vector<Vec3>& samples, double tolerance) {
  std::vector<std::size_t> seeds = {0, samples.size() - 1};  // samples that gave a control point
  while (true) {
    const Fit fit = fit_with(seeds, samples);
    // The piece with the largest error that can still be split.
    double largest = 0.0;
    std::size_t split = 0;
    bool holds = true;
    for (std::size_t s = 0; s < samples.size(); ++s) {
      holds = holds && fit.error[s] <= tolerance;
      const std::size_t piece = piece_of(seeds, s);
      if (fit.error[s] <= largest || seeds[piece + 1] - seeds[piece] < 2) continue;
      largest = fit.error[s];
      split = piece;
    }
    if (holds || largest == 0.0) return fit.points;
    seeds.insert(seeds.begin() + static_cast<long>(split) + 1,
                 middle_of(samples, seeds[split], seeds[split + 1]));
  }
}

}  // namespace pedicel::plant
