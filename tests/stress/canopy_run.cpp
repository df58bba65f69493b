#include "tests/stress/canopy_run.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "plugins/cosserat/contact/plant_blades.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "tests/analytic/sphere_source.h"
#include "tests/unit/cosserat/random_plants.h"

namespace pedicel::stress {

namespace {

using namespace cosserat;

constexpr double dt = 1.0 / 240.0;
constexpr int steps = 240, quiet_from = 120;  // nothing is put in from the latter on
constexpr double fastest = 40.0;              // m/s
// Of the energy at rest and of what was put in: contact is a spring that is found anew in each
// step.
constexpr double energy_share = 0.1, energy_slack = 2.0e-3;  // 1, J

struct Ram {
  Vec3 start, velocity;  // m, m/s, W
};

void move(RodModel& model, const Vec3& by) {
  model.root.position += by;
  for (Element& element : model.elements) element.drawn_position += by;
  for (Support& support : model.supports) support.position += by;
}

class Canopy {
 public:
  Canopy(std::uint64_t seed, int threads)
      : random_(seed), system_(RodSettings{}, threads), gravity_(0, 0, -random_.uniform(0, 15)) {
    const int plants = random_.integer(2, 6);
    const double crowd = random_.uniform(0.02, 0.15);
    text_ = std::to_string(plants) + " plants within " + std::to_string(crowd) + " m";
    for (int p = 0; p < plants; ++p) {
      RodModel model =
          cases::random_plant(random_, random_.integer(4, 30), random_.integer(0, 3) == 0);
      move(model, cases::random_vector(random_, crowd) - model.root.position);
      model.name = "plant_" + std::to_string(p);
      model.organs = {model.name + "/stem"};
      if (random_.integer(0, 1)) model.fruits[0].thresholds.force = random_.uniform(0.01, 0.5);
      system_.add_plant(std::move(model));
    }
    SelfContactSettings contact;
    contact.stiffness = std::pow(10.0, random_.uniform(3, 6));
    contact.friction = random_.uniform(0, 1.2);
    system_.let_plants_touch(contact);
    add_ties();
    add_strings();
    if (random_.integer(0, 1)) add_blades();
    add_loads();
    if (random_.integer(0, 1)) add_ram();
    cut_at_ = random_.integer(0, 1) ? random_.integer(10, 100) : -1;
  }

  CanopyOutcome run() {
    CanopyOutcome outcome;
    outcome.description = text_;
    for (int i = 0; i < steps && outcome.fault.empty(); ++i) {
      prepare(i);
      system_.step(dt, gravity_);
      judge(i, outcome);
    }
    StateHash hash;
    system_.add_to(hash);
    outcome.hash = hash.value();
    return outcome;
  }

 private:
  int any_plant() { return random_.integer(0, system_.size() - 1); }
  int any_element(int plant) { return random_.integer(0, system_.model(plant).size() - 1); }

  void add_ties() {
    for (int i = random_.integer(0, 3); i > 0; --i) {
      const int p = any_plant();
      Tie tie;
      tie.element = any_element(p);
      const Vec3 from = system_.state(p).position[tie.element];
      tie.anchor_W = from + cases::random_vector(random_, 0.3);
      tie.length = random_.uniform(0.9, 1.0) * (tie.anchor_W - from).norm();
      tie.stiffness = std::pow(10.0, random_.uniform(0, 3));
      system_.ties(p).push_back(tie);
    }
  }

  // From plant to plant, or within one.
  void add_strings() {
    const int count = random_.integer(0, 3);
    for (int i = 0; i < count; ++i) {
      PlantString string;
      for (PlantString::End* end : {&string.a, &string.b}) {
        end->plant = any_plant();
        end->element = any_element(end->plant);
        end->back = random_.uniform() * system_.model(end->plant).elements[end->element].length;
      }
      if (string.a.plant == string.b.plant && string.a.element == string.b.element) continue;
      const Vec3 way = *place_of(system_, string.b) - *place_of(system_, string.a);
      string.length = random_.uniform(0.9, 1.0) * way.norm();
      string.stiffness = std::pow(10.0, random_.uniform(0, 4));
      system_.add_string(string);
    }
    if (!system_.strings().empty())
      text_ += ", " + std::to_string(system_.strings().size()) + " strings";
  }

  // Between three nodes of a branch, or of two that part.
  void add_blades() {
    std::size_t all = 0;
    for (int p = 0; p < system_.size(); ++p) {
      std::vector<BladeTriangle> triangles;
      const RodModel& model = system_.model(p);
      for (int i = random_.integer(0, 12); i > 0; --i) {
        const int e = any_element(p), parent = model.elements[e].parent;
        const int before = parent < 0 ? -1 : model.elements[parent].parent;
        if (before >= 0)
          triangles.push_back(
              {BladePlace{e, 0.0}, BladePlace{parent, 0.0}, BladePlace{before, 0.0}});
      }
      all += triangles.size();
      if (!triangles.empty())
        system_.add_contact_source(p, std::make_unique<PlantBlades>(triangles, 1.5e-4));
    }
    text_ += ", " + std::to_string(all) + " blades";
  }

