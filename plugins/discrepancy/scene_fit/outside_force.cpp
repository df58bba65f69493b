#include "plugins/discrepancy/scene_fit/outside_force.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace pedicel::discrepancy {

namespace {

// Plants side by side in the solver: as many responses cost hardly more than one.
constexpr std::size_t widest = 8;

struct ForcePlace {
  int plant = 0;
  plant::CurvePlace at;
};

std::vector<ForcePlace> places_of(const Experiment& experiment, const OutsideForceSettings& how) {
  std::vector<ForcePlace> places;
  double gap = how.spacing;
  do {
    places.clear();
    for (std::size_t p = 0; p < experiment.plants.size(); ++p)
      for (const plant::PlantCurve& curve : experiment.plants[p].file.curves) {
        // Between the drawn points. The curve itself is a little longer, which moves places by
        // little.
        double length = 0.0;
        for (std::size_t i = 1; i < curve.points.size(); ++i)
          length += (curve.points[i] - curve.points[i - 1]).norm();
        // Two at least: of a short branch the middle and the tip are different things to pull at.
        const int count = std::max(2, static_cast<int>(std::ceil(length / gap)));
        // Not at the foot, where a force moves nothing.
        for (int i = 1; i <= count; ++i)
          places.push_back({static_cast<int>(p),
                            plant::CurvePlace{curve.name, static_cast<double>(i) / count, {}}});
      }
    // Large plants are looked at more coarsely, so that time does not grow with them.
    gap *= 1.3;
  } while (static_cast<int>(places.size()) > how.places);
  return places;
}

/// One trial of the experiment, in which the places are markers that nobody has seen.
Experiment with_places(const Experiment& experiment, int trial,
                       const std::vector<ForcePlace>& places) {
  // A copy, so that the evaluator's experiment keeps its own markers and columns.
  Experiment own = experiment;
  // One trial alone: a hand that pulls once does not pull in all of them.
  own.trials = {experiment.trials[static_cast<std::size_t>(trial)]};
  for (const ForcePlace& place : places) {
    Marker marker;
    marker.name = "place " + std::to_string(own.markers.size());
    marker.plant = place.plant;
    marker.place = place.at;
    // As markers, because the simulator tells these at all times, and no other way to follow a
    // place is needed.
    own.markers.push_back(marker);
  }
  Samples& markers = own.trials.front().markers;
  // A trial without markers has no times at which places could be told.
  if (markers.size() == 0)
    for (double t = 0.0; t < own.trials.front().duration(); t += 0.01) markers.time.push_back(t);
  // What was not measured is NaN: it adds to no residual, and is predicted all the same.
  Eigen::MatrixXd wide = Eigen::MatrixXd::Constant(static_cast<long>(markers.time.size()),
                                                   3 * static_cast<long>(own.markers.size()),
                                                   std::numeric_limits<double>::quiet_NaN());
  wide.leftCols(markers.value.cols()) = markers.value;
  markers.value = wide;
  for (Samples& pixels : own.trials.front().pixels) {
    Eigen::MatrixXd more =
        Eigen::MatrixXd::Constant(pixels.value.rows(), 2 * static_cast<long>(own.markers.size()),
                                  std::numeric_limits<double>::quiet_NaN());
    more.leftCols(pixels.value.cols()) = pixels.value;
    pixels.value = more;
  }
  return own;
}

class ForceSearch {
 public:
  ForceSearch(const Experiment& experiment, int trial, const std::vector<plant::Effect>& model,
              const SceneNumerics& numerics, const OutsideForceSettings& how, int threads)
      : how_(how),
        places_(places_of(experiment, how)),
        own_(with_places(experiment, trial, places_)),
        first_(3 * static_cast<long>(experiment.markers.size())),
        data_(own_),
        simulator_(own_, numerics, threads) {
    // On top of what the best model knows: the force has to explain what that leaves.
    base_.effects = model;
    times_of_rows();
  }

