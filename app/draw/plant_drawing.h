#pragma once

#include <optional>
#include <vector>

#include "app/draw/drawing.h"
#include "plugins/cosserat/model/rod_state.h"
#include "plugins/simulation/plants/surface_strain.h"

namespace pedicel::app {

struct PlantLook {
  render::Shading stem = render::shadings::stem;
  render::Shading vein{render::Colour::hex(0x6fa84a), 0.6f, 0.3f};  ///< rods of a leaf
  render::Shading blade = render::shadings::leaf;
  FruitLook fruit;

  static PlantLook tomato() { return {}; }
  static PlantLook apple();
  static PlantLook of(plant::Look look);
};

/// A plant prepared for drawing.
class PlantDrawing {
 public:
  /// The model must outlive it, and its fruits and organs stay as they are.
  PlantDrawing(const cosserat::RodModel& model, std::vector<simulation::Blade> blades = {},
               const PlantLook& look = PlantLook::tomato());

  /// What organs and fruits are called in label maps; without it none has a name.
  void set_labels(std::vector<render::Label> organs, std::vector<render::Label> fruits);

  /// Adds the plant as it stands: every organ as a smooth tube along its elements, leaf blades, and
  /// the fruits that are still on; what has come off is left out. With `strain_scale`, stems are
  /// coloured by surface_strain() on a scale from 0 to that value (> 0).
  void add_to(render::DrawList& list, const cosserat::RodState& state,
              std::optional<double> strain_scale = {}) const;
  /// The same with a colour for each element; leaf blades and fruits keep theirs. Leaves are left
  /// out without `blades`.
  void add_to(render::DrawList& list, const cosserat::RodState& state,
              const std::vector<render::Colour>& colours, bool blades = true) const;
  /// The colours that elements have by themselves.
  std::vector<render::Colour> plain_colours() const;

 private:
  void add_chains(render::DrawList& list, const cosserat::RodState& state,
                  const std::vector<render::Colour>& colours) const;
  void add_fruits(render::DrawList& list, const cosserat::RodState& state) const;
  void add_blades(render::DrawList& list, const cosserat::RodState& state) const;
  std::vector<render::Colour> colours(const cosserat::RodState& state,
                                      std::optional<double> strain_scale) const;
  const render::Shading& material_of(int element) const;
  render::Label label_of(int element) const {
    return organ_labels_[model_.elements[element].organ];
  }

  const cosserat::RodModel& model_;
  std::vector<simulation::Blade> blades_;
  std::vector<render::Label> organ_labels_, fruit_labels_;
  std::vector<char> is_leaf_;             ///< one entry an organ
  std::vector<render::DrawList> fruits_;  ///< in the frames of the elements that carry them
  PlantLook look_;
};

}  // namespace pedicel::app
