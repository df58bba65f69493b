#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pedicel/app/session/commands/command.h"
#include "pedicel/app/session/document/document.h"
#include "pedicel/app/session/document/document_parameters.h"
#include "pedicel/app/session/document/file_texts.h"
#include "pedicel/app/session/film.h"
#include "pedicel/app/session/history.h"
#include "pedicel/app/session/live/robot_goal.h"
#include "pedicel/app/session/live/run_control.h"
#include "pedicel/core/parameter.h"
#include "pedicel/robot/inverse_kinematics.h"

namespace pedicel::app {

class ExperimentReading;
class Journal;
class MeasuredData;

/// Something to tell the user.
struct Message {
  Severity severity = Severity::error;
  std::string text;  ///< one or more lines, "file:line:column: error: ..." where a file is meant
  std::string sentence;    ///< the same without the word, for what says by itself that it failed
  bool can_retry = false;  ///< reload() reads the file again
  int times = 1;           ///< that it was said
};

/// What became of a command.
struct Result {
  bool ok = true;
  std::string text;         ///< the fault, or what a query answers; may be empty
  bool bad_file = false;    ///< the fault is one of a file that was to be read
  bool overwrites = false;  ///< refused, since a file would be lost: SaveWishes::overwrite does it
  explicit operator bool() const { return ok; }
};

/// Where journals lie by default: $XDG_STATE_HOME/pedicel, else ~/.local/state/pedicel; empty where
/// there is neither.
std::filesystem::path autosave_folder();

/// What is meant beside a path to save to.
struct SaveWishes {
  std::string plant;       ///< to a *.plant.yaml: which; empty: the only one
  bool overwrite = false;  ///< over a file that is there, or that another program has changed
};

struct SessionOptions {
  std::vector<std::string> packages;  ///< "NAME=PATH"
  std::filesystem::path autosave;     ///< folder of the journals; empty: none
  /// Every command waits until the simulation has done it (scripts, tests): then what it finds
  /// wrong is the command's own fault, too.
  bool waits = false;
};

/// Everything that the program's window does, without a window: a document, its history, the
/// simulation that runs it, files, messages. All calls are made from one thread, and none waits for
/// a step. What changes the document goes through run().
class Session {
 public:
  explicit Session(const SessionOptions& options = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Files. Faults go to messages(); what was open stays.
  /// `unit` (m) is that of the lengths in a lone table or MTG; 0: as the file says.
  bool open(const std::filesystem::path& path, double unit = 0.0);
  void open_empty();
  /// Reads the files anew; edits that were not saved are lost (undo brings them back).
  bool reload();
  /// Without a path: what has changed into the files it came from; plants that have none get one
  /// beside the scene. To a *.scene.yaml: the scene with everything, which is open from then on;
  /// files that are there stay as they are. To a *.plant.yaml: one plant, and nothing else is
  /// written; where it is all that there is, that is its file from then on. What was in a file
  /// before stays beside it as NAME~; comments and layout stay. A file that is there, and one that
  /// another program has changed since it was read, is written over where that is wished.
  Result save(const std::filesystem::path& path = {}, const SaveWishes& wishes = {});
  /// Whether save() would ask for a path.
  bool needs_name() const;
  /// A name to save under that fits what is open, and is free.
  std::filesystem::path suggested_name() const;
  /// One plant as it is drawn: *.plant.yaml, *.csv (skeleton), *.obj or *.ply.
  Result export_plant(const std::string& plant, const std::filesystem::path& path);
  /// Adds the plant of a plant file, skeleton table or MTG to the document.
  Result import_plant(const std::filesystem::path& path, const std::string& name = {},
                      double unit = 0.0);
  bool dirty() const;
  /// The program ends, and nobody wants the edits since the document was saved: their journal goes
  /// with the session.
  void give_up_edits() { saved_hash_ = hash_; }
  const std::filesystem::path& path() const { return document_.path; }

  // Commands.
  /// Does a command of any scope. Document commands refuse as a whole; one whose document cannot be
  /// simulated (and the one before could) is taken back as a whole, with a message, once that is
  /// known.
  Result run(const Command& command);
  Result run_text(const std::string& line);
  /// Everything until end_gesture() is one step of the history; commands that go on changing the
  /// same thing (a slider, a dragged point) replace each other. Gestures do not nest.
  void begin_gesture();
  void end_gesture();
  /// As if the gesture had not begun.
  void cancel_gesture();
  /// The last edit or, where one was made since, the last pull.
  Result undo();
  Result redo();
  bool can_undo() const;
  const History& history() const { return history_; }
  const Document& document() const { return document_; }
  const SessionOptions& options() const { return options_; }
  /// Whether what is simulated is what is drawn: false while it is being built, and where it cannot
  /// be (see messages()).
  bool is_simulated() const { return snapshot()->document_hash == hash_; }
  /// Everything that was done, one line each.
  const std::vector<std::string>& log() const { return log_; }
  /// What makes the document as it was opened, and then the log: as a script it does the same
  /// again. Where files were saved over since, it says in commands what they said.
  std::string script() const;

  // The simulation.
  /// Begins a pull of a place by hand; control() moves and ends it. undo() takes it back: the run
  /// goes to the step where it began.
  /// `by_command`: the log has it.
  void begin_pull(const PullPlace& place, const Vec3& target_W, bool by_command = false);
  RunControl& control() { return control_; }
  const RunControl& control() const { return control_; }
  std::shared_ptr<const Snapshot> snapshot() const { return control_.snapshot(); }
  /// Takes what the simulation's thread has to tell into messages(); once a frame.
  void update();

  /// The newest last, each text once. Faults of files go once the files can be read.
  const std::vector<Message>& messages() const { return messages_; }
  /// How many there were since the start, those that have gone too.
  std::size_t messages_said() const { return said_; }
  void clear_messages() { messages_.clear(); }
  /// Something that may be read again there.
  void tell(const std::string& text) { say(Severity::notice, text); }

  // Parameters.
  std::vector<SessionParameter> parameters() const;
  /// Sets a parameter back to what the files say.
  Result reset_parameter(const std::string& key);
  /// Writes changed plant parameters into the plants themselves, so that saving keeps them.
  Result keep_parameters();
  Result discard_parameters();

  // Robot.
  /// Joint positions with which the tool is at a pose (without `turned`: at its place, turned
  /// anyhow); `reached` false and a sentence where it cannot be. Starts from the goal that the
  /// robot has.
  robot::IkResult reach(const Pose& tool_W, bool turned = true) const;
  /// Where the tool was asked to go, and whether it can; where the robot was told otherwise since,
  /// the tool's place at the end of that. Nothing without a robot.
  std::optional<ToolGoal> tool_goal() const;
  /// Moves the tool to a pose. `turned`: its turn was asked for, too; else an arm with fewer than
  /// six joints may turn it. Where the pose is out of reach: refused with the sentence, or as near
  /// as can be, and the answer has the sentence.
  Result aim_tool(const Pose& tool_W, bool turned, bool as_near_as_can_be);
  /// Moves the tool by a shift (m, W) and a turn (rad, a rotation vector, W), or says why not.
  Result jog(const Vec3& shift_W, const Vec3& turn_W = Vec3::Zero());
  /// Moves one joint, the gripper or all joints (rad or m) by hand. Throws UsageError.
  Result move_joint(const std::string& name, double value);
  Result move_gripper(double value);
  Result move_joints(const Eigen::VectorXd& q);
  /// Moves all joints to where they stand at time 0.
  Result home_robot();
  /// Ends what the robot plays.
  Result stop_robot();
  /// Leads the tool to a fruit (PLANT/FRUIT), shuts the gripper on it and pulls it from there by
  /// `pull_W` (m); without that up, as far as the arm comes.
  Result pick(const std::string& organ, const std::optional<Vec3>& pull_W = {});
  /// Whether somebody leads the robot by hand, rather than that it follows what the scene says.
  bool robot_is_led() const;
  /// Plays the recorded waypoints from now on; with `loops` over and over until it is stopped: the
  /// way back to the first takes the time that the joints need by hand.
  Result play_waypoints(bool loops = false);
  /// Of a table time_s,joint,... ; its time 0 is now.
  Result play_trajectory(const std::filesystem::path& file, bool loops = false);
  /// The waypoints as such a table.
  Result save_waypoints(const std::filesystem::path& file) const;
  /// Takes the rows of such a table as the waypoints, as one step of the history.
  Result load_waypoints(const std::filesystem::path& file);

  // Measured data.
  /// Opens an experiment folder. Where no plant of the document has its curves, the document
  /// becomes its nominal plant alone, without a file, so that saving leaves the experiment as it
  /// is; refused where that would lose changes. Read on a thread of its own: update() takes it
  /// over, and its faults become messages. Where commands wait, it is open on return.
  Result open_experiment(const std::filesystem::path& path);
  /// The experiment that is being read; null: none is.
  const ExperimentReading* reading() const { return reading_.get(); }
  /// Drops what is being read.
  void cancel_reading();
  /// Waits until what is being read is open (scripts, tests).
  Result finish_reading();
  /// Why the last one could not be opened; empty: it could.
  const std::string& reading_fault() const { return reading_fault_; }
  MeasuredData& measured() { return *measured_; }
  const MeasuredData& measured() const { return *measured_; }
  /// The plant of the document that was measured; -1: none.
  int measured_plant() const;
  /// Gives the measured plant the effects of the extended one, as one step of the history.
  Result accept_diagnosis();
  /// Begins a diagnosis; where commands wait, it is done on return, with its headline. `threads` 0:
  /// all cores but one.
  Result diagnose(int threads, std::uint64_t seed);
  /// Writes report.html, verdict.json and extended.plant.yaml.
  Result write_report(const std::filesystem::path& folder) const;

  // Films.
  /// Who makes them; null: nobody. Must outlive the session, or be taken back.
  void set_film_maker(FilmMaker* maker) { film_ = maker; }
  FilmMaker* film_maker() const { return film_; }
  /// Throws as FilmMaker::begin(); UsageError while one is made.
  void begin_film(const FilmRequest& request);
  /// Steps, with the pictures that are due between them where a film is made and commands wait.
  void advance(long steps);
  /// The same for a time (s).
  void run_for(double duration);
  /// Closes it; what was made, to be told. Throws UsageError where none is made.
  Result end_film();

  // Recovery.
  /// Documents that a killed program left, the newest first. Empty without autosave.
  struct Lost {
    std::filesystem::path file;      ///< the journal
    std::filesystem::path document;  ///< that was open; empty: a new one
    int commands = 0;
    std::string when;  ///< UTC
  };
  std::vector<Lost> lost_documents() const;
  bool recover(const Lost& lost);
  void forget(const Lost& lost);

 private:
  struct Gesture {
    Document before;       // the gesture
    Document before_last;  // its last command
    std::vector<Command> commands;
  };
  /// A pull that undo() would take back.
  struct Pulled {
    std::uint64_t stage = 0;  // of the simulation
    long step = 0;            // where it began
    std::size_t history = 0;  // steps of the document then
    bool by_command = false;  // it is in the log
  };
  /// A fruit that the robot is taking off.
  struct Picked {
    std::string organ;
    std::uint64_t stage = 0;  // of the simulation
    long step = 0;
    double end = 0.0;  // s, of the pull
  };
  /// The last pose asked for.
  struct Aim {
    ToolGoal goal;
    Eigen::VectorXd to;                   // rad or m
    std::uint64_t stage = 0, number = 0;  // of the snapshot it was asked at
    long step = 0;
  };
  void set_document(Document document);
  Result save_scene(const std::filesystem::path& path, bool overwrite);
  Result save_plant(const std::filesystem::path& path, const SaveWishes& wishes);
  void mark_saved(bool wrote);
  void rebuild(bool restart = false);
  Result dispatch(const Command& command);
  void take_back(const Document& document);
  void take_news(const BuildNews& news);
  bool take_back_unbuilt();
  void forget_in_log(const std::vector<Command>& commands);
  void forget_file_faults();
  Result change_document(const Command& command);
  void record(History::Step step);
  void note(const std::string& line);
  void note_step(const std::string& verb, const History::Step& step);
  void add_to_journal(const std::string& line);
  void begin_journal();
  void tell_pick();
  Result play(robot::Trajectory trajectory, bool loops);
  robot::Trajectory waypoint_trajectory(const robot::KinematicModel& model) const;
  void note_pull(bool by_command);
  bool has_pull() const;
  Result undo_pull();
  void film_due();
  double next_picture() const;
  void leave_experiment();
  Result adopt(ExperimentReading& reading);
  void tell_faults(const std::vector<std::string>& faults);
  Result finish(Result result);
  void say_remarks(const Diagnostics& remarks);
  void say(Severity severity, const std::string& text, bool can_retry = false);
  void say(const std::vector<Diagnostic>& problems, bool can_retry);
  void add_message(Message message);

  SessionOptions options_;
  Document document_;
  std::uint64_t hash_ = 0, saved_hash_ = 0;  // of the document; as it was opened or saved
  // The document's settings that its scene file says since it was saved.
  std::vector<std::pair<std::string, std::string>> saved_settings_;
  Document first_;                 // as it was opened
  std::optional<Document> saved_;  // as it was written to its files since
  FileTexts files_;                // as they were read or written
  History history_;
  std::optional<Gesture> gesture_;
  std::vector<std::string> log_;
  std::vector<Message> messages_;
  std::size_t said_ = 0;
  bool built_ = false;                // something of this document
  std::optional<BuildNews> unbuilt_;  // the document of now cannot be built
  std::unique_ptr<Journal> journal_;
  std::filesystem::path failed_path_;  // what could not be opened, for reload()
  std::unique_ptr<MeasuredData> measured_;
  std::optional<Aim> aim_;
  std::optional<Picked> picked_;
  std::vector<Pulled> pulls_;  // the last one at the end
  FilmMaker* film_ = nullptr;
  double film_fps_ = 30.0, film_start_ = 0.0;  // Hz, s
  long film_pictures_ = 0;
  std::unique_ptr<ExperimentReading> reading_;
  std::vector<std::unique_ptr<ExperimentReading>> dropped_;  // cancelled, not ended yet
  std::string reading_fault_;
  RunControl control_;
};

}  // namespace pedicel::app
