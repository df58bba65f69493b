#include <imgui.h>

#include <array>

#include "app/editors/effects_part.h"
#include "app/panels/panel.h"
#include "app/session/document/effective_plant.h"
#include "app/session/session_measured.h"
#include "app/ui/theme.h"
#include "app/ui/ui.h"
#include "app/ui/widgets.h"
#include "engine/io/csv.h"
#include "plugins/simulation/plants/rod_options.h"

namespace pedicel::app {

namespace {

/// What the document makes of the solver.
struct Solver {
  cosserat::RodSettings rods;
  coupling::CouplingSettings coupling;
};

Solver solver_of(const world::Scene& scene) {
  Solver solver;
  Diagnostics ignored;  // they were checked when they were set
  simulation::apply_rod_settings(scene.rods, solver.rods, ignored);
  simulation::apply_coupling_settings(scene.coupling, solver.coupling, ignored);
  return solver;
}

void set(Ui& ui, const std::string& key, const std::string& value) {
  ui.run(Command("set", {{"key", key}, {"value", value}}));
}

/// Time, gravity and the solver; and of each plant what is about all of it.
class WorldPanel : public Panel {
 public:
  std::string_view name() const override { return "World"; }
  Dock dock() const override { return Dock::right; }

  void draw(Ui& ui) override {
    const world::Scene scene = scene_of(ui.session.document());
    time(ui, scene);
    gravity(ui, scene);
    solver(ui, scene);
    experiment(ui);
    std::vector<std::string> names;
    for (const DocumentPlant& plant : ui.session.document().plants)
      if (plant.file) names.push_back(plant.entry.name);
    for (const std::string& plant : names) whole_plant(ui, plant);
  }

 private:
  static void time(Ui& ui, const world::Scene& scene) {
    heading(ui, "Time");
    double dt = 1e3 * scene.dt, duration = scene.duration;
    if (labelled_number(ui, "Step", "ms", dt)) set(ui, "dt", io::exact_number(dt / 1e3));
    tip("Of the simulation; 1/240 s is 4.167 ms. Another one starts the run anew");
    if (labelled_number(ui, "Duration", "s", duration))
      set(ui, "duration", io::exact_number(duration));
    tip("Of a run off screen; in the window it goes on until it is held");
  }

  static void gravity(Ui& ui, const world::Scene& scene) {
    heading(ui, "Gravity, m/s2");
    Vec3 g = scene.gravity;
    bool typed = false;
    constexpr std::array<const char*, 3> axes = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis)
      typed = labelled_number(ui, axes[static_cast<std::size_t>(axis)], "", g[axis]) || typed;
    struct Place {
      const char* name;
      double g;
    };
    constexpr std::array<Place, 3> places = {{{"Earth", 9.81}, {"Moon", 1.62}, {"None", 0.0}}};
    for (const Place& place : places) {
      if (&place != places.data()) stay_in_row(place.name);
      if (ImGui::Button(place.name)) g = Vec3(0, 0, -place.g), typed = true;
    }
    if (!typed) return;
    g += Vec3(Vec3::Zero());  // no -0
    set(ui, "gravity",
        io::exact_number(g.x()) + "," + io::exact_number(g.y()) + "," + io::exact_number(g.z()));
  }

  template <std::size_t count>
  static void words(Ui& ui, const char* label, const char* key, int now,
                    const std::array<const char*, count>& all, const char* what) {
    ImGui::TextColored(palette().dim, "%s", label);
    tip(what);
    ImGui::PushID(key);
    for (std::size_t i = 0; i < count; ++i) {
      std::string shown = all[i];
      for (char& c : shown)
        if (c == '_') c = ' ';
      if (i) stay_in_row(shown.c_str());
      if (ImGui::RadioButton(shown.c_str(), now == static_cast<int>(i)) &&
          now != static_cast<int>(i))
        set(ui, key, all[i]);
      tip(what);
    }
    ImGui::PopID();
  }

