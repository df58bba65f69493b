#include "tests/property/rods/random_garden.h"

#include <algorithm>
#include <cmath>

#include "tests/property/rods/plain_rotation.h"

namespace pedicel::plain {

using cosserat::RodModel;

namespace {

bool chance(Random& random, double probability) {
  return random.uniform() < probability;
}

// Uniform in the logarithm.
double draw_log(Random& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

Vec3 draw_vector(Random& random, double size) {
  const double x = random.uniform(-size, size), y = random.uniform(-size, size);
  return {x, y, random.uniform(-size, size)};
}

struct Wood {
  cosserat::Material material;
  double radius, length;  // m
  double damping_time, mass_damping;
};

Wood draw_wood(Random& random) {
  Wood wood{{draw_log(random, 1.0e6, 1.0e10), 0.3, random.uniform(300.0, 1100.0), 0.0},
            draw_log(random, 0.001, 0.01),
            draw_log(random, 0.005, 0.06),
            0.0,
            0.0};
  if (chance(random, 0.6)) wood.damping_time = draw_log(random, 1.0e-4, 0.05);
  if (chance(random, 0.3)) wood.mass_damping = random.uniform(0.0, 2.0);
  return wood;
}

int grow_element(Random& random, RodModel& model, int parent, int organ, const Wood& wood) {
  const Pose before = parent < 0 ? model.root
                                 : Pose{model.elements[parent].drawn_position,
                                        model.elements[parent].drawn_rotation};
  const Vec3 along = (before.rotation * Vec3::UnitZ() + draw_vector(random, 0.6)).normalized();
  const double radius = wood.radius * random.uniform(0.6, 1.0);
  const cosserat::Section section =
      chance(random, 0.7)
          ? cosserat::circle_section(radius, wood.material)
          : cosserat::ellipse_section(radius, radius * random.uniform(0.5, 1.0), wood.material);
  const int e = cosserat::add_element(
      model, parent, before.position + wood.length * random.uniform(0.5, 1.5) * along, section);
  cosserat::Element& element = model.elements[e];
  element.organ = organ;
  element.radius_near = element.radius_far = radius;
  element.damping_time = wood.damping_time;
  element.mass_damping = wood.mass_damping;
  return e;
}

// From one node on `around` elements that come back to it.
void add_loop(Random& random, RodModel& model, int at, int around, const Wood& wood) {
  const Vec3 node = model.elements[at].drawn_position;
  const Vec3 x = model.elements[at].drawn_rotation * Vec3::UnitX();
  const Vec3 z = model.elements[at].drawn_rotation * Vec3::UnitZ();
  const double size = wood.length * random.uniform(0.5, 1.5);
  int last = at;
  for (int i = 1; i <= around; ++i) {
    const double angle = 2.0 * 3.14159265358979323846 * i / around;
    const Vec3 end = i == around
                         ? node
                         : Vec3(node + size * ((1.0 - std::cos(angle)) * z + std::sin(angle) * x));
    last = cosserat::add_element(model, last, end,
                                 cosserat::circle_section(0.3 * wood.radius, wood.material));
    cosserat::Element& element = model.elements[last];
    element.organ = model.elements[at].organ;
    element.radius_near = element.radius_far = 0.3 * wood.radius;
    element.damping_time = wood.damping_time;
  }
  const cosserat::Element& closing = model.elements[last];
  model.welds.push_back(
      {at, last, closing.section.axial / closing.length,
       2.0 / closing.length *
           Vec3(closing.section.bend1, closing.section.bend2, closing.section.twist),
       Quat::Identity()});
}

cosserat::Thresholds draw_thresholds(Random& random) {
  cosserat::Thresholds thresholds;
  if (chance(random, 0.3)) thresholds.force = draw_log(random, 1.0e-3, 10.0);
  if (chance(random, 0.2)) thresholds.bend = draw_log(random, 1.0e-3, 1.0);
  return thresholds;
}

void hang_things(Random& random, RodModel& model) {
  const int last = model.size() - 1;
  for (int i = random.integer(0, 3); i > 0; --i)
    model.fruits.push_back({"fruit_" + std::to_string(i), random.integer(0, last), 0.0,
                            random.uniform(0.002, 0.01), 900.0, draw_thresholds(random)});
  for (int i = random.integer(0, 2); i > 0; --i)
    model.masses.push_back({random.integer(0, last), 0.0, draw_log(random, 1.0e-4, 0.05), 0.002});
  if (chance(random, 0.7)) return;
  for (int i = random.integer(1, 3); i > 0; --i) {
    cosserat::Support one;
    one.element = random.integer(0, last);
    const cosserat::Element& element = model.elements[one.element];
    one.position = element.drawn_position;
    one.position_stiffness = draw_log(random, 1.0, 1.0e4);
    if (chance(random, 0.5)) one.rotation_stiffness = Vec3(0.1, 0.2, 0.3);
    model.supports.push_back(one);
  }
}

// Joint laws on some joints, air about all.
void extend(Random& random, RodModel& model) {
  const bool laws = chance(random, 0.6);
  const double bend = draw_log(random, 0.01, 0.5);  // rad, at which sliders slip
  for (int e = 0; laws && e < model.size(); ++e) {
    const Vec3& k = model.elements[e].bend_stiffness;
    const double softer = std::min(k.x(), k.y());
    cosserat::JointLaw law;
    if (chance(random, 0.3)) law.term("material_nonlinearity") = random.uniform(-2.0, 10.0);
    if (chance(random, 0.2)) {
      const double turn = random.uniform(0.0, 6.28), tilt = random.uniform(0.0, 1.0);
      law.term("asymmetry", 0) = random.uniform(-0.9, 0.9);
      law.term("asymmetry", 1) = tilt * std::cos(turn);
      law.term("asymmetry", 2) = tilt * std::sin(turn);
      law.term("asymmetry", 3) = bend;
    }
    if (chance(random, 0.2)) cosserat::add_structural_damping(law, random.uniform(0.02, 0.2));
    if (chance(random, 0.3))
      cosserat::add_relaxation(law, random.uniform(0.0, 0.3), draw_log(random, 0.01, 1.0),
                               chance(random, 0.5) ? cosserat::RelaxationStart::unloaded
                                                   : cosserat::RelaxationStart::settled);
    if (chance(random, 0.3))
      cosserat::add_friction(law, random.uniform(0.1, 0.3), 0.2 * softer * bend);
    if (law.elastic + law.deviation > 0.05 && chance(random, 0.2))
      cosserat::add_yield(law, softer * random.uniform(0.5, 2.0) * bend);
    else if (law.elastic + law.deviation < 0.05)
      law = {};  // it would carry nothing in the long run
    model.laws.push_back(law);
  }
  if (!laws || chance(random, 0.3)) {
    const Vec3 wind = draw_vector(random, 3.0), gust = draw_vector(random, 1.0);
    for (int i = 0; i < model.size(); ++i)
      model.air.push_back({random.uniform(0.0, 0.1), wind, gust});
    model.gust_frequency = 1.5;
  }
  if (chance(random, 0.3)) {
    model.stiffness_drift = random.uniform(-0.05, 0.05);
    model.clock = 3.0;
  }
}

// Bent and moving, from hardly at all to roughly.
cosserat::RodState draw_state(Random& random, const RodModel& model) {
  cosserat::RodState state = cosserat::drawn_state(model);
  const double rough = chance(random, 0.2) ? 0.0 : draw_log(random, 1.0e-5, 0.1);
  for (int e = 0; e < model.size(); ++e) {
    state.position[e] += draw_vector(random, 0.02 * rough * model.elements[e].length);
    state.orientation[e] = state.orientation[e] * turn_by(draw_vector(random, rough));
    state.velocity[e] = draw_vector(random, rough);
    state.angular_velocity[e] = draw_vector(random, 5.0 * rough);
  }
  return state;
}

// Some parts with all that they carry, or everything.
void break_off(Random& random, const RodModel& model, cosserat::RodState& state) {
  const bool all = chance(random, 0.3);
  if (all) std::fill(state.alive.begin(), state.alive.end(), 0);
  for (int i = all ? 0 : random.integer(1, 5); i > 0; --i)
    state.alive[random.integer(0, model.size() - 1)] = 0;
  for (int e = 0; e < model.size(); ++e) {
    const int parent = model.elements[e].parent;
    if (parent >= 0 && !state.alive[parent]) state.alive[e] = 0;
  }
}

Garden::Plant draw_plant(Random& random, int elements) {
  const Shape shape = draw_shape(random, elements);
  const Wood wood = draw_wood(random);
  Garden::Plant plant;
  RodModel& model = plant.model;
  model.root = {draw_vector(random, 1.0), turn_by(draw_vector(random, 1.5))};
  for (std::size_t e = 0; e < shape.parents.size(); ++e)
    grow_element(random, model, shape.parents[e], shape.organs[e], wood);
  plant.shape = shape.name + " of " + std::to_string(elements);
  if (shape.leafy) {
    const int loops = random.integer(1, std::clamp(elements / 10, 1, 60));
    for (int i = 0; i < loops; ++i)
      add_loop(random, model, random.integer(0, elements - 1), random.integer(3, 12), wood);
    plant.shape += " with " + std::to_string(loops) + " leaves";
  }
  for (const cosserat::Element& element : model.elements)
    while (static_cast<int>(model.organs.size()) <= element.organ)
      model.organs.push_back("organ_" + std::to_string(model.organs.size()));
  if (model.size() > 0) hang_things(random, model);
  cosserat::finish(model);
  if (chance(random, 0.3)) {
    extend(random, model);
    plant.shape += model.laws.empty() ? " in wind" : " with laws";
  }
  plant.start = draw_state(random, model);
  if (model.size() > 0 && chance(random, 0.15)) {
    break_off(random, model, plant.start);
    plant.shape += " with parts off";
  }
  cosserat::start_memory(model, plant.start);
  for (int i = model.size() > 0 && chance(random, 0.3) ? random.integer(1, 3) : 0; i > 0; --i)
    plant.loads.push_back({random.integer(0, model.size() - 1), 0.0, draw_vector(random, 0.05),
                           draw_vector(random, 1.0e-3)});
  plant.self_contact = elements <= 3000 && chance(random, 0.1);
  if (plant.self_contact) plant.shape += " that touches itself";
  if (chance(random, 0.2))
    plant.clamp_motion = {draw_vector(random, 2.0e-3), turn_by(draw_vector(random, 0.01))};
  return plant;
}

void draw_settings(Random& random, Garden& garden) {
  cosserat::RodSettings& settings = garden.settings;
  if (chance(random, 0.2)) settings.integrator = cosserat::Integrator::backward_euler;
  const double kind = random.uniform();
  if (kind < 0.5) {  // as far as rounding lets it
    settings.newton_iterations = 12;
    settings.tolerance = 1.0e-14;
  } else if (kind < 0.75) {
    settings.newton_iterations = 40;
    settings.tolerance = draw_log(random, 1.0e-9, 1.0e-6);
  } else {
    settings.newton_iterations = random.integer(1, 6);
    settings.tolerance = draw_log(random, 1.0e-9, 1.0e-3);
  }
  garden.dt = draw_log(random, 1.0 / 2000.0, 1.0 / 60.0);
  garden.gravity = chance(random, 0.2) ? Vec3(0, 0, 0) : draw_vector(random, 15.0);
  garden.steps = random.integer(1, 4);
}

}  // namespace

int Garden::elements() const {
  int sum = 0;
  for (const Plant& plant : plants) sum += plant.model.size();
  return sum;
}

Garden draw_garden(std::uint64_t seed, int most) {
  Random random(seed);
  Garden garden;
  garden.seed = seed;
  draw_settings(random, garden);
  const auto size = [&](int largest) {
    return static_cast<int>(draw_log(random, 1.0, largest + 0.99));
  };
  const double kind = random.uniform();
  if (kind < 0.02) return garden;  // no plant
  if (kind < 0.65) {
    garden.plants.push_back(draw_plant(random, size(most)));
  } else if (kind < 0.85) {
    for (int i = random.integer(2, 12); i > 0; --i)
      garden.plants.push_back(draw_plant(random, size(std::min(most, 1500))));
  } else {  // a few sorts, many of each
    for (int i = random.integer(1, 3); i > 0; --i) {
      const Garden::Plant one = draw_plant(random, size(std::min(most, 200)));
      const int room = most / std::max(1, one.model.size());
      for (int k = random.integer(1, std::clamp(room, 1, 60)); k > 0; --k)
        garden.plants.push_back(one);
    }
  }
  if (chance(random, 0.03)) garden.plants.push_back({"nothing", {}, {}, {}, false, {}});
  return garden;
}

std::string describe(const Garden& garden) {
  std::string text = "seed " + std::to_string(garden.seed) + ": ";
  for (std::size_t p = 0; p < garden.plants.size() && p < 4; ++p)
    text += (p ? ", " : "") + garden.plants[p].shape;
  if (garden.plants.size() > 4)
    text += " and " + std::to_string(garden.plants.size() - 4) + " more";
  if (garden.plants.empty()) text += "no plant";
  return text + "; " + std::to_string(garden.steps) + " steps of " + std::to_string(garden.dt) +
         " s, at most " + std::to_string(garden.settings.newton_iterations) + " iterations";
}

}  // namespace pedicel::plain
