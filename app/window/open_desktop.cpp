#include "app/window/open_desktop.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "app/report/headless.h"
#include "app/report/version.h"
#include "app/session/measured/measured_data.h"
#include "app/session/script.h"
#include "app/session/session_files.h"
#include "app/session/session_films.h"
#include "app/session/session_measured.h"
#include "app/session/session_recovery.h"
#include "app/window/desktop.h"
#include "app/window/film.h"
#include "app/window/measured_image.h"
#include "app/window/playback_window.h"
#include "engine/core/check.h"
#include "engine/core/stop.h"
#include "engine/io/asset_folder.h"
#include "engine/world/settings.h"

namespace pedicel::app {

namespace {

constexpr int no_opengl = 77, invalid_file = 3, unstable = 4;

/// False, with the faults on standard error, where it cannot be opened.
bool open_file(Session& session, const DesktopRequest& request) {
  const auto first = io::asset_folder() / "scenes" / "cherry_tomato_pull_aside.scene.yaml";
  const bool opened = session.files().open(
      request.file.empty() ? first : std::filesystem::path(request.file), request.unit);
  for (const Message& message : session.messages().all())
    std::fprintf(stderr, "%s\n", message.text.c_str());
  for (const std::string& assignment : request.set) {
    const auto [key, value] = world::split_assignment(assignment);
    const Result set = session.run(Command("set", {{"key", key}, {"value", value}}));
    if (!set.ok) throw UsageError("--set " + assignment + ": " + set.text);
  }
  return opened;
}

void show_parts(Desktop& desktop, const DesktopRequest& request) {
  if (request.colours == "strain") desktop.ui().view.colours = ColourMap::strain;
  if (request.colours == "margin") desktop.ui().view.colours = ColourMap::margin;
  if (request.colours == "contact") desktop.ui().view.colours = ColourMap::contact;
  if (request.colours == "residual") desktop.ui().view.colours = ColourMap::residual;
  for (const std::string& panel : request.show) {
    const auto& all = desktop.layout().panels();
    if (std::ranges::none_of(all, [&](const auto& one) { return one->name() == panel; }))
      throw UsageError("--show " + panel + ": there is no such panel");
    desktop.ui().show_panel = panel;
    desktop.frame();
  }
}

/// What happened while the window was open, over all documents and resets.
struct Tally {
  long steps = 0, breaks = 0;
  double time = 0.0, strain = 0.0;  // s, 1

  void add(const Snapshot& s) {
    const std::size_t events = s.events ? s.events->size() : 0;
    if (s.step > last_step) steps += s.step - last_step, time += s.time - last_time;
    if (events > last_events) breaks += static_cast<long>(events - last_events);
    last_step = s.step, last_time = s.time, last_events = events;
    strain = std::max(strain, s.largest_strain);
  }

