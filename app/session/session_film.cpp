#include <algorithm>
#include <cmath>

#include "pedicel/app/session/session.h"
#include "pedicel/core/check.h"

/// Films of a session.
namespace pedicel::app {

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

Result Session::end_film() {
  if (!film_ || !film_->running()) throw UsageError("no film is being made");
  return {true, film_->end()};
}

}  // namespace pedicel::app
