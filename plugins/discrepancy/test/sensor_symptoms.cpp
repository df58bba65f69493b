#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/discrepancy/test/symptom_parts.h"

namespace pedicel::discrepancy {

namespace {

/// RMS of a marker's whitened residual over all trials.
/// Whitened, since noise with a memory has few independent samples, and its RMS would scatter far
/// more than its number says.
struct Channel {
  double squares = 0.0;
  int samples = 0;
  double rms() const { return samples > 0 ? std::sqrt(squares / samples) : 0.0; }
};

Channel channel_of(const SymptomContext& context, int marker) {
  Channel channel;
  for (int t = 0; t < context.trials(); ++t) {
    if (!context.usable(t)) continue;
    for (int i = 0; i < 3; ++i)
      for (const double w :
           whiten(context.residual(t, 3 * marker + i), context.data.position_noise()))
        if (std::isfinite(w)) channel.squares += w * w, ++channel.samples;
  }
  return channel;
}

// The strongest marker against the next one: errors of the plant grow smoothly along it, errors of
// one marker do not.
void add_bad_channel(const SymptomContext& context, std::vector<Symptom>& out) {
  std::vector<std::pair<Channel, int>> channels;
  for (int m = 0; m < context.markers(); ++m) {
    const Channel channel = channel_of(context, m);
    // Of fewer the RMS itself is off by more than a tenth.
    if (channel.samples > 30) channels.emplace_back(channel, m);
  }
  // With two markers there is no saying which of them is the odd one.
  if (channels.size() < 3) return;
  std::ranges::sort(channels,
                    [](const auto& a, const auto& b) { return a.first.rms() > b.first.rms(); });
  const auto& [strongest, marker] = channels[0];
  // The whitened RMS of noise alone is 1, and the largest of some markers a little more.
  if (strongest.rms() < 1.2) return;  // all noise
  // The next largest, and not the mean: a plant that is wrong has several large ones at its tip,
  // and none of them stands out.
  const Channel& next = channels[1].first;
  const double ratio = strongest.rms() / std::max(next.rms(), 1e-12);
  const std::string& name = context.experiment.markers[marker].name;
  // An RMS of n normal numbers scatters by its 1 / sqrt(2n)th part.
  Symptom symptom = make_symptom("bad_channel", name, ratio - 1.0,
                                 ratio * std::sqrt(0.5 / strongest.samples + 0.5 / next.samples));
  symptom.unit = "1";
  // Neighbours along a stem that bends may differ by half and more without any fault.
  symptom.least = 0.7;
  symptom.sentence = "The residual of " + name + " is " + short_number(ratio) +
                     " times that of the next largest marker, " +
                     context.experiment.markers[channels[1].second].name + ".";
  out.push_back(std::move(symptom));
}

void add_offsets(const SymptomContext& context, std::vector<Symptom>& out) {
  for (int m = 0; m < context.markers(); ++m) {
    Eigen::Vector3d offset, error;
    bool known = true;
    // Each coordinate by itself, over all trials together. An offset that turns with the stem is
    // then blurred, but a wrong place is seen in every pose.
    for (int i = 0; i < 3 && known; ++i) {
      Projection constant(1);
      for (int t = 0; t < context.trials(); ++t)
        if (context.usable(t)) {
          const Series r = context.residual(t, 3 * m + i);
          // Whitened, so that a long swing that the model does not have counts as few samples.
          constant.add(r, Eigen::MatrixXd::Ones(r.size(), 1), context.data.position_noise());
        }
      Projection::Result result;
      known = constant.solve(result);
      if (!known) break;
      offset[i] = result.value[0];
      error[i] = result.component(0).error;
    }
    if (!known) continue;
    const Measured size = length_of(offset, error);
    const std::string& name = context.experiment.markers[m].name;
    Symptom symptom = make_symptom("constant_offset", name, 1e3 * size.value, 1e3 * size.error);
    symptom.unit = "mm";
    // Half of a sample's noise, in mm. Of a long record much less is significant, and is what any
    // model is off by.
    symptom.least = 0.5e3 * context.data.position_noise().std;
    symptom.sentence = name + " stands on average over all trials " +
                       with_error(symptom.value, symptom.standard_error, "mm") +
                       " from where the model has it (" + short_number(1e3 * offset.x()) + ", " +
                       short_number(1e3 * offset.y()) + ", " + short_number(1e3 * offset.z()) +
                       " mm).";
    out.push_back(std::move(symptom));
  }
}

// Chords between neighbouring markers of a chain, summed: their relative change is the scale,
// whatever the plant does, because it bends and hardly stretches. The series is divided by the
// length of its gradient, so that its noise is that of one coordinate.
// Summed and not one by one: where a marker sits on the stem is known less well than how far the
// first is from the last.
void add_chords(const SymptomContext& context, const MarkerChain& chain, int t,
                Projection& projection) {
  const Eigen::MatrixXd& measured = context.trial(t).markers.value;
  const Eigen::MatrixXd& predicted = context.predictions[t].markers;
  const Eigen::Index n = measured.rows();
  Series difference = Series::Zero(n);
  Eigen::MatrixXd length = Eigen::MatrixXd::Zero(n, 1);
  const std::size_t count = chain.markers.size();
  const double variance = std::pow(context.data.position_noise().std, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    std::vector<Vec3> gradient(count, Vec3::Zero());
    for (std::size_t k = 0; k + 1 < count; ++k) {
      const int a = 3 * chain.markers[k], b = 3 * chain.markers[k + 1];
      // A gap in either marker makes all of the sum NaN, which the projection takes for one.
      const Vec3 m = (measured.row(i).segment<3>(b) - measured.row(i).segment<3>(a)).transpose();
      const Vec3 p = (predicted.row(i).segment<3>(b) - predicted.row(i).segment<3>(a)).transpose();
      // Noise across a chord makes it longer: 2 variances in each of two directions, halved.
      // To second order a chord of length l with noise s across it is longer by s^2 / l for each of
      // its two directions.
      difference[i] += m.norm() - p.norm() - 2.0 * variance / p.norm();
      length(i, 0) += p.norm();
      // How the sum of lengths answers to each marker. Markers in the middle of a straight stretch
      // cancel: moving them makes one chord longer by what the other loses.
      gradient[k] -= p.normalized();
      gradient[k + 1] += p.normalized();
    }
    double squares = 0.0;
    for (const Vec3& g : gradient) squares += g.squaredNorm();
    // The gradient turns slowly with the plant, so the noise keeps its colour in time.
    difference[i] /= std::sqrt(squares);
    length(i, 0) /= std::sqrt(squares);
  }
  projection.add(difference, length, context.data.position_noise());
}

void add_scale(const SymptomContext& context, std::vector<Symptom>& out) {
  Projection projection(1);
  for (const MarkerChain& chain : context.chains) {
    // One marker has no chord.
    if (chain.markers.size() < 2) continue;
    for (int t = 0; t < context.trials(); ++t)
      if (context.usable(t)) add_chords(context, chain, t, projection);
  }
  Projection::Result result;
  if (!projection.solve(result)) return;
  const Measured scale = result.component(0);
  Symptom symptom = make_symptom("length_scale", "", 100.0 * scale.value, 100.0 * scale.error);
  symptom.unit = "%";
  // In per cent: half a millimetre in a metre.
  symptom.least = 0.05;
  symptom.sentence = "Lengths between neighbouring markers are " +
                     with_error(symptom.value, symptom.standard_error, "%") +
                     " longer than on the model's plant, which cannot stretch so far.";
  out.push_back(std::move(symptom));
}

}  // namespace

void add_sensor_symptoms(const SymptomContext& context, std::vector<Symptom>& out) {
  add_bad_channel(context, out);
  add_offsets(context, out);
  add_scale(context, out);
}

}  // namespace pedicel::discrepancy