 private:
  long last_step = 0;
  double last_time = 0.0;
  std::size_t last_events = 0;
};

int take_picture(Platform& platform, Session& session, const DesktopRequest& request,
                 const DesktopOptions& options) {
  Desktop desktop(platform, session, options);
  session.control().wait();
  show_parts(desktop, request);
  desktop.ui().preferences.seen_hint = !request.file.empty();
  desktop.ui().view.automatic_quality = false;
  desktop.ui().view.quality = CanvasQuality::best;
  const int measured = measured_camera(session, request.camera);
  if (measured < 0) camera_index(*session.snapshot(), request.camera);  // there is such a one
  if (!request.script.empty())
    if (const int code = run_script(request.script, session, std::cout, std::cerr)) return code;
  if (!session.measured().folder().empty())
    desktop.frame(), desktop.ui().view.measured.time = request.time;
  else if (request.time > 0.0)
    session.control().run_for(request.time);
  session.control().wait();
  // The first pictures lay the panels out and frame the scene; the camera may follow what moves.
  for (int i = 0; i < 5; ++i) {
    desktop.frame();
    if (measured >= 0)
      desktop.ui().view.measured.camera = measured;
    else if (!request.camera.empty())
      desktop.scene().use_camera(camera_index(*session.snapshot(), request.camera));
  }
  desktop.frame();
  const auto picture = request.with_interface
                           ? desktop.window().picture()
                           : desktop.scene().picture(request.size[0], request.size[1]);
  render::write_png(request.screenshot, picture.value());
  return 0;
}

/// The scene from its beginning to its end.
void film_scene(Session& session, const DesktopRequest& request) {
  const world::Scene& scene = session.snapshot()->assets->scene;
  const long steps = std::lround(request.duration.value_or(scene.duration) / scene.dt);
  const long some = std::max(1l, std::lround(0.5 / scene.dt));
  const bool tells = !request.quiet && isatty(2);
  for (long done = 0; done < steps && !stop_requested; done += some) {
    session.films().advance(std::min(some, steps - done));
    if (session.snapshot()->mode == RunMode::unstable) return;
    if (tells)
      std::fprintf(stderr, "\r%5.1f %%",
                   100.0 * static_cast<double>(done) / static_cast<double>(steps));
  }
  if (tells) std::fprintf(stderr, "\r");
}

/// A film, picture by picture: of the scene as it is, or of what a script does.
int make_film(const DesktopRequest& request, const DesktopOptions& options) {
  SessionOptions about;
  about.packages = request.packages;
  about.waits = true;
  Session session(about);
  OffscreenFilm film(session, options, [&](Desktop& desktop) { show_parts(desktop, request); });
  session.films().set_maker(&film);
  if (!open_file(session, request)) return invalid_file;
  const world::SceneVideo& video = session.snapshot()->assets->scene.video;
  FilmRequest wanted;
  wanted.file = request.record;
  wanted.fps = request.fps.value_or(video.fps);
  wanted.size = request.sized ? request.size : video.size;
  wanted.camera = request.camera.empty() ? video.camera : request.camera;
  wanted.with_interface = request.with_interface;
  stop_in_good_order();
  session.films().begin(wanted);
  int code = 0;
  if (request.script.empty())
    film_scene(session, request);
  else
    code = run_script(request.script, session, std::cout, std::cerr);
  if (film.running()) {
    const std::string made = film.end();
    if (!request.quiet) std::fprintf(stderr, "%s\n", made.c_str());
  }
  if (code) return code;
  if (session.snapshot()->mode != RunMode::unstable) return stop_requested ? stop_exit_code() : 0;
  std::fprintf(stderr, "error: unstable: %s\n", session.snapshot()->error.c_str());
  return unstable;
}

/// A log in a window of its own kind, until it is closed.
std::optional<int> play_log(const DesktopRequest& request) {
  const LogFilm log(request.file, request.packages);
  for (const std::string& note : log.notes())
    std::fprintf(stderr, "%s: warning: %s\n", request.file.c_str(), note.c_str());
  PlatformOptions where;
  where.size = request.size;
  where.scale = request.scale;
  where.title = std::filesystem::path(request.file).filename().string() + " - Pedicel";
  std::string why;
  const auto platform = open_platform(request.platform, where, why);
  if (!platform) {
    std::fprintf(stderr, "%s\n", why.c_str());
    return std::nullopt;
  }
  stop_in_good_order();
  PlaybackWindow window(*platform, log);
  while (window.frame() && !stop_requested) {
  }
  return stop_requested ? stop_exit_code() : 0;
}

}  // namespace

std::unique_ptr<FilmMaker> make_films(Session& session) {
  return std::make_unique<OffscreenFilm>(session, DesktopOptions{});
}

std::optional<int> open_desktop(const DesktopRequest& request) {
  if (is_playable(request.file)) return play_log(request);
  DesktopOptions options;
  if (request.theme == "light") options.theme = Theme::light;
  options.theme_given = !request.theme.empty();
  if (!request.record.empty()) return make_film(request, options);
  PlatformOptions where;
  where.size = request.size;
  where.scale = request.scale;
  const bool picture = !request.screenshot.empty();
  std::string why;
  const auto platform = open_platform(picture ? "offscreen" : request.platform, where, why);
  if (!platform) {
    std::fprintf(stderr, "%s\n", why.c_str());
    return picture ? std::optional<int>(no_opengl) : std::nullopt;
  }
  SessionOptions about;
  about.packages = request.packages;
  about.waits = picture;
  if (!picture) about.autosave = autosave_folder();
  if (!picture) stop_in_good_order();
  Session session(about);
  if (!picture) options.preferences = preferences_path();
  const bool opened = open_file(session, request);
  if (picture) return opened ? take_picture(*platform, session, request, options) : invalid_file;
  if (request.playing) session.control().play();
  Desktop desktop(*platform, session, options);
  std::fprintf(stderr, "pedicel %s (%s), OpenGL by %s, letters from %s\n", version().c_str(),
               git_hash().c_str(), desktop.ui().times.renderer.c_str(),
               desktop.letters().empty() ? "ImGui" : desktop.letters().c_str());
  if (!session.recovery().lost_documents().empty()) desktop.ui().dialog = Dialog::recover;
  show_parts(desktop, request);
  Tally tally;
  while (desktop.frame() && !stop_requested) tally.add(*desktop.ui().snapshot);
  std::fprintf(stderr, "%ld steps, %.3f s simulated, largest strain %.3f, %ld breaks\n",
               tally.steps, tally.time, tally.strain, tally.breaks);
  return stop_requested ? stop_exit_code() : 0;
}

}  // namespace pedicel::app