  OutsideForce run() {
    // Empty where nothing can be said. Whoever asked then tells of no place.
    OutsideForce best;
    const SceneReadings here = simulate({base_}).front();
    if (!here.healthy) return best;
    const Eigen::VectorXd residual = residual_of(here);
    // Before the first response, since all of them begin there.
    begin_ = onset(residual);
    const double size = suitable_size(here);
    std::vector<double> left;
    std::vector<OutsideForce> found;
    for (std::size_t p = 0; p < places_.size(); ++p) {
      // Each place by itself. Two forces at once would explain anything.
      const Eigen::MatrixXd response = response_of(p, size, residual);
      // With the course free in every bin. A form of course would be a guess of what pulls, and the
      // answer is only where.
      found.push_back(course(residual, response));
      left.push_back(1.0 - found.back().share);
    }
    const auto least = std::ranges::min_element(left) - left.begin();
    best = found[static_cast<std::size_t>(least)];
    // Places of all plants compete: which plant was pulled is a part of the answer.
    best.plant = places_[static_cast<std::size_t>(least)].plant;
    // Places are 45 mm apart by default, and what is left is smooth between them.
    best.place = between(left, static_cast<std::size_t>(least));
    // Some place is always the best one. What counts is how much it explains. By what it explains,
    // and not by how sure each of its components is: along a stem a force is never sure.
    best.found = best.share >= how_.least_share && best.to > best.from;
    if (best.found) best.position = position(here, best, static_cast<std::size_t>(least));
    return best;
  }

 private:
  std::vector<SceneReadings> simulate(const std::vector<SceneVariant>& variants) {
    std::vector<SceneSimulator::Request> requests;
    for (const SceneVariant& variant : variants) requests.push_back({&variant, 0});
    return simulator_.run(requests);
  }

  Eigen::VectorXd residual_of(const SceneReadings& readings) const {
    Eigen::VectorXd out(data_.size(0));
    // In noise units and with the data's own weights, as everywhere.
    data_.residual(0, readings, std::numeric_limits<double>::infinity(), out);
    return out;
  }

  SceneVariant pushed(std::size_t place, int axis, double size) const {
    SceneVariant variant = base_;
    SceneForce force;
    force.plant = places_[place].plant;
    force.place = places_[place].at;
    force.force = size * Vec3::Unit(axis);
    // It then stays. A constant force shows what a place does to everything else, and a slow course
    // is a sum of such ones.
    force.from = begin_;
    // A force that begins at once rings a stem, and the course would be fitted to the ringing.
    force.rise = how_.rise;
    variant.forces.push_back(force);
    return variant;
  }

  // N, such that what moves most moves far enough to be seen, and not far.
  double suitable_size(const SceneReadings& here) {
    // A millinewton moves no plant far. Responses are linear, so the rest is a factor.
    double size = 1.0e-3;
    std::vector<SceneVariant> variants;
    for (std::size_t p = 0; p < places_.size() && variants.size() < widest; ++p)
      // Tips move most. One batch of them is enough.
      if (places_[p].at.at == 1.0) variants.push_back(pushed(p, 0, size));
    double most = 0.0;
    for (const SceneReadings& one : simulate(variants)) {
      if (!one.healthy) continue;
      const Eigen::MatrixXd moved = one.markers - here.markers;
      // All places, since the tip of one curve may move another.
      for (long c = first_; c < moved.cols(); ++c)
        for (long r = 0; r < moved.rows(); ++r)
          if (std::isfinite(moved(r, c))) most = std::max(most, std::abs(moved(r, c)));
    }
    // A plant that hardly moves is not pushed without end.
    return most > 0.0 ? size * std::clamp(way_of(here) / most, 0.01, 1.0e4) : size;
  }

  // m, that markers of plants are off at most: responses shall be as large, since contact that
  // sticks against a little slides under more.
  double way_of(const SceneReadings& here) const {
    const Eigen::MatrixXd& measured = own_.trials.front().markers.value;
    // A little at least, or contacts that stick would hide what a place does.
    double most = how_.least_response;
    for (long c = 0; c < first_; ++c)
      for (long r = 0; r < measured.rows(); ++r) {
        const double off = std::abs(measured(r, c) - here.markers(r, c));
        // Markers on the arm are off by the arm.
        if (own_.markers[static_cast<std::size_t>(c / 3)].plant >= 0 && std::isfinite(off))
          most = std::max(most, off);
      }
    // Not farther than where stems are linear, however far they were pulled.
    return std::min(most, how_.most_response);
  }

