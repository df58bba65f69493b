#include "plugins/discrepancy/force/force_space.h"

#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/data/places.h"
#include "plugins/discrepancy/simulate/force_term.h"
#include "plugins/discrepancy/simulate/scales.h"

namespace pedicel::discrepancy {

namespace {

constexpr double least_interval = 0.1;  // s between knots: pushes of up to 3 Hz
constexpr int most_knots = 50;          // of a trial
// Responses are differences of two simulations, so errors of the step cancel.
constexpr double response_dt = 1.0 / 240;
constexpr double wanted_bend = 0.03;  // of a curve's length: well above the solver's tolerance
constexpr double memory = 0.3;        // s, of a force of no particular law

// Entries of its part of a residual, measured or not: columns are laid out as residuals are.
int samples_of(const DataSet& data, int trial) {
  return data.size(std::span(&trial, 1));
}

// Rises from the knot before and falls to the next; the first one also acts before time 0.
double hat(double t, double middle, double interval) {
  // Hats add up to any course that is linear between knots, and each of them is felt for a short
  // time only.
  return std::max(0.0, 1.0 - std::abs(t - middle) / interval);
}

// The mean of what there is within so many seconds; 0 where nothing is.
Eigen::MatrixXd smoothed(const Eigen::MatrixXd& x, const std::vector<double>& time, double within) {
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(x.rows(), x.cols());
  for (Eigen::Index row = 0, from = 0, to = 0; row < x.rows(); ++row) {
    // Two ends that only move forward: the whole takes one pass.
    while (time[from] < time[row] - within) ++from;
    while (to < x.rows() && time[to] <= time[row] + within) ++to;
    for (Eigen::Index c = 0; c < x.cols(); ++c) {
      const auto near = x.col(c).segment(from, to - from).array();
      const double count = static_cast<double>(near.isFinite().count());
      // Where a marker was hidden the model alone is believed.
      if (count > 0.0) mean(row, c) = near.isFinite().select(near, 0.0).sum() / count;
    }
  }
  return mean;
}

}  // namespace

ForceResponses::ForceResponses(const Experiment& experiment, const DataSet& data,
                               const FitSummary& model, const FitOptions& options, double distance,
                               int threads, const std::atomic<bool>* stop)
    : experiment_(experiment),
      data_(data),
      model_(model),
      trials_(options.trials),
      variant_(model.hypothesis.variant()),
      simulator_(experiment, {distance, response_dt}, threads, stop) {
  std::vector<Simulator::Request> requests;
  for (const int trial : trials_) {
    // Long trials get slower histories. Their number of knots is bounded, as every knot is two
    // simulations.
    const double duration = experiment.trials[trial].duration();
    ForceKnots knots;
    knots.trial = trial;
    knots.interval = std::max(least_interval, duration / most_knots);
    // A duration that is a whole number of knots must not get one more by rounding.
    knots.count = static_cast<int>(std::ceil(duration / knots.interval - 1e-9)) + 1;
    knots_.push_back(knots);
    requests.push_back({&variant_, trial});
  }
  // With the same mesh and step as the responses: the evaluator's own predictions differ by more
  // than a small push does.
  plain_ = simulator_.run(requests);
}

std::vector<Vec3> ForceResponses::axes_at(int marker) const {
  const plant::CurvePlace& place = experiment_.markers[marker].place;
  Vec3 tangent = Vec3::UnitZ();
  for (const plant::PlantCurve& curve : experiment_.plant().curves)
    if (curve.name == place.curve)
      // As drawn. What bends a little afterwards stays nearly across.
      tangent = drawn_point(curve, std::min(1.0, place.at + 0.02)) -
                drawn_point(curve, std::max(0.0, place.at - 0.02));
  std::vector<Vec3> axes(2);
  // Along the curve a stem is thousands of times stiffer: a force there moves nothing, and any size
  // of it would fit.
  across(tangent, axes[0], axes[1]);
  return axes;
}

// N: a constant push of this size bends the plant by the wanted share of its length at most.
double ForceResponses::push_size(int marker, const std::vector<Vec3>& axes) {
  const Scales scales = scales_of(experiment_);
  // A hundredth of the weight bends no plant far, and some plants much: so the push is first tried,
  // and then scaled.
  const double trial_size = 0.01 * 9.81 * scales.mass;
  // The largest move of any marker and not of this one: what bends there may swing farther out.
  double most = 0.0;
  std::vector<Variant> variants(axes.size(), variant_);
  std::vector<Simulator::Request> requests;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const Vec3 push = trial_size * axes[a];
    variants[a].forces.push_back({experiment_.markers[marker].place,
                                  [=](double, const Vec3&, const Vec3&) { return push; },
                                  {}});
    // Constant, since that bends a plant most: a push for a tenth of a second moves it less.
    for (const int trial : trials_) requests.push_back({&variants[a], trial});
  }
  const std::vector<Prediction> pushed = simulator_.run(requests);
  for (std::size_t i = 0; i < pushed.size(); ++i) {
    const Eigen::MatrixXd moved = pushed[i].markers - plain_[i % trials_.size()].markers;
    for (const double x : moved.reshaped())
      if (std::isfinite(x)) most = std::max(most, std::abs(x));
  }
  // A larger one would leave the linear range, a smaller one would drown in what Newton's method
  // leaves.
  return most > 0.0 ? trial_size * wanted_bend * scales.length / most : trial_size;
}

