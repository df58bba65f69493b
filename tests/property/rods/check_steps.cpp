#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/cosserat/lanes/lane_kernels.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "tests/property/rods/garden_check.h"
#include "tests/property/rods/plain_step.h"

namespace pedicel::plain {

using cosserat::RodModel;
using cosserat::RodState;

namespace {

constexpr double rounding = std::numeric_limits<double>::epsilon();
constexpr int small = 300;  // elements: the plain solver takes its own steps, too

double largest_of(const std::vector<Six>& change) {
  double largest = 0.0;
  for (const Six& one : change) largest = std::max(largest, one.cwiseAbs().maxCoeff());
  return largest;
}

double distance(const Place& a, const Place& b) {
  double largest = 0.0;
  for (std::size_t e = 0; e < a.position.size(); ++e)
    largest = std::max({largest, (a.position[e] - b.position[e]).cwiseAbs().maxCoeff(),
                        a.orientation[e].angularDistance(b.orientation[e])});
  return largest;
}

// What rounding the places of the elements makes of Newton's change: the solution for a right side
// that is off by as much, with signs at random.
double rounding_of(System system, const Place& place) {
  std::vector<Six> errors;
  for (const Vec3& position : place.position) {
    Six one = rounding * Six::Ones();
    one.head<3>() *= 1.0 + position.norm();
    errors.push_back(one);
  }
  system.right = residual_bound(system, errors);
  Random signs(1);
  for (Six& right : system.right)
    for (double& r : right) r *= signs.integer(0, 1) ? 1.0 : -1.0;
  const auto found = solve(system);
  return found ? largest_of(*found) : std::numeric_limits<double>::infinity();
}

/// A garden in a system of its own, judged after each step where that is wanted.
class Walk {
 public:
  Walk(const Garden& garden, int threads, int only = -1)
      : garden_(garden), system_(garden.settings, threads) {
    for (std::size_t i = 0; i < garden.plants.size(); ++i) {
      if (only >= 0 && static_cast<int>(i) != only) continue;
      const Garden::Plant& plant = garden.plants[i];
      const int p = system_.add_plant(plant.model);
      plants_.push_back(&plant);
      system_.set_state(p, plant.start);
      system_.loads(p) = plant.loads;
      if (plant.self_contact)
        system_.add_contact_source(p, std::make_unique<cosserat::SelfContact>(
                                          plant.model, cosserat::SelfContactSettings{}));
    }
    past_.resize(plants_.size());
  }

  void run(Outcome* judged) {
    for (int i = 0; i < garden_.steps && fault_.empty(); ++i) step(i, judged);
  }
  const std::string& fault() const { return fault_; }
  const RodState& state(int p) const { return system_.state(p); }
  int size() const { return system_.size(); }

 private:
  void step(int number, Outcome* judged) {
    for (int p = 0; p < size(); ++p) {
      const Pose& motion = plants_[p]->clamp_motion;
      if (motion.position.isZero() && motion.rotation.isApprox(Quat::Identity(), 0.0)) continue;
      RodState& state = system_.edit_state(p);
      state.root = state.root * motion;
    }
    std::vector<RodState> now;
    std::vector<RodModel> models;
    for (int p = 0; p < size(); ++p) {
      now.push_back(state(p));
      if (judged) models.push_back(std::as_const(system_).model(p));
    }
    system_.step(garden_.dt, garden_.gravity);
    for (int p = 0; p < size() && fault_.empty(); ++p) {
      const bool second_order = number > 0 && now[p].previous_dt > 0.0 &&
                                garden_.settings.integrator == cosserat::Integrator::bdf2;
      if (system_.report(p).errors & cosserat::not_finite)
        fault_ = "a number is not finite";
      else if (judged)
        judge(p,
              {models[p], now[p], second_order ? &past_[p] : nullptr, garden_.dt, garden_.gravity,
               plants_[p]->loads},
              *judged);
      if (!fault_.empty())
        fault_ =
            "plant " + std::to_string(p) + ", step " + std::to_string(number + 1) + ": " + fault_;
    }
    past_ = std::move(now);
  }

