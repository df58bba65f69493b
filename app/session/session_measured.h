#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/session/result.h"

namespace pedicel::app {

class ExperimentReading;
class MeasuredData;
class MeasuredScene;
class Session;
struct DiagnosisCard;
struct DiagnosisProgress;
struct SessionCore;

/// Data that were measured on a plant of the document, or with a robot in the document's scene.
class SessionMeasured {
 public:
  SessionMeasured(Session& session, SessionCore& core);
  ~SessionMeasured();

  /// Opens an experiment folder. Where no plant of the document has its curves, the document
  /// becomes its nominal plant alone, or its scene, without a file, so that saving leaves the
  /// experiment as it is; refused where that would lose changes. Read on a thread of its own:
  /// update() takes it over, and its faults become messages. Where commands wait, it is open on
  /// return.
  Result open(const std::filesystem::path& path);
  /// The experiment that is being read; null: none is.
  const ExperimentReading* reading() const { return reading_.get(); }
  /// Drops what is being read.
  void cancel_reading();
  /// Waits until what is being read is open (scripts, tests).
  Result finish_reading();
  /// Why the last one could not be opened; empty: it could.
  const std::string& reading_fault() const { return reading_fault_; }
  /// Closes the experiment where the document has no plant of it any more.
  void leave();
  /// Closes whichever is open.
  void close();
  /// Takes what the threads have read and found; once a frame.
  void update();

  /// At most one of the two has an experiment: of a plant, or of a robot at plants.
  MeasuredData& data() { return *data_; }
  const MeasuredData& data() const { return *data_; }
  MeasuredScene& scene() { return *scene_; }
  const MeasuredScene& scene() const { return *scene_; }
  /// The plant of the document that was measured; -1: none.
  int plant() const;
  /// Whether the document has the plants of the measured scene.
  bool has_scene() const;

  bool is_diagnosing() const;
  DiagnosisProgress progress() const;
  /// Grows with every diagnosis that came to an end; 0: none did.
  int diagnoses() const { return diagnoses_; }
  /// Of the last one; empty before there is one.
  DiagnosisCard card() const;
  /// Whether what was found can become part of the document, and whether it is.
  enum class Acceptance { impossible, possible, accepted };
  Acceptance acceptance() const;
  /// Of the experiment that is open; empty: none is.
  std::filesystem::path folder() const;

  /// Begins a diagnosis; where commands wait, it is done on return, with its headline. `threads` 0:
  /// all cores but one.
  Result diagnose(int threads, std::uint64_t seed);
  /// Gives the measured plant the effects of the extended one, or the scene those that were found,
  /// as one step of the history.
  Result accept_diagnosis();
  /// Writes report.html, verdict.json and the extended plant or scene.
  Result write_report(const std::filesystem::path& folder) const;

 private:
  Result adopt(ExperimentReading& reading);
  Result adopt_scene(ExperimentReading& reading);
  Result accept_scene();
  void count_diagnoses();
  void tell_faults(const std::vector<std::string>& faults);

  Session& session_;
  SessionCore& core_;
  std::unique_ptr<MeasuredData> data_;
  std::unique_ptr<MeasuredScene> scene_;
  // That were counted; compared, never read.
  const void *last_of_data_ = nullptr, *last_of_scene_ = nullptr;
  int diagnoses_ = 0;
  std::unique_ptr<ExperimentReading> reading_;
  std::vector<std::unique_ptr<ExperimentReading>> dropped_;  // cancelled, not ended yet
  std::string reading_fault_;
};

}  // namespace pedicel::app
