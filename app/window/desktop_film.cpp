#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "pedicel/app/ui/free_file_name.h"
#include "pedicel/app/window/desktop.h"
#include "pedicel/app/window/film.h"

/// Films of the window: what runs goes by simulated time, hands by the clock.
namespace pedicel::app {

void Desktop::toggle_video() {
  if (!running())
    ui_.report(ui_.session.run(
        Command("record", {{"file", free_file_name(ui_.output_stem().string(), ".mp4").string()},
                           {"ui", ui_.view.panels_in_pictures ? 1 : 0}})));
  else if (const Result ended = ui_.session.run(Command("stop recording", {})); ui_.report(ended))
    ui_.say(ended.text);
}

void Desktop::begin(const FilmRequest& request) {
  if (!target_) throw NoPictures("no film: nothing is drawn here");
  const int camera = camera_index(*ui_.snapshot, request.camera);
  if (!request.camera.empty()) use_camera(camera);
  // H.264 wants even sides.
  film_ = request;
  film_.size = request.with_interface
                   ? std::array<int, 2>{target_->width() & ~1, target_->height() & ~1}
                   : request.size;
  video_ = open_film(request.file, film_.size[0], film_.size[1], request.fps);
  next_video_picture_ = ui_.now;
  film_time_ = ui_.snapshot->time;
  ui_.session.control().hold_at(film_time_);
  ui_.recording = ui_.filmed = true;
  ui_.say("film begun: " + video_->description());
}

std::string Desktop::end() {
  const auto video = std::move(video_);
  drop_film();
  try {
    video->finish();
  } catch (const render::OutputError& error) {
    return error.what();
  }
  return "film in " + std::filesystem::absolute(video->result()).string();
}

void Desktop::drop_film() {
  video_.reset();
  ui_.recording = ui_.filmed = false;
  ui_.session.control().hold_at({});
}

// Before a picture of a film is made the run goes on by what the film shows in that time, and waits
// there: so pictures are as far apart as the film says, and the same on a slow machine.
void Desktop::lead_film() {
  picture_due_ = video_ && ui_.now >= next_video_picture_;
  if (!picture_due_) return;
  const RunControl& control = ui_.session.control();
  const auto before = control.snapshot();
  const double step = (before->speed > 0.0 ? before->speed : 1.0) / film_.fps;
  const double dt = before->assets ? before->assets->scene.dt : step;
  // Where the run was led elsewhere (reset, a step back, a pause) it goes on from there.
  if (std::abs(before->time - film_time_) > 1.5 * dt) film_time_ = before->time;
  film_time_ += step;
  ui_.session.control().hold_at(film_time_);
  control.wait();
  const auto now = control.snapshot();
  film_runs_ = now->mode == RunMode::playing || now->step != before->step;
}

void Desktop::add() {
  if (!video_ || !picture_due_) return;
  try {
    const render::Image picture = film_picture();
    // While nothing runs pictures are repeated where the machine is slow, so that hands move as
    // fast as they did.
    int copies = 0;
    do {
      video_->add(picture);
      next_video_picture_ += 1.0 / film_.fps;
    } while (!film_runs_ && ui_.now >= next_video_picture_ && ++copies < 30);
    next_video_picture_ = std::max(next_video_picture_, ui_.now);
  } catch (const std::exception& error) {
    drop_film();
    ui_.say(std::string("the film has ended: ") + error.what());
  }
}

render::Image Desktop::film_picture() {
  if (!film_.with_interface) return scene_picture(film_.size[0], film_.size[1]).value();
  const render::Image whole = target_->read();
  render::Image even(whole.width & ~1, whole.height & ~1);
  for (int y = 0; y < even.height; ++y)
    std::copy_n(whole.at(0, y), 3 * static_cast<std::size_t>(even.width), even.at(0, y));
  return even;
}

}  // namespace pedicel::app
