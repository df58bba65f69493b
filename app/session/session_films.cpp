#include "app/session/session_films.h"

#include <algorithm>
#include <cmath>

#include "app/session/session_core.h"
#include "engine/core/check.h"

namespace pedicel::app {

void SessionFilms::begin(const FilmRequest& request) {
  if (!maker_) throw NoPictures("no film: there is nothing here that makes pictures");
  if (maker_->running())
    throw UsageError("a film is being made, expected it to end (stop recording)");
  maker_->begin(request);
  fps_ = request.fps;
  start_ = core_.control.snapshot()->time;
  pictures_ = 0;
  if (core_.options.waits) add_due();
}

double SessionFilms::next_picture() const {
  return start_ + static_cast<double>(pictures_) / fps_;
}

// The pictures that are due; several alike where a step is longer than a picture.
void SessionFilms::add_due() {
  constexpr double slack = 1e-9;  // s
  for (; core_.control.snapshot()->time >= next_picture() - slack; ++pictures_) maker_->add();
}

// Where a film is made the steps are done from picture to picture, each at the first step that is
// not before its time.
void SessionFilms::advance(long steps) {
  if (!core_.options.waits || !maker_ || !maker_->running()) {
    core_.control.step(steps);
    return;
  }
  while (steps > 0) {
    const auto now = core_.control.snapshot();
    if (!now->assets || now->mode == RunMode::unstable) return;
    const double ahead = (next_picture() - now->time) / now->assets->scene.dt;
    const long some = std::clamp(static_cast<long>(std::ceil(ahead - 1e-6)), 1l, steps);
    core_.control.step(some);
    core_.control.wait();
    if (core_.control.snapshot()->step < now->step + some) return;
    steps -= some;
    add_due();
  }
}

void SessionFilms::run_for(double duration) {
  const auto now = core_.control.snapshot();
  if (maker_ && maker_->running() && core_.options.waits && now->assets)
    advance(std::lround(duration / now->assets->scene.dt));
  else
    core_.control.run_for(duration);
}

Result SessionFilms::end() {
  if (!maker_ || !maker_->running()) throw UsageError("no film is being made");
  return {true, maker_->end()};
}

}  // namespace pedicel::app
