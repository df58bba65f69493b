#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/render/draw_list.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

/// What kind of thing a pixel shows. The numbers are those of class masks, and stay.
enum class ThingClass { background, stem, branch, leaf, fruit, stalk, robot, body, ground };
inline constexpr int thing_classes = 9;
/// "stem"
std::string_view name_of(ThingClass kind);

/// One thing of a scene that pictures tell from others.
struct NamedThing {
  std::string name;  ///< "truss/fruit_3", "arm/link2", "tray", "ground"
  ThingClass kind = ThingClass::background;
  std::string plant;  ///< that it belongs to; empty: none
};

/// Every thing of a simulation that can be seen, with the label that it has in pictures. Labels
/// depend on the scene alone, so a fruit keeps its own when it comes off, and two runs agree.
/// Organs are sorted by what they carry: a leaf has a blade, a stalk ends in a fruit and carries
/// nothing else, a stem is clamped or held, and what is left is a branch.
class NamedThings {
 public:
  explicit NamedThings(const simulation::Simulation& simulation);

  /// By label; the first one is the background.
  std::span<const NamedThing> all() const { return things_; }
  const NamedThing& of(render::Label label) const { return things_[label]; }

  render::Label organ(int plant, int organ) const { return first_organ_[plant] + organ; }
  render::Label fruit(int plant, int fruit) const { return first_fruit_[plant] + fruit; }
  render::Label link(int link) const { return first_link_ + link; }
  /// Of a body of the scene.
  render::Label body(int body) const { return first_body_ + body; }
  render::Label ground() const { return ground_; }
  /// The stalk that comes off with a fruit; the fruit itself where it has none of its own.
  render::Label stub(const cosserat::RodModel& model, int plant, int fruit) const;

 private:
  void add_plant(const simulation::Simulation& simulation, int plant);
  render::Label add(std::string name, ThingClass kind, std::string plant = {});

  std::vector<NamedThing> things_;
  std::vector<render::Label> first_organ_, first_fruit_;
  render::Label first_link_ = 0, first_body_ = 0, ground_ = 0;
};

}  // namespace pedicel::app
