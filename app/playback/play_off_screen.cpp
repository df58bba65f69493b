#include "app/playback/play_off_screen.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/playback/log_film.h"
#include "engine/core/check.h"
#include "engine/core/diagnostics.h"
#include "engine/core/stop.h"

namespace pedicel::app {

namespace {

constexpr int no_pictures = 77;
constexpr double longest_film = 1.0e6;  // pictures

void fill(const LogFilm& log, double time, Frame& frame) {
  frame.list.clear();
  frame.time = time;
  log.fill(time, frame.list);
  char text[40];
  std::snprintf(text, sizeof text, "t = %.2f s", time);
  frame.caption = text;
  frame.note = log.event_at(time);
}

/// Shows all that there is at the beginning, and stays.
render::Camera camera_of_log(const LogFilm& log, const std::array<int, 2>& size) {
  Frame first;
  fill(log, log.begin(), first);
  return render::frame(first.list.bounds(), static_cast<double>(size[0]) / size[1]);
}

}  // namespace

int play_off_screen(const PlayRequest& request) {
  const LogFilm log(request.log, request.packages);
  for (const std::string& note : log.notes())
    std::fprintf(stderr, "%s: warning: %s\n", printable(request.log).c_str(),
                 printable(note).c_str());
  PictureTaker taker;
  if (!taker.available()) {
    std::fprintf(stderr, "%s\n", taker.why().c_str());
    return no_pictures;
  }
  const render::Camera camera = camera_of_log(log, request.size);
  Frame frame;
  if (!request.picture.empty()) {
    fill(log, std::clamp(request.at.value_or(log.end()), log.begin(), log.end()), frame);
    taker.save(request.picture, frame, camera, request.size[0], request.size[1]);
    if (!request.quiet) std::fprintf(stderr, "written to %s\n", request.picture.c_str());
  }
  if (request.film.empty()) return 0;
  const double from = request.from.value_or(log.begin()), to = request.to.value_or(log.end());
  const double pictures = std::floor((to - from) * request.fps + 1.0e-9) + 1.0;
  if (!(pictures >= 1.0 && pictures <= longest_film))
    throw UsageError("a film from " + std::to_string(from) + " s to " + std::to_string(to) +
                     " s, expected 1 to 1000000 pictures");
  world::SceneVideo video;
  video.fps = request.fps;
  video.size = request.size;
  taker.open_video(request.film, video);
  stop_in_good_order();
  for (long i = 0; i < static_cast<long>(pictures) && !stop_requested; ++i) {
    fill(log, from + static_cast<double>(i) / request.fps, frame);
    taker.add_to_video(frame, camera);
  }
  const auto made = taker.finish_video();
  if (made && !request.quiet) std::fprintf(stderr, "written to %s\n", made->string().c_str());
  return stop_requested ? stop_exit_code() : 0;
}

}  // namespace pedicel::app