  // s, before which the residual is noise: the force does not act there, and responses to one that
  // did would meet another contact.
  double onset(const Eigen::VectorXd& residual) const {
    const std::size_t bins = bin_of(own_.trials.front().duration()) + 1;
    // In bins of time over all channels. One channel may see nothing of a pull that another one
    // sees.
    std::vector<double> square(bins, 0.0), count(bins, 0.0);
    for (long i = 0; i < residual.size(); ++i) {
      const std::size_t b = bin_of(row_time_[static_cast<std::size_t>(i)]);
      // An entry that is exactly zero was not measured.
      if (b >= bins || residual[i] == 0.0) continue;
      square[b] += residual[i] * residual[i];
      count[b] += 1.0;
    }
    const auto significant = [&](std::size_t b) {
      return square[b] > how_.significant_bin * count[b];
    };
    for (std::size_t b = 0; b + 2 < bins; ++b)
      // Three in a row: of hundreds of bins some are twice the noise by chance.
      if (significant(b) && significant(b + 1) && significant(b + 2))
        // A bin earlier: what is significant began to grow before.
        return std::max(0.0, (static_cast<double>(b) - 1.0) * how_.bin);
    // Nothing stands out, and then a force may act from the start.
    return 0.0;
  }

  // Of the residual by a force at a place, 1/N: three columns.
  Eigen::MatrixXd response_of(std::size_t place, double size, const Eigen::VectorXd& residual) {
    const auto known = responses_.find(place);
    if (known != responses_.end()) return known->second;
    // Places that fill the solver's lanes together.
    // One batch is kept, as places are asked for in their order. A response has as many rows as the
    // data.
    responses_.clear();
    std::vector<SceneVariant> variants;
    std::vector<std::size_t> of;
    // Three directions a place: five places are fifteen variants, two batches of which one lane
    // stays empty.
    const std::size_t together = 2 * widest / 3;
    for (std::size_t p = place; p < std::min(place + together, places_.size()); ++p) {
      for (int axis = 0; axis < 3; ++axis) variants.push_back(pushed(p, axis, size));
      of.push_back(p);
    }
    const std::vector<SceneReadings> readings = simulate(variants);
    for (std::size_t i = 0; i < of.size(); ++i) {
      Eigen::MatrixXd columns(residual.size(), 3);
      for (int axis = 0; axis < 3; ++axis) {
        const SceneReadings& one = readings[3 * i + static_cast<std::size_t>(axis)];
        if (one.healthy)
          // What a newton there takes off the residual, in noise units.
          columns.col(axis) = (residual - residual_of(one)) / size;
        else
          // A push that the plant does not survive explains nothing.
          columns.col(axis).setZero();
      }
      responses_[of[i]] = columns;
    }
    return responses_[place];
  }

  void times_of_rows() {
    // In the order in which the data set lays out its residual: channel by channel, all times of
    // each.
    const auto add = [&](const Samples& samples) {
      for (long c = 0; c < samples.value.cols(); ++c)
        row_time_.insert(row_time_.end(), samples.time.begin(), samples.time.end());
    };
    const Trial& trial = own_.trials.front();
    add(trial.markers);
    for (const Samples& one : trial.pixels) add(one);
    for (const Samples& one : trial.wrenches) add(one);
    add(trial.torques);
    // Elsewhere joints are what drives the model, and no data.
    if (trial.follows_commands) add(trial.joints);
  }

