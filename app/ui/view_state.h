#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/frames.h"
#include "engine/world/recorder.h"
#include "plugins/plant/plant_numbers.h"

namespace pedicel::app {

/// What gives stems their colour.
enum class ColourMap { none, strain, margin, contact, residual };

/// What is shown of a measured experiment.
struct MeasuredView {
  int number = 0;  ///< MeasuredData::number() that this was chosen for
  int scene = 0;   ///< MeasuredScene::number(), likewise
  int trial = 0;
  int model = 0;  ///< discrepancy::Model
  int marker = 0;
  double time = 0.0;  ///< s, within the trial
  bool playing = false;
  bool markers = true;          ///< measured and simulated places
  bool errors = true;           ///< from the simulated to the measured ones
  double error_scale = 5.0;     ///< 1, their length over the error's
  bool shape = true;            ///< the plant as the model has it, in place of the running one
  bool side_by_side = false;    ///< all models beside each other
  double residual_scale = 0.0;  ///< m, upper end of the residual colours; follows the model
  int instrument = 0;           ///< of a measured scene: of the trial's instruments
  int column = 0;               ///< of that instrument
  int camera = -1;              ///< of a measured scene, looked through; -1: none
};

/// What is known of the run, for the line of time.
struct SeenRun {
  std::uint64_t stage = 0;                                  ///< of the simulation
  double until = 0.0;                                       ///< s, that it has been
  std::size_t breaks = 0;                                   ///< that were told
  std::shared_ptr<const std::vector<world::Event>> events;  ///< until then
};

/// What the picture of the scene shows.
struct ViewState {
  ColourMap colours = ColourMap::none;
  double strain_scale = 0.1;   ///< 1, upper end of the strain colours
  double contact_scale = 5.0;  ///< N, upper end of the contact colours
  bool shadows = true;
  bool contacts = false;  ///< arrows of contact forces
  bool frames = false;    ///< axes of links and tool
  bool rods = false;      ///< elements and nodes as lines
  bool leaves = true;
  bool labels = false;             ///< names of fruits
  bool ghost = true;               ///< the robot where it is told to go
  bool tool_handles = true;        ///< to drag the tool by
  bool tool_axes = false;          ///< the handles turn with the tool; else they are the world's
  bool robot_panel = false;        ///< the Robot panel is in front
  bool goal_missed = false;        ///< the tool was asked to go where it cannot
  std::string goal_hits;           ///< what the robot runs into there: "link_5 into tray"
  bool panels_in_pictures = true;  ///< pictures and films are of the whole window
  bool automatic_quality = true;
  int quality = 1;
  int camera = -1;  ///< of the scene's; -1: led by hand
  SeenRun seen;
  MeasuredView measured;
  int hidden_plant = -1;         ///< of the snapshot, shown otherwise; -1: none
  bool hides_plants = false;     ///< all of the snapshot are shown otherwise
  std::vector<Pose> links;       ///< of the robot, in place of the snapshot's; empty: none
  int residual_plant = -1;       ///< of the snapshot, that `residual` is about
  std::vector<double> residual;  ///< m, one an element; NaN: not known
};

/// What a person points at or has chosen.
struct Selection {
  enum class Kind {
    none,
    element,
    fruit,
    link,
    body,
    curve_point,
    curve,
    plant,
    camera,
    ground,
    tie
  };
  Kind kind = Kind::none;
  int plant = -1, element = -1, fruit = -1, link = -1, body = -1;  ///< of the snapshot
  std::string plant_name, curve;  ///< of the document: curve, curve_point, plant
  std::string thing;              ///< of the document: body, camera
  int point = -1;
  int tie = -1;                 ///< of the document's scene, from 0
  bool to_tip = false;          ///< element: from the place on to the stem's tip
  double back = 0.0;            ///< m, place on the element
  Vec3 place_W = Vec3::Zero();  ///< m, where it was hit
  double distance = 0.0;        ///< m, from the eye

  explicit operator bool() const { return kind != Kind::none; }
  bool same_thing(const Selection& other) const {
    return kind == other.kind && plant == other.plant && element == other.element &&
           fruit == other.fruit && link == other.link && body == other.body &&
           plant_name == other.plant_name && curve == other.curve && thing == other.thing &&
           point == other.point && tie == other.tie && to_tip == other.to_tip;
  }
};

enum class PlaneChoice { upright, view, ground, tangent };
enum class DrawDepth { cursor, surface };
enum class DrawThing { stem, fruit, leaf, trim, tie };

/// The draw tool: its options, with Blender's names, and the stroke in hand.
struct DrawMode {
  bool on = false;
  DrawThing thing = DrawThing::stem;
  double tolerance = 0.003;  ///< m, fit
  bool detect_corners = true;
  double radius_min = 0.0015, radius_max = 0.004;  ///< m
  double taper_start = 0.0, taper_end = 1.0;       ///< 1, share of the way from max to min
  PlaneChoice plane = PlaneChoice::upright;
  DrawDepth depth = DrawDepth::surface;
  bool only_first = true;                             ///< depth taken from the stroke's start
  double offset = 0.0;                                ///< m, from the surface
  double fruit_radius = 0.012;                        ///< m
  double fruit_density = plant::usual_fruit_density;  ///< kg/m3
  double fruit_stretch = 0.15;                        ///< 1, threshold of its stalk
  double fruit_force = 3.0;  ///< N, threshold of its stalk: what a ripe cherry tomato takes
  double leaf_size = 0.08;   ///< m
  std::string leaf_template = "tomato";  ///< of those beside the program

  double tie_stiffness = 1.0e4;  ///< N/m
  double tie_slack = 0.0;        ///< m, that a new one is longer than its way

  int copies = 1;                     ///< of Repeat
  double copy_spacing = 0.03;         ///< m, along the parent
  double copy_angle = 2.4;            ///< rad, about the parent
  Vec3 mirror_normal = Vec3::Zero();  ///< 1; zero: the other side of the parent

  std::string plant;  ///< that strokes go to
};

}  // namespace pedicel::app
