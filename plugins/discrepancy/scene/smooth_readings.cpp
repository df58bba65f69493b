#include "plugins/discrepancy/scene/smooth_readings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pedicel::discrepancy {

namespace {

constexpr double smallest_deviation = 1.0e-9;  // rad: readings without noise
constexpr double vague_position = 10.0, vague_speed = 1.0, vague_acceleration = 10.0;  // rad, s
constexpr double window = 0.08;  // s, to either side, in which the jerk is alike
/// Powers of ten, 1/s5: from what wanders in a second to nearly interpolation.
constexpr double least_log_jerk = -1.0, most_log_jerk = 14.0;
constexpr double clearly = 1.0;  // nats
/// x, x', x''.
struct Filtered {
  Vec3 ahead, mean;           // before and after the reading
  Mat3 ahead_spread, spread;  // their covariances
};

Mat3 transition(double h) {
  Mat3 f;
  f << 1, h, 0.5 * h * h, 0, 1, h, 0, 0, 1;
  return f;
}

// Of white jerk with density 1.
Mat3 wander(double h) {
  const double h2 = h * h, h3 = h2 * h, h4 = h3 * h, h5 = h4 * h;
  Mat3 q;
  q << h5 / 20, h4 / 8, h3 / 6, h4 / 8, h3 / 3, h2 / 2, h3 / 6, h2 / 2, h;
  return q;
}

/// One pass of the filter over readings `y` of noise `deviation`: what it held at each row, and the
/// log likelihood of each reading. `jerk`: of the step that ends at a row, its density over the
/// noise's variance, 1/s5.
struct Pass {
  std::vector<Filtered> rows;
  std::vector<double> likelihood;
};

Pass filter(const std::vector<double>& time, const Eigen::VectorXd& y, double deviation,
            const std::vector<double>& jerk) {
  const double r = deviation * deviation;
  const std::size_t n = time.size();
  Pass pass{std::vector<Filtered>(n), std::vector<double>(n, 0.0)};
  Vec3 m = Vec3::Zero();
  // Nothing is known before the first reading.
  Mat3 p = Vec3(vague_position, vague_speed, vague_acceleration).cwiseAbs2().asDiagonal();
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) {
      const double h = time[i] - time[i - 1];
      const Mat3 f = transition(h);
      m = f * m;
      p = f * p * f.transpose() + jerk[i] * r * wander(h);
    }
    Filtered& row = pass.rows[i];
    row.ahead = m;
    row.ahead_spread = p;
    if (const double reading = y[static_cast<long>(i)]; std::isfinite(reading)) {
      const double s = p(0, 0) + r, e = reading - m[0];
      const Vec3 gain = p.col(0) / s;
      m += gain * e;
      // Joseph's form: positive whatever is rounded.
      Mat3 keep = Mat3::Identity();
      keep.col(0) -= gain;
      p = keep * p * keep.transpose() + r * gain * gain.transpose();
      pass.likelihood[i] = -0.5 * (std::log(s) + e * e / s);
    }
    row.mean = m;
    row.spread = p;
  }
  return pass;
}

/// By row, the log likelihood of the readings around it.
std::vector<double> around(const std::vector<double>& time, const std::vector<double>& likelihood) {
  const std::size_t n = time.size();
  std::vector<double> sum(n + 1, 0.0), out(n);
  for (std::size_t i = 0; i < n; ++i) sum[i + 1] = sum[i] + likelihood[i];
  std::size_t first = 0, last = 0;
  for (std::size_t i = 0; i < n; ++i) {
    while (time[first] < time[i] - window) ++first;
    while (last < n && time[last] <= time[i] + window) ++last;
    out[i] = sum[last] - sum[first];
  }
  return out;
}

/// By row, the density of the jerk under which the readings around it are likeliest. An arm rests
/// and moves in turn, and what is right for one is wrong for the other.
std::vector<double> local_jerk(const std::vector<double>& time, const Eigen::VectorXd& y,
                               double deviation) {
  const std::size_t n = time.size();
  std::vector<double> best(n, -std::numeric_limits<double>::infinity()), jerk(n, 0.0);
  for (double log_jerk = least_log_jerk; log_jerk <= most_log_jerk; log_jerk += 1.0) {
    const std::vector<double> even(n, std::pow(10.0, log_jerk));
    const std::vector<double> here = around(time, filter(time, y, deviation, even).likelihood);
    for (std::size_t i = 0; i < n; ++i)
      // The stiffest that does nearly as well.
      if (here[i] > best[i] + clearly) {
        best[i] = here[i];
        jerk[i] = even[i];
      }
  }
  return jerk;
}