  void add_loads() {
    for (int i = random_.integer(0, 3); i > 0; --i) {
      const int p = any_plant();
      system_.loads(p).push_back(
          {any_element(p), 0.0, cases::random_vector(random_, 0.3), Vec3::Zero()});
    }
  }

  // One thing that goes through all plants.
  void add_ram() {
    ram_ = {cases::random_vector(random_, 0.3), cases::random_vector(random_, 2.0)};
    text_ += ", a ram";
    for (int p = 0; p < system_.size(); ++p) {
      auto source = std::make_unique<cases::SphereSource>();
      source->spheres.push_back({ram_.start, 0.02, ram_.velocity * dt});
      rams_.push_back(source.get());
      system_.add_contact_source(p, std::move(source));
    }
  }

  void prepare(int step) {
    if (step == quiet_from) {
      for (int p = 0; p < system_.size(); ++p)
        for (Load& load : system_.loads(p)) load.force_W.setZero();
      for (cases::SphereSource* ram : rams_) ram->spheres.clear();
    }
    for (cases::SphereSource* ram : rams_)
      for (cases::Sphere& sphere : ram->spheres)
        sphere.centre = ram_.start + (step + 1) * dt * ram_.velocity;
    if (step != cut_at_) return;
    const int p = any_plant(), e = any_element(p);
    if (system_.state(p).alive[e]) cut(system_.model(p), system_.edit_state(p), e);
  }

  double energy() const {
    double sum = 0.0;
    for (int p = 0; p < system_.size(); ++p) {
      sum += energy_of(system_.model(p), system_.state(p), gravity_).total();
      for (const Tie& tie : system_.ties(p)) {
        const double pull = tension(system_.state(p), tie);
        sum += 0.5 * pull * pull / tie.stiffness;
      }
      const RodModel& model = system_.model(p);
      for (const Support& one : model.supports)
        if (system_.state(p).alive[one.element])
          sum += 0.5 * one.position_stiffness *
                 (point_on(model, system_.state(p), one.element, one.back) - one.position)
                     .squaredNorm();
      for (const Weld& one : model.welds)
        if (system_.state(p).alive[one.a] && system_.state(p).alive[one.b])
          sum +=
              0.5 * one.position_stiffness *
              (system_.state(p).position[one.a] - system_.state(p).position[one.b]).squaredNorm();
    }
    for (const PlantString& string : system_.strings()) {
      const double pull = tension(system_, string);
      sum += 0.5 * pull * pull / string.stiffness;
    }
    return sum;
  }

  void judge(int step, CanopyOutcome& outcome) {
    const std::string when = " at step " + std::to_string(step);
    Vec3 sum = Vec3::Zero();
    double largest = 0.0;
    for (int p = 0; p < system_.size(); ++p) {
      const RodState& state = system_.state(p);
      if (system_.report(p).errors & not_finite) outcome.fault = "not finite" + when;
      for (int e = 0; e < state.size(); ++e)
        if (state.alive[e] && !(state.velocity[e].norm() < fastest))
          outcome.fault = system_.model(p).name + " moves at " +
                          std::to_string(state.velocity[e].norm()) + " m/s" + when;
      for (const ContactForce& force : system_.contact_forces(p)) {
        if (!is_other_plant(force.point.collider)) continue;
        ++outcome.contacts;
        sum += force.normal * force.point.normal_W + force.tangential_W;
        largest = std::max(largest, force.normal);
      }
    }
    outcome.imbalance = std::max(outcome.imbalance, sum.norm());
    if (sum.norm() > 1e-9 * (1.0 + largest))
      outcome.fault =
          "forces between plants do not balance: " + std::to_string(sum.norm()) + " N" + when;
    if (step == 0) rest_ = energy();
    if (step < quiet_from) return;
    const double now = energy();
    if (step == quiet_from) most_ = now + energy_slack + energy_share * std::abs(now - rest_);
    if (now > most_)
      outcome.fault =
          "energy rises from " + std::to_string(most_) + " to " + std::to_string(now) + " J" + when;
  }

  Random random_;
  RodSystem system_;
  Vec3 gravity_;
  Ram ram_;
  std::vector<cases::SphereSource*> rams_;  // of system_
  int cut_at_ = -1;
  double rest_ = 0.0, most_ = 0.0;  // J
  std::string text_;
};

}  // namespace

CanopyOutcome run_canopy(std::uint64_t seed, int threads) {
  return Canopy(seed, threads).run();
}

}  // namespace pedicel::stress