  // The force that explains the residual best, bin by bin.
  OutsideForce course(const Eigen::VectorXd& residual, const Eigen::MatrixXd& response) const {
    const std::size_t bins = bin_of(own_.trials.front().duration()) + 1;
    std::vector<Mat3> normal(bins, Mat3::Zero());
    std::vector<Vec3> right(bins, Vec3::Zero());
    std::vector<double> square(bins, 0.0), count(bins, 0.0);
    for (long i = 0; i < residual.size(); ++i) {
      const std::size_t b = bin_of(row_time_[static_cast<std::size_t>(i)]);
      if (b >= bins || residual[i] == 0.0) continue;
      const Vec3 row = response.row(i).transpose();
      normal[b] += row * row.transpose();
      right[b] += row * residual[i];
      square[b] += residual[i] * residual[i];
      count[b] += 1.0;
    }
    // A bin is fitted as if the plant followed at once. That holds for what is slow against its
    // swing, which a hand's pull is.
    OutsideForce out;
    double all = 0.0, taken = 0.0;
    std::vector<double> clear(bins, 0.0);  // what it gains, in units of what is left a sample
    for (std::size_t b = 0; b < bins; ++b) {
      out.time.push_back((static_cast<double>(b) + 0.5) * how_.bin);
      // Along a stem nearly nothing moves, and a force there would be noise.
      const double ridge = how_.weak_axis * normal[b].trace() + 1.0e-12;
      const Mat3 inverse = (normal[b] + ridge * Mat3::Identity()).inverse();
      const Vec3 force = inverse * right[b];
      out.force.push_back(force);
      // Noise leaves one unit a sample in the best model. Only what is above can be explained.
      const double own = std::max(0.0, square[b] - count[b]);
      const double gain =
          // What the sum of squares falls by, between nothing and all that is above the noise.
          std::clamp(2.0 * force.dot(right[b]) - force.dot(normal[b] * force), 0.0, own);
      all += own;
      taken += gain;
      // Three numbers were fitted to a bin: with fewer samples it leaves nothing by itself.
      const double left = count[b] > 3.0 ? std::max(1.0, (square[b] - gain) / count[b]) : 1.0;
      clear[b] = gain / left;
    }
    // Of what is above the noise in all bins, so that a place that explains a short time well is
    // not the best.
    out.share = all > 0.0 ? taken / all : 0.0;
    mark_active(out, clear);
    return out;
  }

  void mark_active(OutsideForce& out, const std::vector<double>& clear) const {
    // In units of what is left in the bin itself, so that a bin that no force explains has none.
    const auto seen = [&](std::size_t b) { return clear[b] > how_.clear_force * how_.clear_force; };
    std::vector<double> sizes;
    for (std::size_t b = 0; b < clear.size(); ++b)
      if (seen(b)) sizes.push_back(out.force[b].norm());
    if (sizes.empty()) return;
    // Where it begins, responses are small and forces wild.
    std::ranges::sort(sizes);
    // Not the largest: one bin may be an outlier.
    const double peak = sizes[sizes.size() * 9 / 10];
    const auto strong = [&](std::size_t b) {
      return seen(b) && out.force[b].norm() > how_.peak_share * peak;
    };
    std::vector<std::size_t> active;
    // Three in a row, so that noise alone is no pull.
    for (std::size_t b = 0; b + 2 < clear.size(); ++b)
      if (strong(b) && strong(b + 1) && strong(b + 2)) active.push_back(b);
    if (active.empty()) return;
    // It began small.
    std::size_t first = active.front();
    while (first > 0 && seen(first - 1) && out.force[first - 1].norm() > how_.onset_share * peak)
      --first;
    out.from = static_cast<double>(first) * how_.bin;
    // The last of three that act in a row ends two bins later, at its own end.
    out.to = static_cast<double>(active.back() + 3) * how_.bin;
    Vec3 mean = Vec3::Zero();
    double square = 0.0;
    for (const std::size_t b : active) {
      mean += out.force[b];
      square += out.force[b].squaredNorm();
    }
    // A mean of sizes and not the size of the mean, which of a push to and fro would be nothing.
    out.size = std::sqrt(square / static_cast<double>(active.size()));
    // Of the mean, since a hand that pulls keeps to its direction. Of a push to and fro it says
    // nothing.
    if (mean.norm() > 0.0) out.direction = mean.normalized();
  }

  // Between the places that were tried: the parabola through the best one and its neighbours.
  plant::CurvePlace between(const std::vector<double>& left, std::size_t best) const {
    plant::CurvePlace place = places_[best].at;
    // At an end of a curve there is no neighbour to draw a parabola through.
    const bool inside = best > 0 && best + 1 < places_.size() &&
                        places_[best - 1].at.curve == place.curve &&
                        places_[best + 1].at.curve == place.curve;
    if (!inside) return place;
    const double a = left[best - 1], b = left[best], c = left[best + 1];
    // Where the best is no minimum between its neighbours, as on a plateau, it stays where it is.
    const double bend = a - 2.0 * b + c;
    // Half of the way at most: beyond it the neighbour would have been the best one.
    const double shift = bend > 0.0 ? std::clamp(0.5 * (a - c) / bend, -0.5, 0.5) : 0.0;
    place.at += shift * (places_[best + 1].at.at - place.at);
    return place;
  }