Eigen::MatrixXd ForceResponses::simulate(const ForceKnots& knots, double size, ForceSpace& space) {
  // One variant a coefficient. They have the plant in common and fill the solver's lanes.
  const int count = static_cast<int>(space.axes.size()) * knots.count;
  std::vector<Variant> variants(count, variant_);
  std::vector<Simulator::Request> requests;
  for (int c = 0; c < count; ++c) {
    const Vec3 push = size * space.axes[c / knots.count];
    const double middle = c % knots.count * knots.interval, interval = knots.interval;
    variants[c].forces.push_back({space.place,
                                  [=](double t, const Vec3&, const Vec3&) -> Vec3 {
                                    return hat(t, middle, interval) * push;
                                  },
                                  {}});
    // In its own trial alone. What happens in one trial is not felt in another.
    requests.push_back({&variants[c], knots.trial});
  }
  const std::vector<Prediction> pushed = simulator_.run(requests);
  const auto index = std::find(trials_.begin(), trials_.end(), knots.trial) - trials_.begin();
  const Prediction& plain = plain_[index];
  const int rows = samples_of(data_, knots.trial);
  Eigen::VectorXd before(rows), after(rows);
  // In noise units, so that sums of squares are log likelihoods.
  data_.residual(knots.trial, plain, 1.0, before);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(rows, count);
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(3 * plain.markers.rows(), count);
  for (int c = 0; c < count; ++c) {
    // A column of zeros: a push that the plant does not survive explains nothing.
    if (!pushed[c].healthy) continue;
    data_.residual(knots.trial, pushed[c], 1.0, after);
    // What a newton adds to the prediction, as residuals are data less prediction.
    columns.col(c) = (before - after) / size;
    const Eigen::MatrixXd moved =
        (pushed[c].markers - plain.markers).middleCols(3 * space.marker, 3) / size;
    // Laws depend on where the place is. What the force itself moves it by is part of that.
    motion.col(c) = moved.reshaped();
  }
  // Kept beside the normal equations, because a law needs to know where its place went.
  space.motion.push_back(std::move(motion));
  return columns;
}

Eigen::Index ForceResponses::row_of(int trial) const {
  Eigen::Index row = 0;
  for (const int other : trials_) {
    if (other == trial) break;
    row += samples_of(data_, other);
  }
  return row;
}

ForceSpace ForceResponses::prepared(int axes) const {
  ForceSpace space;
  int size = 0;
  for (ForceKnots knots : knots_) {
    // Coefficients of trials follow one another: a force has a history in each, and nothing ties
    // them but its law.
    knots.first = size;
    size += axes * knots.count;
    space.knots.push_back(knots);
  }
  space.normal.setZero(size, size);
  space.right.setZero(size);
  return space;
}

void ForceResponses::add(const Eigen::MatrixXd& columns, const ForceKnots& knots, ForceSpace& space,
                         Eigen::MatrixXd& coupling) const {
  const Eigen::Index row = row_of(knots.trial), rows = columns.rows(), count = columns.cols();
  // Trials do not share samples, so there are no blocks between them.
  space.normal.block(knots.first, knots.first, count, count).noalias() =
      columns.transpose() * columns;
  // Of the fitted model's residual: it is what the force has to explain.
  space.right.segment(knots.first, count).noalias() =
      columns.transpose() * model_.residual.segment(row, rows);
  // What both force and parameters can explain must not be counted twice.
  if (model_.jacobian.cols() > 0)
    coupling.middleRows(knots.first, count).noalias() =
        columns.transpose() * model_.jacobian.middleRows(row, rows);
}