// Forwards a stiff filter takes long to come to rest after a move, and backwards before one.
std::vector<double> choose_jerk(const std::vector<double>& time, const Eigen::VectorXd& y,
                                double deviation) {
  const std::size_t n = time.size();
  std::vector<double> forwards = local_jerk(time, y, deviation), turned(n);
  for (std::size_t i = 0; i < n; ++i) turned[i] = time.back() - time[n - 1 - i];
  const std::vector<double> backwards = local_jerk(turned, y.reverse(), deviation);
  std::vector<double> jerk(n);
  for (std::size_t i = 0; i < n; ++i) jerk[i] = std::min(forwards[i], backwards[n - 1 - i]);
  // Of the step that ends at a row.
  for (std::size_t i = n; i-- > 1;) jerk[i] = std::max(jerk[i], jerk[i - 1]);
  return jerk;
}

// Of white noise on something smooth: third differences have 20 variances.
double scatter_of(const Eigen::VectorXd& y) {
  std::vector<double> squares;
  for (long i = 0; i + 3 < y.size(); ++i) {
    const double d = y[i + 3] - 3.0 * y[i + 2] + 3.0 * y[i + 1] - y[i];
    if (std::isfinite(d)) squares.push_back(d * d / 20.0);
  }
  if (squares.empty()) return smallest_deviation;
  const auto middle = squares.begin() + static_cast<long>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  // The median of a squared normal number is 0.455 of its mean.
  return std::max(std::sqrt(*middle / 0.455), smallest_deviation);
}

}  // namespace

JointPath smooth_readings(const Samples& readings, double deviation) {
  JointPath path;
  const long rows = readings.size(), columns = readings.value.cols();
  path.time_ = readings.time;
  path.q_.setZero(rows, columns);
  path.qd_.setZero(rows, columns);
  path.qdd_.setZero(rows, columns);
  path.scatter_.setZero(columns);
  for (long c = 0; c < columns && rows > 0; ++c) {
    const Eigen::VectorXd y = readings.value.col(c);
    const double noise = deviation > 0.0 ? deviation : scatter_of(y);
    const std::vector<Filtered> pass =
        filter(path.time_, y, noise, choose_jerk(path.time_, y, noise)).rows;
    Vec3 m = pass.back().mean;
    double square = 0.0;
    int count = 0;
    for (long i = rows - 1; i >= 0; --i) {
      const auto s = static_cast<std::size_t>(i);
      if (i + 1 < rows) {
        const Mat3 f = transition(path.time_[s + 1] - path.time_[s]);
        const Mat3 gain = pass[s + 1].ahead_spread.ldlt().solve(f * pass[s].spread).transpose();
        m = pass[s].mean + gain * (m - pass[s + 1].ahead);
      }
      path.q_(i, c) = m[0];
      path.qd_(i, c) = m[1];
      path.qdd_(i, c) = m[2];
      if (std::isfinite(y[i])) {
        square += (y[i] - m[0]) * (y[i] - m[0]);
        ++count;
      }
    }
    path.scatter_[c] = count > 0 ? std::sqrt(square / count) : 0.0;
  }
  return path;
}

JointPath JointPath::spread(const std::vector<int>& columns, const Eigen::VectorXd& start) const {
  JointPath all;
  all.time_ = time_;
  all.q_.setZero(q_.rows(), start.size());
  all.q_.rowwise() = start.transpose();
  all.qd_.setZero(q_.rows(), start.size());
  all.qdd_ = all.qd_;
  all.scatter_.setZero(start.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto c = static_cast<long>(i);
    all.q_.col(columns[i]) = q_.col(c);
    all.qd_.col(columns[i]) = qd_.col(c);
    all.qdd_.col(columns[i]) = qdd_.col(c);
    all.scatter_[columns[i]] = scatter_[c];
  }
  return all;
}