  // Where the place was when it began: as simulated, and off by what the markers beside it are.
  Vec3 position(const SceneReadings& here, const OutsideForce& force, std::size_t best) const {
    const Samples& markers = own_.trials.front().markers;
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (long r = 0; r < markers.size(); ++r) {
      const double t = markers.time[static_cast<std::size_t>(r)];
      // Only the beginning. Later the force itself has moved the place.
      if (t < force.from || t > force.from + 3.0 * how_.bin) continue;
      const Vec3 place = simulated(here, r, force.place, best) + off_beside(here, r, force);
      if (!place.allFinite()) continue;
      sum += place;
      ++count;
    }
    return count > 0 ? Vec3(sum / count) : sum;
  }

  // m, W, of a place between the best of those tried and its neighbour.
  Vec3 simulated(const SceneReadings& here, long row, const plant::CurvePlace& place,
                 std::size_t best) const {
    const auto at = [&](std::size_t p) -> Vec3 {
      return here.markers.row(row).segment<3>(first_ + 3 * static_cast<long>(p)).transpose();
    };
    const double beyond = place.at - places_[best].at.at;
    if (beyond == 0.0) return at(best);
    const std::size_t other = beyond > 0.0 ? best + 1 : best - 1;
    // Straight between neighbours: the stem bends little over 45 mm.
    const double share = beyond / (places_[other].at.at - places_[best].at.at);
    return (1.0 - share) * at(best) + share * at(other);
  }

  // m, W, measured less simulated, between the markers below and above on the curve.
  Vec3 off_beside(const SceneReadings& here, long row, const OutsideForce& force) const {
    double below = 0.0, above = std::numeric_limits<double>::infinity();
    Vec3 off_below = Vec3::Zero(), off_above = Vec3::Zero();
    for (std::size_t m = 0; 3 * static_cast<long>(m) < first_; ++m) {
      const Marker& marker = own_.markers[m];
      // Markers of other curves are off by what those do.
      if (marker.plant != force.plant || marker.place.curve != force.place.curve) continue;
      const long c = 3 * static_cast<long>(m);
      const Vec3 off = (own_.trials.front().markers.value.row(row) - here.markers.row(row))
                           .segment<3>(c)
                           .transpose();
      if (!off.allFinite()) continue;
      const double at = marker.place.at;
      if (at <= force.place.at && at >= below) {
        below = at;
        off_below = off;
      }
      if (at > force.place.at && at < above) {
        above = at;
        off_above = off;
      }
    }
    // Above the last marker a stem goes on as below it. Below the first one it is fixed at its
    // foot, where nothing is off.
    if (!std::isfinite(above)) return off_below;
    const double share = (force.place.at - below) / (above - below);
    return (1.0 - share) * off_below + share * off_above;
  }

  std::size_t bin_of(double time) const { return static_cast<std::size_t>(time / how_.bin); }

  const OutsideForceSettings& how_;
  std::vector<ForcePlace> places_;
  Experiment own_;
  long first_;  // column of the places' markers
  SceneDataSet data_;
  SceneSimulator simulator_;
  SceneVariant base_;
  double begin_ = 0.0;  // s, of the responses' forces
  std::vector<double> row_time_;
  std::map<std::size_t, Eigen::MatrixXd> responses_;
};

}  // namespace

OutsideForce find_outside_force(SceneEvaluator& evaluator, const std::vector<plant::Effect>& model,
                                std::span<const int> trials, int threads) {
  const Experiment& experiment = evaluator.simulator().experiment();
  SceneVariant variant{model};
  // One trial is searched, the one in which it shows most: a search of all would take as long for
  // each.
  double most = 0.0;
  int worst = -1;
  for (const int t : trials) {
    const SceneSimulator::Request request{&variant, t};
    const SceneReadings readings = evaluator.simulator().run({&request, 1}).front();
    Misfit sum;
    // All kinds of channels together, in noise units.
    for (const Misfit& one : evaluator.data().sums(t, readings)) sum += one;
    // By the sum and not by the mean: a long trial with a short pull has a small mean, and the pull
    // is what is looked for.
    if (sum.square > most) {
      most = sum.square;
      worst = t;
    }
  }
  if (worst < 0) return {};
  OutsideForce found = ForceSearch(experiment, worst, model, evaluator.simulator().numerics(),
                                   evaluator.settings().outside, threads)
                           .run();
  found.trial = worst;
  return found;
}

}  // namespace pedicel::discrepancy
