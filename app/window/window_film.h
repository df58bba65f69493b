#pragma once

#include <memory>

#include "app/session/film.h"
#include "engine/render/video.h"

namespace pedicel::app {

class ScenePane;
class WindowPainter;
struct Ui;

/// Films of what the window shows. The session's commands begin and end them.
class WindowFilm : public FilmMaker {
 public:
  /// Keeps references. Makes the session's films, where nobody does yet.
  WindowFilm(Ui& ui, ScenePane& scene, const WindowPainter& window);
  ~WindowFilm() override;

  void begin(const FilmRequest& request) override;
  bool running() const override { return video_ != nullptr; }
  void add() override;
  std::string end() override;

  /// Begins one beside what is open, or ends it.
  void toggle();
  /// Takes the run to the film's next picture, where one is due.
  void lead_run();

 private:
  render::Image picture();
  void drop();

  Ui& ui_;
  ScenePane& scene_;
  const WindowPainter& window_;
  std::unique_ptr<render::VideoWriter> video_;
  FilmRequest request_;
  double next_picture_ = 0.0;  // s, of the platform's clock
  double run_time_ = 0.0;      // s, simulated, that the run may go to
  bool is_due_ = false, run_goes_on_ = false;
};

}  // namespace pedicel::app
