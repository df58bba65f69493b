#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/session/commands/command.h"
#include "app/session/session_core.h"

namespace pedicel::app {

class SessionFiles;
class SessionFilms;
class SessionMeasured;
class SessionRecovery;
class SessionRobot;
class SessionTuning;

/// Everything that the program's window does, without a window: a document, its history, the
/// simulation that runs it, and the parts for all else. All calls are made from one thread, and
/// none waits for a step. What changes the document goes through run().
class Session {
 public:
  explicit Session(const SessionOptions& options = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Commands.
  /// Does a command of any scope. Document commands refuse as a whole; one whose document cannot be
  /// simulated (and the one before could) is taken back as a whole, with a message, once that is
  /// known.
  Result run(const Command& command);
  Result run_text(const std::string& line);
  /// Where commands wait: until the simulation has done all that was asked of it. What it finds
  /// wrong is the result's fault.
  Result finish(Result result);
  /// Everything until end_gesture() is one step of the history; commands that go on changing the
  /// same thing (a slider, a dragged point) replace each other. Gestures do not nest.
  void begin_gesture() { core_.editor.begin_gesture(); }
  void end_gesture() { core_.editor.end_gesture(); }
  /// As if the gesture had not begun.
  void cancel_gesture() { core_.editor.cancel_gesture(); }
  /// The last edit or, where one was made since, the last pull.
  Result undo();
  Result redo();
  bool can_undo() const;
  const History& history() const { return core_.editor.history(); }
  const Document& document() const { return core_.editor.document(); }
  /// Everything that was done, one line each.
  const std::vector<std::string>& log() const { return core_.editor.log().lines(); }

  // The simulation.
  /// Whether what is simulated is what is drawn: false while it is being built, and where it cannot
  /// be (see messages()).
  bool is_simulated() const { return snapshot()->document_hash == core_.editor.hash(); }
  /// Begins a pull of a place by hand; control() moves and ends it. undo() takes it back: the run
  /// goes to the step where it began. `by_command`: the log has it.
  void begin_pull(const PullPlace& place, const Vec3& target_W, bool by_command = false);
  /// Cuts a stem or a fruit's stalk of the running simulation, by command; undo() takes it back.
  void cut(const std::string& organ, double at);
  RunControl& control() { return core_.control; }
  std::shared_ptr<const Snapshot> snapshot() const { return core_.control.snapshot(); }
  /// Takes what the threads have to tell into messages(); once a frame.
  void update();
  Messages& messages() { return core_.messages; }

  // The parts, a header each.
  SessionFiles& files() { return *files_; }
  SessionFilms& films() { return *films_; }
  SessionMeasured& measured() { return *measured_; }
  const SessionMeasured& measured() const { return *measured_; }
  SessionRecovery& recovery() { return *recovery_; }
  SessionRobot& robot() { return *robot_; }
  SessionTuning& tuning() { return *tuning_; }

 private:
  Result dispatch(const Command& command);

  SessionCore core_;
  std::unique_ptr<SessionFiles> files_;
  std::unique_ptr<SessionFilms> films_;
  std::unique_ptr<SessionMeasured> measured_;
  std::unique_ptr<SessionRecovery> recovery_;
  std::unique_ptr<SessionRobot> robot_;
  std::unique_ptr<SessionTuning> tuning_;
};

}  // namespace pedicel::app
