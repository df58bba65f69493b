#include "plugins/discrepancy/test/residual_power.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/FFT>

#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

// What is below is rounding of the derivatives, and no shape.
constexpr double least_shape = 1.0e-8;  // of the largest one's square

/// One trial's markers in a vector over the trials' entries.
/// Markers stand first among a trial's entries, column by column. Forces come after them and are
/// left out: they do not move in shapes.
struct Block {
  int trial = 0;
  Eigen::Index first = 0, rows = 0, channels = 0;
  double duration = 0.0;  // s

  Eigen::Map<const Eigen::MatrixXd> of(const double* entries) const {
    return {entries + first, rows, channels};
  }
};

std::vector<Block> blocks_of(const DataSet& data, std::span<const int> trials) {
  std::vector<Block> blocks;
  Eigen::Index place = 0;
  for (const int t : trials) {
    const Trial& trial = data.experiment().trials[t];
    blocks.push_back(
        {t, place, trial.markers.value.rows(), trial.markers.value.cols(), trial.duration()});
    place += data.size(std::span(&t, 1));
  }
  return blocks;
}

/// Orthonormal columns, the shapes of motion first, then what lies across them.
struct Shapes {
  Eigen::MatrixXd basis;
  int count = 0;  // of motion
};

// What the model's own numbers do to the markers spans how the plant can move. It takes no modes,
// and holds for large bends, too.
Shapes shapes_of(const Eigen::MatrixXd& jacobian, const std::vector<Block>& blocks, int most) {
  const Eigen::Index channels = blocks.front().channels;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(channels, channels);
  for (Eigen::Index p = 0; p < jacobian.cols(); ++p) {
    const double square = jacobian.col(p).squaredNorm();
    if (!(square > 0.0)) continue;
    for (const Block& block : blocks) {
      const auto part = block.of(jacobian.col(p).data());
      // Each derivative counts alike, whatever its unit is.
      covariance += part.transpose() * part / square;
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
  const auto moving =
      (eigen.eigenvalues().array() > least_shape * eigen.eigenvalues()[channels - 1]).count();
  // A third at most: across the shapes enough directions must be left to tell the noise.
  const int count = static_cast<int>(std::min<Eigen::Index>(moving, channels / 3));
  // Eigenvalues come in ascending order, and the largest are wanted first.
  return {eigen.eigenvectors().rowwise().reverse(), std::min(most, count)};
}

/// Power of each column at the frequencies 1/duration, 2/duration, ...: squares of its products
/// with a cosine and a sine of unit length, which are chi-square with two degrees of freedom for
/// noise.
Eigen::MatrixXd periodograms(const Eigen::MatrixXd& series) {
  // Without the mean and without the highest one, which have one degree of freedom in place of two.
  const Eigen::Index n = series.rows(), frequencies = (n - 1) / 2;
  Eigen::MatrixXd power(frequencies, series.cols());
  Eigen::FFT<double> transform;
  Eigen::VectorXcd waves;
  for (Eigen::Index c = 0; c < series.cols(); ++c) {
    const Eigen::VectorXd column = series.col(c);
    transform.fwd(waves, column);
    // So scaled that unit white noise has a mean of 2 at each frequency.
    power.col(c) = waves.segment(1, frequencies).cwiseAbs2() * 2.0 / static_cast<double>(n);
  }
  return power;
}

/// The ratio of two means of squares with n and m degrees of freedom, as a standard normal.
double deviations_of(double ratio, double n, double m) {
  // Wilson and Hilferty: the cube root of a chi-square over its degrees is nearly normal, with mean
  // 1 - 2/(9n) and variance 2/(9n). Far out in the tail, at six deviations, it is still good, where
  // tables of F end.
  const double a = 2.0 / (9.0 * n), b = 2.0 / (9.0 * m), root = std::cbrt(ratio);
  return ((1.0 - b) * root - (1.0 - a)) / std::sqrt(b * root * root + a);
}

/// One trial's power at the frequencies 1/duration, 2/duration, ...
struct Powers {
  Eigen::VectorXd along, across, own;  // of the residual, and along the shapes of our own error
  int shapes = 0, others = 0, trial = 0;
  double duration = 0.0;  // s

  Eigen::Index at(double hz) const {
    // By frequency and not by index: trials of different length have other grids, and are compared
    // in one band.
    return std::clamp<Eigen::Index>(std::lround(hz * duration) - 1, 0, along.size() - 1);
  }
};

/// Of a band of all these trials together.
double deviations(std::span<const Powers> trials, double low_hz, double high_hz,
                  const Accuracy& accuracy) {
  const Eigen::Index neighbourhood = accuracy.power_neighbourhood;
  double along = 0.0, across = 0.0, own = 0.0, n = 0.0, m = 0.0;
  for (const Powers& powers : trials) {
    const Eigen::Index first = powers.at(low_hz), count = powers.at(high_hz) - first + 1;
    // The noise is read around the band, since the whitening may be a little wrong and the level is
    // then another one at other frequencies. In the ratio it cancels.
    const Eigen::Index low = std::max<Eigen::Index>(0, first - neighbourhood);
    const Eigen::Index high =
        std::min<Eigen::Index>(powers.across.size(), first + count + neighbourhood);
    along += powers.along.segment(first, count).sum();
    own += powers.own.segment(first, count).sum();
    across += powers.across.segment(low, high - low).sum();
    n += 2.0 * powers.shapes * static_cast<double>(count);
    m += 2.0 * powers.others * static_cast<double>(high - low);
  }
  // Amplitudes, as our own error may be in phase with what is there, and then adds as it is and not
  // in squares.
  const double found = std::sqrt(along) - accuracy.own_amplitude * std::sqrt(own);
  if (found <= 0.0 || !(across > 0.0)) return 0.0;
  return deviations_of(found * found / n / (across / m), n, m);
}

Powers powers_of(const Block& block, const Shapes& shapes, const Eigen::VectorXd& residual,
                 const Eigen::VectorXd& numerical) {
  Powers powers;
  powers.trial = block.trial;
  powers.duration = block.duration;
  powers.shapes = shapes.count;
  powers.others = static_cast<int>(block.channels) - shapes.count;
  const Eigen::MatrixXd power = periodograms(block.of(residual.data()) * shapes.basis);
  powers.along = power.leftCols(shapes.count).rowwise().sum();
  powers.across = power.rightCols(powers.others).rowwise().sum();
  powers.own = Eigen::VectorXd::Zero(power.rows());
  if (numerical.size() == residual.size())
    powers.own = periodograms(block.of(numerical.data()) * shapes.basis.leftCols(shapes.count))
                     .rowwise()
                     .sum();
  return powers;
}

}  // namespace

std::string ResidualPower::frequency() const {
  return low_hz == high_hz ? text(" at %.3g Hz", low_hz)
                           : text(" at %.3g to %.3g Hz", low_hz, high_hz);
}

ResidualPower residual_power(const DataSet& data, std::span<const int> trials,
                             const FitSummary& model, const Eigen::VectorXd& numerical,
                             const DiagnosisSettings& settings) {
  const Accuracy& accuracy = settings.accuracy;
  ResidualPower strongest;
  strongest.level = settings.levels.residual_power;
  const std::vector<Block> blocks = blocks_of(data, trials);
  if (blocks.empty() || model.jacobian.rows() != model.residual.size()) return strongest;
  const Eigen::Index channels = blocks.front().channels;
  const bool same =
      std::ranges::all_of(blocks, [&](const Block& block) { return block.channels == channels; });
  // Trials with other markers have other shapes.
  if (channels < 3 || !same) return strongest;
  // An outlier has power at all frequencies.
  const double limit = settings.levels.winsorised_at;
  const Eigen::VectorXd residual = model.residual.cwiseMax(-limit).cwiseMin(limit);
  const Shapes shapes = shapes_of(model.jacobian, blocks, accuracy.motion_shapes);
  if (shapes.count < 1) return strongest;
  std::vector<Powers> all;
  // Shorter, the neighbourhood would be the whole spectrum.
  for (const Block& block : blocks)
    if (block.rows >= 4 * accuracy.power_neighbourhood)
      all.push_back(powers_of(block, shapes, residual, numerical));
  const auto look_at = [&](std::span<const Powers> some) {
    // Bands are laid on the finest grid.
    const Powers& longest = *std::ranges::max_element(
        some, {}, [](const Powers& powers) { return powers.along.size(); });
    const auto look = [&](Eigen::Index first, Eigen::Index count) {
      const double low = static_cast<double>(first + 1) / longest.duration;
      const double high = static_cast<double>(first + count) / longest.duration;
      const double found = deviations(some, low, high, accuracy);
      if (found > strongest.deviations)
        strongest = {found, settings.levels.residual_power, longest.trial, some.size() > 1, low,
                     high};
    };
    const Eigen::Index frequencies = longest.along.size();
    // Single frequencies for what swings, octaves for what is spread. Overlapping bands find the
    // same thing twice, which costs nothing: the level is far beyond their number.
    for (Eigen::Index f = 0; f < frequencies; ++f) look(f, 1);
    for (Eigen::Index width = 2; width <= frequencies; width *= 2) {
      look(0, width);
      if (2 * width <= frequencies) look(width, width);
    }
  };
  for (const Powers& powers : all) look_at({&powers, 1});
  // What acts in every trial, as a thing that was forgotten does, is more significant in all
  // together.
  if (all.size() > 1) look_at(all);
  return strongest;
}

}  // namespace pedicel::discrepancy
