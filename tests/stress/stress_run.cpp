#include "tests/stress/stress_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/coupling/collider_source.h"
#include "tests/stress/energy_ledger.h"
#include "tests/stress/sentence.h"

namespace pedicel::stress {

using cosserat::RodModel;
using cosserat::RodState;

namespace {

bool is_finite(const RodState& state) {
  double sum = 0.0;
  for (int e = 0; e < state.size(); ++e)
    sum += state.position[e].sum() + state.orientation[e].coeffs().sum() + state.velocity[e].sum() +
           state.angular_velocity[e].sum();
  return std::isfinite(sum);
}

/// One case under way.
class Run {
 public:
  explicit Run(const StressCase& one)
      : case_(one), system_(one.rods), probe_(colliders_, one.coupling) {
    system_.add_plant(one.plant);
    if (one.ram) {
      coupling::Collider collider;
      collider.name = one.ram->shape_name;
      collider.shape = one.ram->shape;
      colliders_.add(collider, one.ram->at(0.0));
    }
    auto source = std::make_unique<coupling::ColliderSource>(colliders_, one.coupling);
    source->ignore_touching(model(), system_.state(0));
    system_.add_contact_source(0, std::move(source));
    probe_.ignore_touching(model(), system_.state(0));
    if (one.coupling.self_contact)
      system_.add_contact_source(0, std::make_unique<cosserat::SelfContact>(
                                        model(), coupling::self_contact_settings(one.coupling)));
  }

  Outcome run() {
    EnergyLedger ledger(model(), system_.state(0), case_.gravity, case_.rods.integrator);
    for (int i = 0; i < case_.steps && outcome_.fault.empty(); ++i) {
      const RodState before = system_.state(0);
      drive(i * case_.dt);
      look_ahead(before);
      system_.step(case_.dt, case_.gravity);
      judge(before, ledger);
      if (!outcome_.fault.empty()) outcome_.fault += " in step " + std::to_string(i + 1);
    }
    return outcome_;
  }

 private:
  const RodModel& model() const { return std::as_const(system_).model(0); }

  // Everything that is moved from outside goes to where it is at the end of the step.
  void drive(double begin) {
    const double end = begin + case_.dt;
    if (case_.shake) system_.edit_state(0).root = case_.shake->at(case_.plant.root, end);
    if (case_.ram) {
      const Pose pose = case_.ram->at(end);
      colliders_.update({&pose, 1});
    }
    std::vector<cosserat::Load>& loads = system_.loads(0);
    loads.clear();
    for (const TimedLoad& timed : case_.loads)
      if (begin >= timed.from && begin < timed.to) loads.push_back(timed.load);
  }

  void look_ahead(const RodState& before) {
    probe_.begin_step(model(), before, case_.dt);
    probe_.cover(0.0, 0.5);
    meeting_half_way_.clear();
    probe_.find(model(), before, 0.5 * case_.dt, meeting_half_way_);
    probe_.cover(0.0, 1.0);
    meeting_.clear();
    probe_.find(model(), before, case_.dt, meeting_);
  }

  void judge(const RodState& before, EnergyLedger& ledger) {
    const RodState& after = system_.state(0);
    const unsigned errors = system_.report(0).errors;
    if ((errors & cosserat::not_finite) || !is_finite(after)) {
      outcome_.fault = "a number is not finite";
      return;
    }
    const auto& contacts = system_.contact_forces(0);
    const auto& detached = system_.detached(0);
    const bool is_converged =
        errors == cosserat::none && system_.report(0).last_change <= case_.rods.tolerance;
    ledger.book(model(), {before, after, case_.dt, system_.loads(0), contacts, meeting_half_way_,
                          meeting_, detached, is_converged});
    outcome_.rough_steps += errors != cosserat::none;
    outcome_.contacts = std::max(outcome_.contacts, static_cast<int>(contacts.size()));
    outcome_.broken += static_cast<int>(detached.size());
    judge_strains(after, ledger);
    outcome_.excess = std::max(outcome_.excess, ledger.excess());
    if (outcome_.fault.empty() && ledger.found() > ledger.allowed())
      outcome_.fault =
          sentence("energy of %.3g J where %.3g J are allowed", ledger.found(), ledger.allowed());
  }

  void judge_strains(const RodState& state, const EnergyLedger& ledger) {
    for (int e = 0; e < state.size(); ++e) {
      if (!state.alive[e]) continue;
      const cosserat::Element& element = model().elements[e];
      const Vec3 strain = cosserat::strain_of(model(), state, e).stretch;
      const double energy =
          0.5 * element.length * strain.dot(element.stretch_stiffness.cwiseProduct(strain));
      const double used = std::sqrt(energy / std::max(ledger.allowed(), 0.0));
      outcome_.strain = std::max(outcome_.strain, strain.norm());
      outcome_.strain_used = std::max(outcome_.strain_used, used);
      if (used > 1.0)
        outcome_.fault = sentence("segment %d is off its joint: strain %.3g, at most %.3g", e,
                                  strain.norm(), strain.norm() / used);
    }
  }

  const StressCase& case_;
  coupling::ColliderSet colliders_;
  cosserat::RodSystem system_;
  coupling::ColliderSource probe_;  // what would touch if the plant held still
  std::vector<cosserat::ContactPoint> meeting_half_way_, meeting_;
  Outcome outcome_;
};

}  // namespace

Outcome run_case(const StressCase& one) {
  return Run(one).run();
}

}  // namespace pedicel::stress
