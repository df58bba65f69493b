#include <algorithm>
#include <array>
#include <cstdio>

#include "app/window/desktop.h"
#include "app/window/film.h"

/// Films of the window, by the clock.
namespace pedicel::app {

std::filesystem::path free_name(const std::string& stem, const std::string& ending) {
  for (int number = 1; number < 10000; ++number) {
    std::array<char, 16> digits{};
    std::snprintf(digits.data(), digits.size(), "%03d", number);
    std::filesystem::path path = stem + "_" + digits.data() + ending;
    if (!std::filesystem::exists(path)) return path;
  }
  return stem + ending;
}

void Desktop::toggle_video() {
  if (!running())
    ui_.report(ui_.session.run(
        Command("record", {{"file", free_name("pedicel", ".mp4").string()}, {"ui", 1}})));
  else if (const Result ended = ui_.session.run(Command("stop recording", {})); ui_.report(ended))
    ui_.say(ended.text);
}

void Desktop::begin(const FilmRequest& request) {
  if (!target_) throw NoPictures("no film: nothing is drawn here");
  // H.264 wants even sides.
  film_ = request;
  film_.size = request.with_interface
                   ? std::array<int, 2>{target_->width() & ~1, target_->height() & ~1}
                   : request.size;
  video_ = open_film(request.file, film_.size[0], film_.size[1], request.fps);
  next_video_picture_ = ui_.now;
  ui_.recording = true;
  ui_.say("film begun: " + video_->description());
}

std::string Desktop::end() {
  ui_.recording = false;
  const auto video = std::move(video_);
  try {
    video->finish();
  } catch (const render::OutputError& error) {
    return error.what();
  }
  return "film in " + std::filesystem::absolute(video->result()).string();
}

void Desktop::add() {
  if (!video_ || ui_.now < next_video_picture_) return;
  try {
    const render::Image picture = film_picture();
    // A slow machine draws fewer a second: pictures are repeated, so that time keeps.
    for (int copies = 0; ui_.now >= next_video_picture_ && copies < 30; ++copies) {
      video_->add(picture);
      next_video_picture_ += 1.0 / film_.fps;
    }
  } catch (const std::exception& error) {
    video_.reset();
    ui_.recording = false;
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