// The parameters move along: their best values for any history are taken out (Schur complement).
void ForceResponses::finish(ForceSpace& space, const Eigen::MatrixXd& coupling) const {
  const Eigen::MatrixXd& jacobian = model_.jacobian;
  if (jacobian.cols() == 0) return;
  // What the data and what is known say of the parameters together.
  Eigen::MatrixXd information = jacobian.transpose() * jacobian;
  for (int p = 0; p < model_.hypothesis.size(); ++p) {
    const double prior = model_.hypothesis.free[p].prior;
    // A parameter that the data do not see would make the matrix singular.
    information(p, p) += 1.0e-9 * (1.0 + information(p, p));
    // What is known beforehand keeps parameters from standing for the force.
    if (prior > 0.0) information(p, p) += 1.0 / (prior * prior);
  }
  const Eigen::LDLT<Eigen::MatrixXd> solver(information);
  // How the parameters would follow each coefficient, to first order.
  const Eigen::MatrixXd moved = solver.solve(coupling.transpose());
  // Refits start with parameters that have already given way.
  space.shift = -moved;
  space.normal.noalias() -= coupling * moved;
  // The residual at a fit's end is not orthogonal to its derivatives where a parameter stands at a
  // bound or has a prior.
  space.right.noalias() -= moved.transpose() * (jacobian.transpose() * model_.residual);
}

ForceSpace ForceResponses::force_at(int marker) {
  ForceSpace space = prepared(2);
  space.marker = marker;
  space.place = experiment_.markers[marker].place;
  space.axes = axes_at(marker);
  // Of each marker: near the foot of a stem it takes a thousand times the force of its tip.
  const double size = push_size(marker, space.axes);
  Eigen::MatrixXd coupling(space.size(), model_.jacobian.cols());
  for (const ForceKnots& knots : space.knots)
    // Trial by trial, so that predictions of one are gone before the next: a trial has a hundred of
    // them.
    add(simulate(knots, size, space), knots, space, coupling);
  finish(space, coupling);
  return space;
}

ForceSpace ForceResponses::displacement_of(const std::vector<int>& markers) const {
  // Residuals are linear in it, so any step that is no rounding will do.
  constexpr double step = 1.0e-3;  // m
  // A camera that moves is not bound to the curve's two directions.
  ForceSpace space = prepared(3);
  space.axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  Eigen::MatrixXd coupling(space.size(), model_.jacobian.cols());
  for (std::size_t k = 0; k < space.knots.size(); ++k) {
    const ForceKnots& knots = space.knots[k];
    const std::vector<double>& time = experiment_.trials[knots.trial].markers.time;
    const int rows = samples_of(data_, knots.trial);
    Eigen::VectorXd before(rows), after(rows);
    data_.residual(knots.trial, plain_[k], 1.0, before);
    Eigen::MatrixXd columns(rows, 3 * knots.count);
    for (int c = 0; c < 3 * knots.count; ++c) {
      // Nothing is simulated: what the sensor does, the plant does not feel.
      Prediction moved = plain_[k];
      for (const int m : markers)
        for (std::size_t i = 0; i < time.size(); ++i)
          moved.markers(static_cast<Eigen::Index>(i), 3 * m + c / knots.count) +=
              step * hat(time[i], c % knots.count * knots.interval, knots.interval);
      data_.residual(knots.trial, moved, 1.0, after);
      columns.col(c) = (before - after) / step;
    }
    add(columns, knots, space, coupling);
  }
  finish(space, coupling);
  return space;
}

