#include "app/window/window_film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/session/session_films.h"
#include "app/ui/free_file_name.h"
#include "app/ui/ui.h"
#include "app/window/film.h"
#include "app/window/scene_pane.h"
#include "app/window/window_painter.h"

/// Films of the window: what runs goes by simulated time, hands by the clock.
namespace pedicel::app {

void WindowFilm::toggle() {
  if (!running())
    ui_.report(ui_.session.run(
        Command("record", {{"file", free_file_name(ui_.output_stem().string(), ".mp4").string()},
                           {"ui", ui_.view.panels_in_pictures ? 1 : 0}})));
  else if (const Result ended = ui_.session.run(Command("stop recording", {})); ui_.report(ended))
    ui_.say(ended.text);
}

void WindowFilm::begin(const FilmRequest& request) {
  const render::RenderTarget* target = window_.target();
  if (!target) throw NoPictures("no film: nothing is drawn here");
  const int camera = camera_index(*ui_.snapshot, request.camera);
  if (!request.camera.empty()) scene_.use_camera(camera);
  // H.264 wants even sides.
  request_ = request;
  request_.size = request.with_interface
                      ? std::array<int, 2>{target->width() & ~1, target->height() & ~1}
                      : request.size;
  video_ = open_film(request.file, request_.size[0], request_.size[1], request.fps);
  next_picture_ = ui_.now;
  run_time_ = ui_.snapshot->time;
  ui_.session.control().hold_at(run_time_);
  ui_.recording = ui_.filmed = true;
  ui_.say("film begun: " + video_->description());
}

WindowFilm::WindowFilm(Ui& ui, ScenePane& scene, const WindowPainter& window)
    : ui_(ui), scene_(scene), window_(window) {
  if (!ui.session.films().maker()) ui.session.films().set_maker(this);
}

WindowFilm::~WindowFilm() {
  if (video_) end();
  if (ui_.session.films().maker() == this) ui_.session.films().set_maker(nullptr);
}

std::string WindowFilm::end() {
  const auto video = std::move(video_);
  drop();
  try {
    video->finish();
  } catch (const render::OutputError& error) {
    return error.what();
  }
  return "film in " + std::filesystem::absolute(video->result()).string();
}

void WindowFilm::drop() {
  video_.reset();
  ui_.recording = ui_.filmed = false;
  ui_.session.control().hold_at({});
}

// Before a picture of a film is made the run goes on by what the film shows in that time, and waits
// there: so pictures are as far apart as the film says, and the same on a slow machine.
void WindowFilm::lead_run() {
  is_due_ = video_ && ui_.now >= next_picture_;
  if (!is_due_) return;
  const RunControl& control = ui_.session.control();
  const auto before = control.snapshot();
  const double step = (before->speed > 0.0 ? before->speed : 1.0) / request_.fps;
  const double dt = before->assets ? before->assets->scene.dt : step;
  // Where the run was led elsewhere (reset, a step back, a pause) it goes on from there.
  if (std::abs(before->time - run_time_) > 1.5 * dt) run_time_ = before->time;
  run_time_ += step;
  ui_.session.control().hold_at(run_time_);
  control.wait();
  const auto now = control.snapshot();
  run_goes_on_ = now->mode == RunMode::playing || now->step != before->step;
}

void WindowFilm::add() {
  if (!video_ || !is_due_) return;
  try {
    const render::Image made = picture();
    // While nothing runs pictures are repeated where the machine is slow, so that hands move as
    // fast as they did.
    int copies = 0;
    do {
      video_->add(made);
      next_picture_ += 1.0 / request_.fps;
    } while (!run_goes_on_ && ui_.now >= next_picture_ && ++copies < 30);
    next_picture_ = std::max(next_picture_, ui_.now);
  } catch (const std::exception& error) {
    drop();
    ui_.say(std::string("the film has ended: ") + error.what());
  }
}

render::Image WindowFilm::picture() {
  if (!request_.with_interface) return scene_.picture(request_.size[0], request_.size[1]).value();
  const render::Image whole = window_.target()->read();
  render::Image even(whole.width & ~1, whole.height & ~1);
  for (int y = 0; y < even.height; ++y)
    std::copy_n(whole.at(0, y), 3 * static_cast<std::size_t>(even.width), even.at(0, y));
  return even;
}

}  // namespace pedicel::app
