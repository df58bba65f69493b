#include "plugins/discrepancy/simulate/noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pedicel::discrepancy {

namespace {

constexpr int most_lags = 6;
constexpr int window_size = 100;  // samples; long against the memory of a sensor
constexpr int least_window = 16;
constexpr double most_share = 1.2;  // of a stated deviation, that an estimate may be

// A stretch without gaps.
struct Window {
  const Series* series = nullptr;
  int begin = 0, end = 0;
  double scatter = 0.0;  // half the mean square difference of samples half a window apart
};

// Sum of squared differences `lag` apart, and how many.
std::pair<double, int> differences(const Window& window, int lag) {
  double sum = 0.0;
  int count = 0;
  for (int i = window.begin + lag; i < window.end; ++i, ++count) {
    const double d = (*window.series)[i] - (*window.series)[i - lag];
    sum += d * d;
  }
  return {sum, count};
}

double plateau(const Window& window) {
  double sum = 0.0;
  int count = 0;
  const int length = window.end - window.begin;
  for (int lag = length / 4; lag <= length / 2; lag += std::max(1, length / 16)) {
    const auto [squares, pairs] = differences(window, lag);
    sum += squares;
    count += pairs;
  }
  return count > 0 ? 0.5 * sum / count : 0.0;
}

void cut(const Series& series, int begin, int end, std::vector<Window>& windows) {
  const int pieces = std::max(1, (end - begin) / window_size);
  for (int i = 0; i < pieces; ++i) {
    Window window{&series, begin + (end - begin) * i / pieces,
                  begin + (end - begin) * (i + 1) / pieces};
    if (window.end - window.begin < least_window) continue;
    window.scatter = plateau(window);
    // A channel that does not change at all is stuck or made of constants, not still.
    if (window.scatter > 0.0) windows.push_back(window);
  }
}

std::vector<Window> windows_of(std::span<const Series> channels) {
  std::vector<Window> windows;
  for (const Series& series : channels) {
    int begin = 0;
    for (int i = 0; i <= series.size(); ++i) {
      if (i < series.size() && std::isfinite(series[i])) continue;
      cut(series, begin, i, windows);
      begin = i + 1;
    }
  }
  return windows;
}

// Motion only adds to the scatter, so the still windows are those near the lower end; a few times
// its level leaves room for the scatter of coloured noise itself.
void keep_still(std::vector<Window>& windows) {
  std::vector<double> scatter;
  for (const Window& window : windows) scatter.push_back(window.scatter);
  const auto quarter = scatter.begin() + static_cast<std::ptrdiff_t>(scatter.size() / 4);
  std::nth_element(scatter.begin(), quarter, scatter.end());
  const double most = 3.0 * *quarter;
  std::erase_if(windows, [&](const Window& window) { return window.scatter > most; });
}

}  // namespace

Noise white_noise(double std) {
  Noise noise;
  noise.std = std;
  noise.innovation = {std};
  return noise;
}

Noise autoregressive(std::span<const double> covariance, double samples) {
  Noise best = white_noise(std::sqrt(covariance[0]));
  Noise noise = best;
  double variance = covariance[0];
  double best_score = samples * std::log(variance);
  std::vector<double> weights;
  for (int order = 1; order < static_cast<int>(covariance.size()); ++order) {
    double sum = covariance[order];
    for (int k = 0; k < order - 1; ++k) sum -= weights[k] * covariance[order - 1 - k];
    const double reflection = sum / variance;
    if (!(std::abs(reflection) < 0.9999)) break;
    std::vector<double> next(order);
    for (int k = 0; k < order - 1; ++k) next[k] = weights[k] - reflection * weights[order - 2 - k];
    next[order - 1] = reflection;
    weights = next;
    variance *= 1.0 - reflection * reflection;
    noise.weights.push_back(weights);
    noise.innovation.push_back(std::sqrt(variance));
    const double score = samples * std::log(variance) + order * std::log(std::max(samples, 2.0));
    if (score < best_score) {
      best_score = score;
      best = noise;
    }
  }
  return best;
}

Noise estimate_noise(std::span<const Series> channels, double stated_std) {
  std::vector<Window> windows = windows_of(channels);
  const Noise otherwise = white_noise(stated_std > 0.0 ? stated_std : 1.0);
  if (windows.empty()) return otherwise;
  keep_still(windows);
  double level = 0.0, samples = 0.0;
  for (const Window& window : windows) {
    const double size = window.end - window.begin;
    level += window.scatter * size;
    samples += size;
  }
  level /= samples;
  std::vector<double> semivariance;
  for (int lag = 1; lag <= most_lags; ++lag) {
    double sum = 0.0;
    int count = 0;
    for (const Window& window : windows) {
      const auto [squares, pairs] = differences(window, lag);
      sum += squares;
      count += pairs;
    }
    semivariance.push_back(0.5 * sum / count);
  }
  // A slow misfit raises the plateau and would pass for a long memory, which then hides it. A
  // plateau below what is stated stays: raised by itself it would pass for a memory, too.
  if (stated_std > 0.0)
    level =
        std::min(level, std::max(stated_std * stated_std, *std::ranges::max_element(semivariance)));
  std::vector<double> covariance{level};
  for (const double value : semivariance) covariance.push_back(level - value);
  return autoregressive(covariance, samples);
}

Noise choose_noise(std::span<const Series> channels, double stated_std, const NoiseRule& rule) {
  Noise noise = estimate_noise(channels, stated_std);
  if (!(stated_std > 0.0)) return noise;
  const bool small = noise.std < rule.least_share * stated_std;
  if (small && !rule.keep_colour) return white_noise(stated_std);
  if (!small && noise.std <= most_share * stated_std) return noise;
  const double share = stated_std / noise.std;
  noise.std = stated_std;
  for (double& innovation : noise.innovation) innovation *= share;
  return noise;
}

Eigen::VectorXd whiten(const Series& residual, const Noise& noise) {
  Eigen::VectorXd white(residual.size());
  int history = 0;  // finite samples right before this one
  for (int i = 0; i < residual.size(); ++i) {
    if (!std::isfinite(residual[i])) {
      white[i] = std::numeric_limits<double>::quiet_NaN();
      history = 0;
      continue;
    }
    const int order = std::min(history, noise.order());
    double value = residual[i];
    for (int k = 0; k < order; ++k) value -= noise.weights[order - 1][k] * residual[i - 1 - k];
    white[i] = value / noise.innovation[order];
    ++history;
  }
  return white;
}

}  // namespace pedicel::discrepancy
