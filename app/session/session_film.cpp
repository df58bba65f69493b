#include <algorithm>
#include <cmath>
#include <cstdio>

#include "pedicel/app/session/session.h"
#include "pedicel/core/check.h"

/// Films of a session.
namespace pedicel::app {

namespace {

std::array<int, 2> size_of(const std::string& text) {
  std::array<int, 2> size{};
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size[0], &size[1], &rest) != 2 || size[0] < 16 ||
      size[1] < 16 || size[0] > 8192 || size[1] > 8192)
    throw UsageError("size \"" + text + "\", expected WxH in px, 16 to 8192 each (1280x720)");
  return size;
}

FilmRequest request_of(const Command& c) {
  FilmRequest request;
  request.file = c.word("file");
  request.fps = c.number_or("fps", request.fps);
  if (!(request.fps > 0.0 && request.fps <= 1000.0))
    throw UsageError("fps, expected Hz above 0 and at most 1000");
  if (c.has("size")) request.size = size_of(c.word("size"));
  request.camera = c.word_or("camera", "");
  request.with_interface = c.whole_or("ui", 0) != 0;
  return request;
}

}  // namespace

void Session::begin_film(const FilmRequest& request) {
  if (!film_) throw NoPictures("no film: there is nothing here that makes pictures");
  if (film_->running())
    throw UsageError("a film is being made, expected it to end (stop recording)");
  film_->begin(request);
  film_fps_ = request.fps;
  film_start_ = snapshot()->time;
  film_pictures_ = 0;
  if (options_.waits) film_due();
}

double Session::next_picture() const {
  return film_start_ + static_cast<double>(film_pictures_) / film_fps_;
}

// The pictures that are due; several alike where a step is longer than a picture.
void Session::film_due() {
  constexpr double slack = 1e-9;  // s
  for (; snapshot()->time >= next_picture() - slack; ++film_pictures_) film_->add();
}

// Where a film is made the steps are done from picture to picture, each at the first step that is
// not before its time.
void Session::advance(long steps) {
  if (!options_.waits || !film_ || !film_->running()) {
    control_.step(steps);
    return;
  }
  while (steps > 0) {
    const auto now = snapshot();
    if (!now->assets || now->mode == RunMode::unstable) return;
    const double ahead = (next_picture() - now->time) / now->assets->scene.dt;
    const long some = std::clamp(static_cast<long>(std::ceil(ahead - 1e-6)), 1l, steps);
    control_.step(some);
    control_.wait();
    if (snapshot()->step < now->step + some) return;
    steps -= some;
    film_due();
  }
}

void Session::run_for(double duration) {
  const auto now = snapshot();
  if (film_ && film_->running() && options_.waits && now->assets)
    advance(std::lround(duration / now->assets->scene.dt));
  else
    control_.run_for(duration);
}

Result Session::film_command(const Command& c) {
  if (c.verb() == "record") {
    begin_film(request_of(c));
    return {};
  }
  if (!film_ || !film_->running()) throw UsageError("no film is being made");
  return {true, film_->end()};
}

}  // namespace pedicel::app
