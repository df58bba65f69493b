#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/session/document/document.h"
#include "app/session/document/file_texts.h"
#include "app/session/result.h"

namespace pedicel::app {

class Session;
struct SessionCore;

/// What is meant beside a path to save to.
struct SaveWishes {
  std::string plant;       ///< to a *.plant.yaml: which; empty: the only one
  bool overwrite = false;  ///< over a file that is there, or that another program has changed
};

/// The files of the document. Faults go to the messages; what was open stays.
class SessionFiles {
 public:
  using Settings = std::vector<std::pair<std::string, std::string>>;

  SessionFiles(Session& session, SessionCore& core) : session_(session), core_(core) {}

  /// `unit` (m) is that of the lengths in a lone table or MTG; 0: as the file says. Experiment
  /// folders go to SessionMeasured.
  bool open(const std::filesystem::path& path, double unit = 0.0);
  void open_empty();
  /// A document that was not read from a file of its own.
  void begin(Document document);
  /// Reads the files anew; edits that were not saved are lost (undo brings them back).
  bool reload();
  /// What could not be opened is still to be mended; reload() tries it again.
  bool has_failed() const { return !failed_path_.empty(); }
  const std::filesystem::path& path() const;

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
  /// What makes the document as it was opened, and then the log: as a script it does the same
  /// again. Where files were saved over since, it says in commands what they said.
  std::string script() const;

  bool dirty() const;
  /// The program ends, and nobody wants the edits since the document was saved: their journal goes
  /// with the session.
  void give_up_edits();
  /// The hash of the document that the files hold.
  std::uint64_t saved_hash() const { return saved_hash_; }
  void set_saved_hash(std::uint64_t hash) { saved_hash_ = hash; }
  /// The document's settings that its scene file says since it was saved.
  const Settings& saved_settings() const { return saved_settings_; }
  void set_saved_settings(const Settings& settings) { saved_settings_ = settings; }

 private:
  const Document& document() const;
  Result save_scene(const std::filesystem::path& path, bool overwrite);
  Result save_plant(const std::filesystem::path& path, const SaveWishes& wishes);
  void mark_saved(bool wrote);

  Session& session_;
  SessionCore& core_;
  std::uint64_t saved_hash_ = 0;  // as it was opened or saved
  Settings saved_settings_;
  Document first_;                     // as it was opened
  std::optional<Document> saved_;      // as it was written to its files since
  FileTexts files_;                    // as they were read or written
  std::filesystem::path failed_path_;  // what could not be opened, for reload()
};

}  // namespace pedicel::app