  static void solver(Ui& ui, const world::Scene& scene) {
    const Solver now = solver_of(scene);
    heading(ui, "Solver");
    words(ui, "Stems", "rods.solver", static_cast<int>(now.rods.solver),
          std::array<const char*, 2>{"direct", "position_based"},
          "Direct: Newton's method, exact. Position based: sweeps, fast and softer");
    words(ui, "Integrator", "rods.integrator", static_cast<int>(now.rods.integrator),
          std::array<const char*, 2>{"backward_euler", "bdf2"},
          "Backward Euler damps; BDF2 keeps swinging truer");
    words(ui, "Plants and robot", "coupling.direction", now.coupling.two_way ? 1 : 0,
          std::array<const char*, 2>{"one_way", "two_way"},
          "One way: the robot does not feel the plants");
    note("All numbers of the solver and the contacts are in Tune.");
  }

  static void experiment(Ui& ui) {
    if (ui.session.measured().folder().empty()) return;
    heading(ui, "Experiment");
    if (wide_button("Close experiment")) ui.run(Command("close experiment", {}));
    tip("Leaves the measured data; what stands in the scene stays");
  }

  static void whole_plant(Ui& ui, const std::string& plant) {
    ImGui::PushID(plant.c_str());
    if (ImGui::CollapsingHeader(plant.c_str(), ImGuiTreeNodeFlags_DefaultOpen)) {
      shape(ui, plant);
      look(ui, plant);
      sampling(ui, plant);
      heading(ui, "Effects");
      draw_effects(ui, plant);
    }
    ImGui::PopID();
  }

  static void shape(Ui& ui, const std::string& plant) {
    const bool unloaded = ui.session.document().plant(plant).shape == plant::Shape::rest;
    ImGui::TextColored(palette().dim, "The drawing is");
    choose(ui, plant, "set shape", "shape", unloaded,
           {{{"how it hangs", "drawn", "Under its own weight the plant hangs as it is drawn"},
             {"unloaded", "rest", "The drawing is the plant without weight: it sags from there"}}});
  }

  static void look(Ui& ui, const std::string& plant) {
    const bool apple = ui.session.document().plant(plant).look == plant::Look::apple;
    ImGui::TextColored(palette().dim, "It looks like");
    choose(ui, plant, "set plant look", "look", apple,
           {{{"a tomato", "tomato", "Green stems and tomatoes; no motion changes"},
             {"an apple tree", "apple", "Bark and apples; no motion changes"}}});
  }

  struct Choice {
    const char *label, *word, *what;
  };

  /// Two buttons in a row, of which `now` is chosen; another one runs the command with its word.
  static void choose(Ui& ui, const std::string& plant, const char* command, const char* argument,
                     std::size_t now, const std::array<Choice, 2>& choices) {
    for (std::size_t c = 0; c < choices.size(); ++c) {
      if (c > 0) stay_in_row(choices[c].label);
      if (ImGui::RadioButton(choices[c].label, now == c) && now != c)
        ui.run(Command(command, {{"plant", plant}, {argument, choices[c].word}}));
      tip(choices[c].what);
    }
  }

  static void sampling(Ui& ui, const std::string& plant) {
    const plant::PlantFile file = ui.session.document().plant(plant);
    double distance = 1e3 * file.distance, connect = 1e3 * file.connect;
    const auto write = [&](const char* key, double millimetres) {
      ui.run(
          Command("set sampling", {{"plant", plant}, {"key", key}, {"value", millimetres / 1e3}}));
    };
    if (labelled_number(ui, "Nodes every", "mm", distance)) write("distance", distance);
    tip("Finer is more exact and slower");
    if (labelled_number(ui, "Joins ends within", "mm", connect)) write("connect", connect);
    tip("An end of a curve that is nearer than this to another curve is joined to it");
    if (who_sets(ui.session.document(), plant, "sampling.distance").by != SetBy::file)
      note("The distance is set elsewhere: by the scene, or in Tune.");
  }
};

}  // namespace

std::unique_ptr<Panel> make_world_panel() {
  return std::make_unique<WorldPanel>();
}

}  // namespace pedicel::app
