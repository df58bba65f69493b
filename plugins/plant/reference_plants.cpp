#include "plugins/plant/reference_plants.h"

#include <cmath>
#include <string>

namespace pedicel::plant {

namespace {

constexpr double spacing = 0.02;           // m
constexpr double golden_angle = 2.399963;  // rad

/// Adds a straight run of elements after `parent` and returns the index of the last one.
int add_run(cosserat::RodModel& model, int parent, const std::string& organ, const Vec3& direction,
            int count, double radius_first, double radius_last) {
  const cosserat::Material material{2.0e7, 0.3, 450.0, 0.0};
  model.organs.push_back(model.name + "/" + organ);
  for (int k = 0; k < count; ++k) {
    const double share = count > 1 ? static_cast<double>(k) / (count - 1) : 0.0;
    const double radius = radius_first + (radius_last - radius_first) * share;
    const Vec3 start = parent < 0 ? model.root.position : model.elements[parent].drawn_position;
    parent = cosserat::add_element(model, parent, start + spacing * direction,
                                   cosserat::circle_section(radius, material));
    cosserat::Element& element = model.elements[parent];
    element.radius_near = element.radius_far = radius;
    element.mass_damping = 2.0;
    element.organ = static_cast<int>(model.organs.size()) - 1;
  }
  return parent;
}

Vec3 slanted(double from_axis, double azimuth, double up) {
  return {std::sin(from_axis) * std::cos(azimuth), std::sin(from_axis) * std::sin(azimuth),
          up * std::cos(from_axis)};
}

}  // namespace

cosserat::RodModel forest_plant(int index) {
  cosserat::RodModel model;
  model.name = "plant_" + std::to_string(index);
  model.root.position = {0.5 * (index % 7), 0.5 * (index / 7), 0.0};
  add_run(model, -1, "stem", Vec3(0.02, 0, 1).normalized(), 19, 0.005, 0.004);
  for (int b = 0; b < 5; ++b)
    add_run(model, 4 + 3 * b, "branch_" + std::to_string(b),
            slanted(1.0, golden_angle * b + index, 1.0), 8, 0.003, 0.002);
  cosserat::finish(model);
  return model;
}

cosserat::RodModel hanging_tree() {
  cosserat::RodModel model;
  model.name = "tree";
  add_run(model, -1, "trunk", -Vec3::UnitZ(), 42, 0.005, 0.005);
  for (int b = 0; b < 22; ++b) {
    const std::string branch = "branch_" + std::to_string(b);
    const int node = 1 + static_cast<int>(std::floor(40.0 * (b + 0.5) / 22.0));
    const int last =
        add_run(model, node, branch, slanted(1.0, golden_angle * b, -1.0), 40, 0.004, 0.003);
    const int first = last - 39;
    for (int k = 0; k < 6; ++k)
      add_run(model, first + 5 + 6 * k, branch + "/twig_" + std::to_string(k),
              slanted(1.3, golden_angle * b + (k % 2 == 0 ? 0.9 : -0.9), -1.0), 10, 0.002, 0.002);
  }
  cosserat::finish(model);
  return model;
}

cosserat::RodModel cantilever(int elements) {
  cosserat::RodModel model;
  model.name = "cantilever";
  model.organs = {"cantilever/rod"};
  const cosserat::Material material{2.0e7, 0.3, 450.0, 0.0};
  for (int e = 0; e < elements; ++e) {
    cosserat::add_element(model, e - 1, Vec3(0.4 * (e + 1) / elements, 0, 0),
                          cosserat::circle_section(0.003, material));
    model.elements[e].radius_near = model.elements[e].radius_far = 0.003;
  }
  cosserat::finish(model);
  return model;
}

}  // namespace pedicel::plant
