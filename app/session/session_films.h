#pragma once

#include "app/session/film.h"
#include "app/session/result.h"

namespace pedicel::app {

struct SessionCore;

/// Films of what a session does: when a picture of them is due.
class SessionFilms {
 public:
  explicit SessionFilms(SessionCore& core) : core_(core) {}

  /// Who makes them; null: nobody. Must outlive the session, or be taken back.
  void set_maker(FilmMaker* maker) { maker_ = maker; }
  FilmMaker* maker() const { return maker_; }
  /// Throws as FilmMaker::begin(); UsageError while one is made.
  void begin(const FilmRequest& request);
  /// Closes it; what was made, to be told. Throws UsageError where none is made.
  Result end();

  /// Steps, with the pictures that are due between them where a film is made and commands wait.
  void advance(long steps);
  /// The same for a time (s).
  void run_for(double duration);

 private:
  double next_picture() const;
  void add_due();

  SessionCore& core_;
  FilmMaker* maker_ = nullptr;
  double fps_ = 30.0, start_ = 0.0;  // Hz, s
  long pictures_ = 0;
};

}  // namespace pedicel::app
