#include "tests/stress/stress_plants.h"

#include <algorithm>
#include <filesystem>

#include "engine/io/atomic_file.h"
#include "plugins/cosserat/solver/standing.h"
#include "plugins/plant/plant_builder.h"
#include "plugins/skeleton/mtg_reader.h"
#include "tests/stress/draw.h"
#include "tests/support/places.h"

namespace pedicel::stress {

namespace {

namespace fs = std::filesystem;
using cosserat::RodModel;

cosserat::Thresholds draw_thresholds(Random& random) {
  cosserat::Thresholds thresholds;
  switch (random.integer(0, 5)) {
    case 0:
      thresholds.stretch = draw_log(random, 1.0e-4, 1.0);
      break;
    case 1:
      thresholds.bend = draw_log(random, 1.0e-3, 2.0);
      break;
    case 2:
      thresholds.force = draw_log(random, 1.0e-3, 100.0);
      break;
    case 3:
      thresholds.moment = draw_log(random, 1.0e-6, 1.0);
      break;
    case 4:
      thresholds.torsion = draw_log(random, 1.0e-6, 1.0);
      break;
    default:
      break;
  }
  return thresholds;
}

cosserat::Section draw_section(Random& random, double radius, const cosserat::Material& material) {
  const double other = radius * random.uniform(0.4, 1.0);
  switch (random.integer(0, 3)) {
    case 0:
      return cosserat::ellipse_section(radius, other, material);
    case 1:
      return cosserat::rectangle_section(2.0 * radius, 2.0 * other, material);
    default:
      return cosserat::circle_section(radius, material);
  }
}

// Branches that leave their parents at any angle below 90 degrees and get thinner.
void grow(Random& random, RodModel& model, const StressCase& one) {
  const cosserat::Material material{one.youngs_modulus, random.uniform(0.1, 0.45),
                                    random.uniform(300.0, 1200.0), one.damping_time};
  const double mass_damping = draw_chance(random, 0.5) ? 0.0 : random.uniform(0.0, 2.0);
  const int count = random.integer(1, 50), branching = random.integer(1, 8);
  const double spacing = draw_log(random, 0.005, 0.06), thick = draw_log(random, 0.001, 0.01);
  for (int e = 0; e < count; ++e) {
    const int parent = e == 0 ? -1 : random.integer(std::max(0, e - branching), e - 1);
    const Pose before = parent < 0 ? model.root
                                   : Pose{model.elements[parent].drawn_position,
                                          model.elements[parent].drawn_rotation};
    const Vec3 along =
        before.rotation * Vec3::UnitZ() + random.uniform(0.0, 1.0) * draw_direction(random);
    const double near = parent < 0 ? thick : model.elements[parent].radius_far;
    const double far = near * random.uniform(0.9, 1.0);
    const Vec3 end = before.position + spacing * random.uniform(0.5, 1.5) * along.normalized();
    const int index = cosserat::add_element(model, parent, end,
                                            draw_section(random, 0.5 * (near + far), material));
    cosserat::Element& element = model.elements[index];
    element.radius_near = near;
    element.radius_far = far;
    element.damping_time = one.damping_time;
    element.mass_damping = mass_damping;
  }
}

// The last segment leads from a branch to a node of another, and is grown together with it.
void close_loop(Random& random, RodModel& model) {
  const int last = model.size() - 1, target = random.integer(0, std::max(0, last - 3));
  if (last < 3 || model.elements[last].parent == target) return;
  const cosserat::Section section = model.elements[last].section;
  const double radius = model.elements[last].radius_far;
  cosserat::Weld weld;
  weld.a = target;
  weld.b = cosserat::add_element(model, last, model.elements[target].drawn_position, section);
  cosserat::Element& element = model.elements[weld.b];
  element.radius_near = element.radius_far = radius;
  element.damping_time = model.elements[last].damping_time;
  weld.position_stiffness = section.axial / element.length;
  weld.bend_stiffness = 2.0 / element.length * Vec3(section.bend1, section.bend2, section.twist);
  model.welds.push_back(weld);
}

void support(Random& random, RodModel& model) {
  cosserat::Support one;
  one.element = random.integer(0, model.size() - 1);
  const cosserat::Element& element = model.elements[one.element];
  one.position = element.drawn_position;
  one.position_stiffness = element.section.axial / element.length;
  if (draw_chance(random, 0.5))
    one.rotation_stiffness =
        2.0 / element.length *
        Vec3(element.section.bend1, element.section.bend2, element.section.twist);
  model.supports.push_back(one);
}

void hang_things(Random& random, RodModel& model) {
  for (int i = random.integer(0, 3); i > 0; --i) {
    const int e = random.integer(0, model.size() - 1);
    const double back = draw_chance(random, 0.7) ? 0.0 : 0.5 * model.elements[e].length;
    model.fruits.push_back({"fruit_" + std::to_string(i), e, back, random.uniform(0.003, 0.03),
                            random.uniform(500.0, 1100.0), draw_thresholds(random)});
  }
  if (draw_chance(random, 0.3))
    model.masses.push_back({random.integer(0, model.size() - 1), 0.0, draw_log(random, 1.0e-3, 0.3),
                            random.uniform(0.0, 0.02)});
}

RodModel random_tree(Random& random, const StressCase& one) {
  RodModel model;
  model.organs = {"plant/branches"};
  model.root.rotation = draw_rotation(random);
  grow(random, model, one);
  if (draw_chance(random, 0.2)) close_loop(random, model);
  hang_things(random, model);
  for (int i = draw_chance(random, 0.2) ? random.integer(1, 2) : 0; i > 0; --i)
    support(random, model);
  cosserat::finish(model);
  const bool as_drawn = draw_chance(random, 0.3);
  if (as_drawn && !cosserat::stand_as_drawn(model, Vec3(0, 0, -9.81)).solvable)
    cosserat::finish(model);  // too soft for its load: unloaded as drawn
  return model;
}

// Gives a plant file the case's modulus (what its curves say of their own keeps its proportion),
// damping and thresholds.
void take_over(Random& random, plant::PlantFile& file, const StressCase& one) {
  const double scale = one.youngs_modulus / file.material.youngs_modulus.value_or(1.0e7);
  file.material.youngs_modulus = one.youngs_modulus;
  file.material.damping_time = one.damping_time;
  for (plant::PlantCurve& curve : file.curves) {
    if (curve.material.youngs_modulus)
      curve.material.youngs_modulus =
          std::clamp(scale * *curve.material.youngs_modulus, 1.0e5, 1.0e11);
    curve.material.damping_time = one.damping_time;
  }
  for (plant::PlantFruit& fruit : file.fruits) {
    const cosserat::Thresholds drawn = draw_thresholds(random);
    const auto limit = [](double value) {
      return value < cosserat::Thresholds::never ? std::optional(value) : std::nullopt;
    };
    fruit.detach = {limit(drawn.stretch), limit(drawn.bend), limit(drawn.force),
                    limit(drawn.moment), limit(drawn.torsion)};
  }
}

// As drawn where it can stand so, else unloaded as drawn. Empty where it does not build.
std::optional<RodModel> build(plant::PlantFile& file) {
  plant::BuildOptions options;
  options.leaf_folders = {pedicel::test::source_folder() / "assets/leaves"};
  for (const plant::Shape shape : {file.shape, plant::Shape::rest}) {
    file.shape = shape;
    Diagnostics diagnostics;
    if (auto built = plant::build_plant(file, options, diagnostics)) return std::move(built->model);
  }
  return std::nullopt;
}

std::optional<RodModel> plant_of_file(Random& random, const fs::path& path, const StressCase& one) {
  Diagnostics diagnostics;
  std::optional<plant::PlantFile> file;
  plant::MtgOptions options;
  options.distance = 0.3;
  if (path.extension() == ".mtg")
    file = plant::checked_skeleton_plant(
        plant::parse_mtg(pedicel::io::read_file(path), path.string(), diagnostics),
        path.stem().string(), options, diagnostics);
  else
    file = plant::read_plant_file(path, diagnostics);
  if (!file) return std::nullopt;
  take_over(random, *file, one);
  return build(*file);
}

}  // namespace

void draw_plant(Random& random, StressCase& one) {
  static const std::vector<fs::path> shipped = {
      pedicel::test::source_folder() / "plants/cherry_tomato.plant.yaml",
      pedicel::test::source_folder() / "plants/greenhouse_tomato.plant.yaml",
      pedicel::test::source_folder() / "plants/young_plant.plant.yaml"};
  static const std::vector<fs::path> trees = {
      pedicel::test::source_folder() / "plants/apple_tree.mtg",
      pedicel::test::source_folder() / "plants/apple_tree.plant.yaml"};
  const double kind = random.uniform();
  if (kind < 0.35) {
    const auto& files = kind < 0.05 ? trees : shipped;
    const fs::path& path = files[random.integer(0, static_cast<int>(files.size()) - 1)];
    if (auto model = plant_of_file(random, path, one)) {
      one.plant_name = path.filename().string();
      one.plant = std::move(*model);
      return;
    }
  }
  one.plant_name = "random tree";
  one.plant = random_tree(random, one);
}

}  // namespace pedicel::stress
