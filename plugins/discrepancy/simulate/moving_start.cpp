#include "plugins/discrepancy/simulate/moving_start.h"

#include <cmath>
#include <complex>

#include "plugins/cosserat/model/rotation.h"

namespace pedicel::discrepancy {

namespace {

constexpr double usual_reach = 3.0;  // times the motion that was seen, of a mode beforehand

/// A mode's answer at t, to being let go 1 m out, and to the speed w times 1 m.
struct Swing {
  double out = 0.0, speed = 0.0;
};

Swing swing_of(double frequency, double decay, double t) {
  const std::complex<double> beat =
      std::sqrt(std::complex<double>(decay * decay - frequency * frequency, 1.0e-12));
  const double late = std::exp(-decay * t);
  const std::complex<double> sine = std::sinh(beat * t) / beat;
  return {late * (std::cosh(beat * t) + decay * sine).real(), late * frequency * sine.real()};
}

// As a place on the element goes along with its nodes.
Vec3 along_at(const cosserat::RodModel& model, const Eigen::VectorXd& shape,
              const plant::PlacedPoint& at) {
  const cosserat::Element& element = model.elements[at.element];
  const double t = at.back / element.length;
  const Vec3 near = element.parent < 0 ? Vec3(0, 0, 0) : Vec3(shape.segment<3>(6 * element.parent));
  return (1.0 - t) * shape.segment<3>(6 * at.element) + t * near;
}

}  // namespace

double likely_amplitude(const StartPlan& plan, const Modes& modes, int mode) {
  return usual_reach * plan.motion * modes.frequency[0] / modes.frequency[mode];
}

MovingStart::MovingStart(const cosserat::RodModel& model, const cosserat::RodState& at_rest,
                         Modes modes, Eigen::VectorXd led)
    : model_(&model), at_rest_(at_rest), modes_(std::move(modes)), led_(std::move(led)) {}

// Each segment is turned as the vector says, and carries on from where its parent then ends; what
// the vector stretches it by comes on top.
cosserat::RodState MovingStart::displaced(const Eigen::VectorXd& along) const {
  cosserat::RodState moved = at_rest_;
  for (int e = 0; e < model_->size(); ++e) {
    const int parent = model_->elements[e].parent;
    const Vec3 start = cosserat::start_of(*model_, at_rest_, e);
    const Vec3 turn = along.segment<3>(6 * e + 3);
    const Vec3 near = parent < 0 ? Vec3(0, 0, 0) : Vec3(along.segment<3>(6 * parent));
    const Vec3 arm = at_rest_.position[e] - start;
    const Vec3 stretch = Vec3(along.segment<3>(6 * e)) - near - turn.cross(arm);
    const Quat rotation = cosserat::exp_map(turn);
    moved.orientation[e] = (rotation * at_rest_.orientation[e]).normalized();
    moved.position[e] = cosserat::start_of(*model_, moved, e) + rotation * Vec3(arm + stretch);
  }
  return moved;
}

cosserat::RodState MovingStart::state(const Eigen::VectorXd& amplitudes) const {
  const int count = modes_.size();
  const Eigen::VectorXd out = modes_.shape * amplitudes.head(count);
  const Eigen::VectorXd speed =
      modes_.shape * amplitudes.tail(count).cwiseProduct(modes_.frequency) + led_;
  cosserat::RodState state = displaced(out);
  // By differences along the way that it goes, so that velocities fit the bent shape.
  constexpr double little = 1.0e-6;  // s
  const cosserat::RodState after = displaced(out + little * speed);
  const cosserat::RodState before = displaced(out - little * speed);
  const auto centre = [&](const cosserat::RodState& s, int e) -> Vec3 {
    return s.position[e] - model_->elements[e].com_back * (s.orientation[e] * Vec3::UnitZ());
  };
  for (int e = 0; e < model_->size(); ++e) {
    state.velocity[e] = (centre(after, e) - centre(before, e)) / (2.0 * little);
    const Quat turned = before.orientation[e].conjugate() * after.orientation[e];
    state.angular_velocity[e] = cosserat::log_map(turned) / (2.0 * little);
  }
  state.previous_dt = 0.0;
  return state;
}

Eigen::MatrixXd marker_swings(const cosserat::RodModel& model, const Modes& modes,
                              std::span<const plant::PlacedPoint> markers,
                              std::span<const double> time) {
  const int count = modes.size();
  const auto channels = static_cast<Eigen::Index>(3 * markers.size());
  Eigen::MatrixXd swings(static_cast<Eigen::Index>(time.size()) * channels, 2 * count);
  for (int k = 0; k < count; ++k) {
    Eigen::VectorXd shape(channels);
    for (std::size_t m = 0; m < markers.size(); ++m)
      shape.segment<3>(3 * static_cast<Eigen::Index>(m)) =
          along_at(model, modes.shape.col(k), markers[m]);
    for (std::size_t s = 0; s < time.size(); ++s) {
      const Swing swing = swing_of(modes.frequency[k], modes.decay[k], time[s]);
      const Eigen::Index row = static_cast<Eigen::Index>(s) * channels;
      swings.col(k).segment(row, channels) = swing.out * shape;
      swings.col(count + k).segment(row, channels) = swing.speed * shape;
    }
  }
  return swings;
}

Eigen::VectorXd amplitude_step(const StartPlan& plan, const Modes& modes,
                               const Eigen::MatrixXd& swings, const Eigen::VectorXd& residual,
                               const Eigen::VectorXd& amplitudes) {
  const Eigen::Index rows = swings.rows(), count = swings.cols();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(rows + count, count);
  Eigen::VectorXd wanted = Eigen::VectorXd::Zero(rows + count);
  for (Eigen::Index r = 0; r < rows; ++r) {
    if (!std::isfinite(residual[r])) continue;
    system.row(r) = swings.row(r);
    wanted[r] = residual[r];
  }
  for (Eigen::Index c = 0; c < count; ++c) {
    const int mode = static_cast<int>(c) % modes.size();
    const double weight = plan.noise / likely_amplitude(plan, modes, mode);
    system(rows + c, c) = weight;
    wanted[rows + c] = -weight * amplitudes[c];
  }
  return system.colPivHouseholderQr().solve(wanted);
}

}  // namespace pedicel::discrepancy