ForcePath ForceResponses::path(const ForceSpace& space, const Eigen::VectorXd& history) const {
  ForcePath path;
  for (std::size_t k = 0; k < space.knots.size(); ++k) {
    const ForceKnots& knots = space.knots[k];
    const std::vector<double>& time = experiment_.trials[knots.trial].markers.time;
    const Eigen::Index rows = plain_[k].markers.rows();
    const Eigen::VectorXd moved =
        space.motion[k] * history.segment(knots.first, space.motion[k].cols());
    // First the model with the free force, which has no gaps and no noise.
    Eigen::MatrixXd x = plain_[k].markers.middleCols(3 * space.marker, 3) + moved.reshaped(rows, 3);
    const Samples& seen = experiment_.trials[knots.trial].markers;
    // Then what was seen, smoothed over a knot: a law must follow the plant that was there, and not
    // the model of it.
    x += smoothed(seen.value.middleCols(3 * space.marker, 3) - x, time, 0.5 * knots.interval);
    Eigen::MatrixXd position(knots.count, 3), velocity(knots.count, 3);
    for (int i = 0; i < knots.count; ++i) {
      // The last knot may lie after the last sample.
      const double t = std::min(i * knots.interval, time.back());
      const auto next = std::upper_bound(time.begin(), time.end(), t) - time.begin();
      // At the ends the nearest pair, beyond which a line goes on.
      const auto b = std::clamp<std::ptrdiff_t>(next, 1, rows - 1), a = b - 1;
      // Samples need not be even.
      const double share = (t - time[a]) / (time[b] - time[a]);
      position.row(i) = (1.0 - share) * x.row(a) + share * x.row(b);
      const auto from = std::max<std::ptrdiff_t>(0, a - 1),
                 to = std::min<std::ptrdiff_t>(rows - 1, b + 1);
      // Over three samples or more: a difference of neighbours would be noise.
      velocity.row(i) = (x.row(to) - x.row(from)) / (time[to] - time[from]);
    }
    path.position.push_back(std::move(position));
    path.velocity.push_back(std::move(velocity));
  }
  return path;
}

FreeForce free_history(const ForceSpace& space) {
  // Correlation of the coefficients: exponential in time, axes and trials on their own.
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(space.size(), space.size());
  double log_determinant = 0.0;
  for (const ForceKnots& knots : space.knots) {
    Eigen::MatrixXd correlation(knots.count, knots.count);
    for (int i = 0; i < knots.count; ++i)
      for (int j = 0; j < knots.count; ++j)
        // A memory of some tenths of a second: slower than noise, and as fast as the knots can
        // follow.
        correlation(i, j) = std::exp(-std::abs(i - j) * knots.interval / memory);
    // By its root, which gives the inverse and the determinant at once.
    const Eigen::LLT<Eigen::MatrixXd> root(correlation);
    const Eigen::MatrixXd one = root.solve(Eigen::MatrixXd::Identity(knots.count, knots.count));
    const Eigen::MatrixXd l = root.matrixL();
    for (std::size_t a = 0; a < space.axes.size(); ++a) {
      const Eigen::Index at = knots.first + static_cast<int>(a) * knots.count;
      inverse.block(at, at, knots.count, knots.count) = one;
      log_determinant += 2.0 * l.diagonal().array().log().sum();
    }
  }
  // The size at which force and noise weigh the same on average: the search for it begins around
  // there, whatever the plant's stiffness is.
  const double unit = space.size() / std::max(space.normal.trace(), 1.0e-300);  // variance
  FreeForce best;
  // The answer where no size of a force is likelier than none.
  best.value = best.error = Eigen::VectorXd::Zero(space.size());
  // By tens. The evidence is flat about its top, and only its size is asked for.
  for (double factor = 1.0e-3; factor < 1.0e4; factor *= 10.0) {
    const double variance = factor * unit;
    // Of a size that the numbers cannot bear no evidence is told.
    const Eigen::LLT<Eigen::MatrixXd> root(space.normal + inverse / variance);
    if (root.info() != Eigen::Success) continue;
    const Eigen::VectorXd value = root.solve(space.right);
    const Eigen::MatrixXd l = root.matrixL();
    const double evidence = 0.5 * space.right.dot(value) - l.diagonal().array().log().sum() -
                            0.5 * (log_determinant + space.size() * std::log(variance));
    // No force has the evidence 0, so what comes out below it is none.
    if (evidence <= best.evidence) continue;
    best.evidence = evidence;
    best.value = value;
    // Without the prior: what this history explains, to be compared with laws.
    best.gain = space.right.dot(value) - 0.5 * value.dot(space.normal * value);
    // With the prior, which is what keeps a history quiet where no sample tells of it.
    const Eigen::MatrixXd covariance =
        root.solve(Eigen::MatrixXd::Identity(space.size(), space.size()));
    best.error = covariance.diagonal().cwiseSqrt();
  }
  return best;
}

}  // namespace pedicel::discrepancy