  void judge(int p, const Step& step, Outcome& outcome) {
    const Place place = place_of(state(p));
    if (system_.detached(p).empty()) judge_end(p, step.end(place));
    ++outcome.steps;
    const cosserat::StepReport& report = system_.report(p);
    // A solver that may stop early is told to by the gain of its last changes; a law or the wind
    // can make the next one larger.
    const RodModel& model = std::as_const(system_).model(p);
    const bool to_the_end = garden_.settings.tolerance < 1.0e-10 && report.last_change < 1.0e-6;
    const bool in_time = report.iterations > 1 &&
                         report.iterations < garden_.settings.newton_iterations &&
                         !cosserat::is_extended(model);
    const bool solved = report.errors == cosserat::none && (to_the_end || in_time);
    if (!solved || plants_[p]->self_contact) return;
    ++outcome.solved;
    const System system = step.linearise(place);
    const auto left = solve(system);
    if (!left) {
      fault_ = "the plain solver finds a matrix that is not positive definite";
      return;
    }
    const double allowed = 4.0 * garden_.settings.tolerance +
                           (to_the_end ? 1.0 : 10.0) * report.last_change +
                           100.0 * rounding_of(system, place);
    const double found = largest_of(*left) / allowed;
    outcome.change = std::max(outcome.change, found);
    if (!(found <= 1.0))
      fault_ = "Newton's change is " + std::to_string(found) + " times what is allowed after " +
               std::to_string(report.iterations) + " iterations";
    if (place.position.size() <= small) compare_minimum(step, place, allowed, outcome);
  }

  // The plain solver's own way, from its own first guess.
  void compare_minimum(const Step& step, const Place& place, double allowed,
                       Outcome& outcome) const {
    const auto own = minimise(step, step.first_guess(), 0.1 * allowed);
    const double off = own ? distance(*own, place) / (10.0 * allowed) : 2.0;
    if (off > 1.0)
      ++outcome.valleys;
    else
      outcome.distance = std::max(outcome.distance, off);
  }

  // What follows from where the elements are.
  void judge_end(int p, const RodState& expected) {
    const RodState& found = state(p);
    for (int e = 0; e < found.size(); ++e) {
      const double rounded = 1.0e4 * rounding * (1.0 + found.position[e].norm()) / garden_.dt;
      const double slack =
          rounded + 1.0e-9 * (found.velocity[e].norm() + found.angular_velocity[e].norm());
      if ((found.position[e] - expected.position[e]).norm() > 0.0 ||
          (found.velocity[e] - expected.velocity[e]).norm() > slack ||
          (found.angular_velocity[e] - expected.angular_velocity[e]).norm() > slack)
        fault_ = "element " + std::to_string(e) + " has another velocity";
    }
    for (std::size_t j = 0; j < found.joint_memory.size(); ++j)
      if ((found.joint_memory[j] - expected.joint_memory[j]).norm() > 1.0e-9)
        fault_ = "a joint remembers something else";
  }

  const Garden& garden_;
  cosserat::RodSystem system_;
  std::vector<const Garden::Plant*> plants_;
  std::vector<RodState> past_;
  std::string fault_;
};

bool same_bits(const RodState& a, const RodState& b) {
  const auto same = [](const auto& x, const auto& y) { return x == y; };
  const auto same_rotation = [](const Quat& x, const Quat& y) { return x.coeffs() == y.coeffs(); };
  return std::ranges::equal(a.position, b.position, same) &&
         std::ranges::equal(a.orientation, b.orientation, same_rotation) &&
         std::ranges::equal(a.velocity, b.velocity, same) &&
         std::ranges::equal(a.angular_velocity, b.angular_velocity, same) && a.alive == b.alive &&
         std::ranges::equal(a.joint_memory, b.joint_memory, same);
}

}  // namespace

void check_steps(const Garden& garden, Outcome& outcome) {
  Walk one(garden, 1), two(garden, 2);
  one.run(&outcome);
  two.run(nullptr);
  outcome.fault = one.fault().empty() ? two.fault() : one.fault();
  for (int p = 0; p < one.size() && outcome.fault.empty(); ++p)
    if (!same_bits(one.state(p), two.state(p)))
      outcome.fault = "plant " + std::to_string(p) + " moves otherwise on two threads";
  if (!outcome.fault.empty()) return;
  if (one.size() > 1) {
    const int p = static_cast<int>(garden.seed % one.size());
    Walk alone(garden, 1 + static_cast<int>(garden.seed % 2), p);
    alone.run(nullptr);
    if (!same_bits(alone.state(0), one.state(p)))
      outcome.fault = "plant " + std::to_string(p) + " moves otherwise alone";
  }
  for (const std::string& name : cosserat::available_instruction_sets()) {
    if (!outcome.fault.empty()) return;
    cosserat::use_instruction_set(name);
    Walk again(garden, 1 + static_cast<int>(garden.seed / 2 % 2));
    again.run(&outcome);
    cosserat::use_instruction_set("");
    if (!again.fault().empty()) outcome.fault = name + ": " + again.fault();
  }
}

}  // namespace pedicel::plain
