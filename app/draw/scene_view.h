#pragma once

#include <memory>
#include <vector>

#include "app/draw/named_things.h"
#include "app/draw/pictures.h"
#include "app/draw/plant_drawing.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// Turns a simulation as it stands into a frame to be drawn.
class SceneView {
 public:
  /// The simulation must outlive it.
  explicit SceneView(const simulation::Simulation& simulation);

  /// Fills an empty frame. With `strain`, stems have the colour of their strain.
  void fill(Frame& frame, bool strain = false);

  /// What the labels of a frame mean.
  const NamedThings& things() const { return things_; }

  /// The scene's camera of that name (empty: the first), or one that shows everything where the
  /// scene has none.
  render::Camera camera(const std::string& name, const Frame& frame) const;

 private:
  void add_bodies(render::DrawList& list);
  void add_texts(Frame& frame, bool strain) const;

  void label_plant(int plant);
  void label_fruit(render::DrawList& shape, const simulation::Detached& fruit) const;

  const simulation::Simulation& simulation_;
  NamedThings things_;
  std::vector<PlantDrawing> plants_;
  std::vector<render::DrawList> links_, bodies_;
  double strain_scale_ = 0.1;  // 1
};

}  // namespace pedicel::app
