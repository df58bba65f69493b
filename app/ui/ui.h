#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/session/session.h"
#include "app/ui/bindings.h"
#include "app/ui/preferences.h"
#include "app/ui/view_state.h"

struct ImFont;

namespace pedicel::app {

/// A window over the others; one at a time.
enum class Dialog {
  none,
  open,
  save_as,
  help,
  info,
  problem,
  recover,
  unsaved,
  import_plant,
  overwrite,
  add_robot,
  export_plant,
};

/// How fast things go, for the profiler.
struct FrameTimes {
  double picture = 0.0;    ///< s, from picture to picture
  double scene = 0.0;      ///< s, drawing of the scene
  double interface = 0.0;  ///< s, building of the panels
  double list = 0.0;       ///< s, from snapshot to draw list
  long triangles = 0;
  int quality = 0;
  std::string renderer;  ///< OpenGL's driver
  std::string platform;
};

/// Everything that panels see and share during a picture. What changes the document goes through
/// `session`; what changes the view is here.
struct Ui {
  Ui(Session& of, std::shared_ptr<const Snapshot> first) : session(of), snapshot(first) {}

  Session& session;
  std::shared_ptr<const Snapshot> snapshot;  ///< of this picture; never null
  Preferences preferences;
  ViewState view;
  Selection selection, hover;
  DrawMode draw;
  Dialog dialog = Dialog::none;
  FrameTimes times;
  float scale = 1.0f;  ///< px a point of the layout: monitor times font scale
  ImFont* bold = nullptr;

  /// What was asked for by keys, buttons and menus, to be done at the end of the picture.
  std::deque<Action> actions;
  Vec3 view_eye = Vec3::UnitX(), view_target = Vec3::Zero();  ///< m, W: how the scene is seen
  double view_fov = 0.7;                                      ///< rad, vertical
  std::string show_panel;  ///< tab to be brought to the front; emptied by the layout
  std::optional<Eigen::AlignedBox3d> frame_box;  ///< what the camera is to show next
  std::string frame_plant;                       ///< the same, once that plant is simulated
  bool frame_robot = false;  ///< the same of an added robot, where it is not in view
  std::string notice;        ///< one line over the scene that fades
  double notice_time = 0.0;  ///< s, of the platform's clock
  bool unread = false;       ///< a warning that the hidden drawer holds
  double now = 0.0;          ///< s
  bool recording = false;    ///< a film is being made, by hand
  bool filmed = false;       ///< what goes by the wall clock is left out, so that films are alike
  std::string command_line;  ///< typed in the messages panel
  std::string problem;       ///< of a file that could not be read, for the dialog

  void ask(Action action) { actions.push_back(action); }
  /// Runs a command and shows the fault, where it is refused. Whether it was taken.
  bool run(const Command& command);
  bool report(const Result& result);
  void say(const std::string& text) { notice = text, notice_time = now; }

  /// Does what leaves the document: at once, or, where edits were not saved, when the person has
  /// said what is to become of them.
  void leave_document(std::function<void()> next);
  /// Opens a file, so. An experiment's data go beside the document, which stays.
  void open(const std::filesystem::path& path);
  std::function<void()> after_leaving;  ///< waits for that answer
  /// Where pictures, films, tables and exports go, without an ending: beside what is open, with its
  /// name; in the working folder where that has no file or came with the program.
  std::filesystem::path output_stem() const;
  /// Does what waited, once.
  void leave_now();

  /// Saves, or asks for what is missing: a name, or whether a file may be written over.
  void save();
  void save_to(const std::filesystem::path& path, bool overwrite = false);
  /// Asks where that plant is to be written in that form (".csv").
  void ask_export(const std::string& plant, const std::string& ending);
  /// Writes it, or asks before it is written over a file.
  void export_to(const std::filesystem::path& path, bool overwrite = false);
  std::string export_plant, export_ending;  ///< that the dialog asks about
  std::filesystem::path export_path;        ///< that the dialog suggests
  std::filesystem::path overwrite_path;  ///< that the dialog asks about; empty: where it came from
  std::string overwrite_text;
  /// Runs a command that takes something away; what the scene says of it (a robot's program that
  /// goes to it) goes with it in the same step, and that is said.
  bool remove(const Command& command);
  /// The plant that is chosen, or that strokes go to; empty: neither.
  std::string chosen_plant() const;
  /// Adds the plant of a file; it is shown whole once it is built.
  void import_plant(const std::filesystem::path& path);
};

/// "tomato/fruit_3", "link_4", "stem of tomato, point 2": what the selection is.
std::string describe(const Selection& selection, const Snapshot& snapshot);

}  // namespace pedicel::app
