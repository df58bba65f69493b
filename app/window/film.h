#pragma once

#include <functional>
#include <memory>

#include "app/platform/platform.h"
#include "app/session/film.h"
#include "app/window/desktop.h"

namespace pedicel::app {

/// Opens a film's file: *.mp4 (numbered pictures beside it without ffmpeg), or pictures by a name
/// such as frame_%05d.png. Throws UsageError, io::WriteError.
std::unique_ptr<render::VideoWriter> open_film(const std::filesystem::path& file, int width,
                                               int height, double fps);

/// Index of a scene's camera; the first for an empty name, -1 where there is none at all. Throws
/// UsageError that lists them.
int camera_index(const Snapshot& now, const std::string& name);

/// Films of a session without a window: a desktop off screen that is made with the first film.
class OffscreenFilm : public FilmMaker {
 public:
  /// `prepare` is called with the desktop of each film: panels, colours.
  OffscreenFilm(Session& session, const DesktopOptions& options,
                std::function<void(Desktop&)> prepare = {});
  ~OffscreenFilm() override;

  void begin(const FilmRequest& request) override;
  bool running() const override { return video_ != nullptr; }
  void add() override;
  std::string end() override;

 private:
  void open_desktop();
  void look();

  Session& session_;
  DesktopOptions options_;
  std::function<void(Desktop&)> prepare_;
  FilmRequest request_;
  std::unique_ptr<Platform> platform_;
  std::unique_ptr<Desktop> desktop_;
  std::unique_ptr<render::VideoWriter> video_;
  bool first_ = true;
};

}  // namespace pedicel::app
