#include "plugins/simulation/plants/varied_plant.h"

#include <algorithm>
#include <cmath>

#include "engine/core/random.h"
#include "engine/world/settings.h"
#include "plugins/plant/plant_numbers.h"
#include "plugins/plant/plant_shape.h"
#include "plugins/simulation/plants/plant_overrides.h"

namespace pedicel::simulation {

namespace {

using What = GridKey::What;

// FNV-1a of the name, and a step of the golden ratio for each number: plants next to each other get
// seeds that have nothing in common.
std::uint64_t seed_of(std::uint64_t seed, const std::string& name, int number) {
  std::uint64_t hash = 14695981039346656037ull ^ seed;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return hash + 0x9e3779b97f4a7c15ull * (static_cast<std::uint64_t>(number) + 1);
}

std::string expected_keys() {
  std::string text;
  for (const GridKey& key : grid_keys()) text += std::string(key.key) + ", ";
  for (const plant::ShapeFactor& factor : plant::shape_factors())
    text += std::string(factor.key) + ", ";
  for (const plant::PlantNumber& number : plant::plant_numbers())
    text += std::string(number.key) + ", ";
  return text.substr(0, text.size() - 2);
}

/// What is drawn for one plant, on its way into it.
class Varied {
 public:
  Varied(plant::PlantFile& plant, std::uint64_t seed) : plant_(plant), random_(seed) {}

  void set(What what, double value) {
    if (what == What::turn) turn_ = value;
    if (what == What::lean) lean_ = value;
    if (what == What::towards) towards_ = value;
    if (what == What::scale) scale(value);
    if (what == What::fruits) keep_fruits(value);
  }

  // Turned first and leant then, so that where it leans to does not depend on the turn.
  Pose placed(const Pose& pose) const {
    const Vec3 axis(-std::sin(towards_), std::cos(towards_), 0.0);
    const Quat by =
        Quat(Eigen::AngleAxisd(lean_, axis)) * Quat(Eigen::AngleAxisd(turn_, Vec3::UnitZ()));
    Pose moved;
    moved.rotation = (by * pose.rotation).normalized();
    // The root stays: a plant leans about its foot.
    moved.position = pose * plant_.root - moved.rotation * plant_.root;
    return moved;
  }

 private:
  void scale(double factor) {
    for (const plant::ShapeFactor& one : plant::shape_factors())
      plant::scale_shape(plant_, one.what, factor);
  }

  // Any of them: those that are left hang where they did.
  void keep_fruits(double share) {
    const auto kept = static_cast<std::size_t>(std::lround(share * plant_.fruits.size()));
    while (plant_.fruits.size() > kept)
      plant_.fruits.erase(plant_.fruits.begin() +
                          random_.integer(0, static_cast<int>(plant_.fruits.size()) - 1));
  }

  plant::PlantFile& plant_;
  Random random_;
  double turn_ = 0.0, lean_ = 0.0, towards_ = 0.0;  // rad
};

}  // namespace

std::span<const GridKey> grid_keys() {
  static const GridKey all[] = {{"place.turn", What::turn, "rad", {-10.0, 10.0}},
                                {"place.lean", What::lean, "rad", {-1.5, 1.5}},
                                {"place.towards", What::towards, "rad", {-10.0, 10.0}},
                                {"shape.scale", What::scale, "1", plant::shape_bounds},
                                {"fruits.share", What::fruits, "1", io::fraction}};
  return all;
}

void vary_plant(const world::ScenePlant& grid, int number, std::uint64_t seed,
                plant::PlantFile& plant, Pose& pose, Diagnostics& diagnostics) {
  const std::uint64_t own = seed_of(seed, grid.name, number);
  // Which fruits are kept must not depend on what else is drawn.
  Varied varied(plant, ~own);
  std::vector<world::Setting> settings;
  for (const auto& [key, text] : world::draw(grid.vary, own)) {
    const SourcePosition& where =
        std::ranges::find(grid.vary, key, &world::VariedNumber::key)->where;
    const auto known = std::ranges::find(grid_keys(), key, &GridKey::key);
    if (known == grid_keys().end()) {
      if (plant::find_plant_number(key) || plant::find_shape_factor(key))
        settings.push_back({key, text, where});
      else
        diagnostics.error(where,
                          "vary: unknown key \"" + key + "\", expected one of: " + expected_keys());
      continue;
    }
    const std::optional<double> value = world::to_number(text);
    if (value && io::within(*value, known->bounds))
      varied.set(known->what, *value);
    else
      diagnostics.error(where, "vary: " + key + " is \"" + text + "\" for plant " +
                                   std::to_string(number) + ", expected " +
                                   io::bounds_text(known->bounds));
  }
  apply_plant_overrides(plant, settings, diagnostics);
  pose = varied.placed(pose);
}

}  // namespace pedicel::simulation