JointPath JointPath::through(std::vector<double> time,
                             const std::vector<Eigen::VectorXd>& positions,
                             const std::vector<Eigen::VectorXd>& velocities) {
  JointPath path;
  path.time_ = std::move(time);
  const long rows = static_cast<long>(path.time_.size());
  const long columns = rows > 0 ? positions.front().size() : 0;
  path.q_.resize(rows, columns);
  path.qd_.resize(rows, columns);
  path.qdd_.setZero(rows, columns);
  path.scatter_.setZero(columns);
  for (long r = 0; r < rows; ++r) {
    path.q_.row(r) = positions[static_cast<std::size_t>(r)].transpose();
    path.qd_.row(r) = velocities[static_cast<std::size_t>(r)].transpose();
  }
  for (long r = 1; r + 1 < rows; ++r) {
    const auto s = static_cast<std::size_t>(r);
    path.qdd_.row(r) =
        (path.qd_.row(r + 1) - path.qd_.row(r - 1)) / (path.time_[s + 1] - path.time_[s - 1]);
  }
  return path;
}

JointPath::Local JointPath::find(double t) const {
  Local at;
  if (time_.empty()) return at;
  if (t <= time_.front()) {
    at.rests = t < time_.front();
    return at;
  }
  if (t >= time_.back()) {
    at.row = static_cast<int>(time_.size()) - 1;
    at.rests = t > time_.back();
    return at;
  }
  const auto next = std::upper_bound(time_.begin(), time_.end(), t);
  at.row = static_cast<int>(next - time_.begin()) - 1;
  at.h = *next - time_[at.row];
  at.u = (t - time_[at.row]) / at.h;
  return at;
}

void JointPath::sample(double t, Eigen::VectorXd& q) const {
  const Local at = find(t);
  if (at.h == 0.0) {
    q = q_.row(at.row).transpose();
    return;
  }
  const double u = at.u, u3 = u * u * u, h = at.h;
  const double w = u3 * (10 + u * (-15 + 6 * u));
  const double v0 = u + u3 * (-6 + u * (8 - 3 * u)), v1 = u3 * (-4 + u * (7 - 3 * u));
  const double a0 = 0.5 * u * u * (1 + u * (-3 + u * (3 - u))), a1 = 0.5 * u3 * (1 + u * (-2 + u));
  q = ((1 - w) * q_.row(at.row) + w * q_.row(at.row + 1) +
       h * (v0 * qd_.row(at.row) + v1 * qd_.row(at.row + 1)) +
       h * h * (a0 * qdd_.row(at.row) + a1 * qdd_.row(at.row + 1)))
          .transpose();
}

JointPath::Point JointPath::at(double t) const {
  const Local at = find(t);
  Point point;
  if (at.h == 0.0) {
    point.q = q_.row(at.row).transpose();
    point.qd = qd_.row(at.row).transpose();
    point.qdd = qdd_.row(at.row).transpose();
    if (at.rests) {
      point.qd.setZero();
      point.qdd.setZero();
    }
    return point;
  }
  sample(t, point.q);
  const double u = at.u, u2 = u * u, h = at.h;
  const auto rows = [&](const Eigen::MatrixXd& m) {
    return std::pair(m.row(at.row), m.row(at.row + 1));
  };
  const auto [p0, p1] = rows(q_);
  const auto [v0, v1] = rows(qd_);
  const auto [a0, a1] = rows(qdd_);
  const double w1 = 30 * u2 * (1 + u * (-2 + u));
  const double v01 = 1 + u2 * (-18 + u * (32 - 15 * u)), v11 = u2 * (-12 + u * (28 - 15 * u));
  const double a01 = u * (1 + u * (-4.5 + u * (6 - 2.5 * u)));
  const double a11 = u2 * (1.5 + u * (-4 + 2.5 * u));
  point.qd = (w1 / h * (p1 - p0) + v01 * v0 + v11 * v1 + h * (a01 * a0 + a11 * a1)).transpose();
  const double w2 = 60 * u * (1 + u * (-3 + 2 * u));
  const double v02 = u * (-36 + u * (96 - 60 * u)), v12 = u * (-24 + u * (84 - 60 * u));
  const double a02 = 1 + u * (-9 + u * (18 - 10 * u)), a12 = u * (3 + u * (-12 + 10 * u));
  point.qdd =
      (w2 / (h * h) * (p1 - p0) + (v02 * v0 + v12 * v1) / h + a02 * a0 + a12 * a1).transpose();
  return point;
}

}  // namespace pedicel::discrepancy
