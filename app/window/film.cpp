#include "app/window/film.h"

#include "engine/core/check.h"
#include "engine/core/joined.h"
#include "engine/io/atomic_file.h"
#include "engine/render/offscreen.h"

namespace pedicel::app {

namespace {

/// Everything that a film's file may have against it is one kind of fault for the session.
template <class Work>
auto written(const Work& work) {
  try {
    return work();
  } catch (const render::OutputError& error) {
    throw io::WriteError(error.what());
  }
}

}  // namespace

int camera_index(const Snapshot& now, const std::string& name) {
  if (!now.assets) return -1;
  const auto& cameras = now.assets->scene.cameras;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    if (name.empty() || cameras[i].name == name) return static_cast<int>(i);
  if (name.empty()) return -1;
  const std::string names = joined(cameras, [&](const auto& camera) { return camera.name; });
  throw UsageError("no camera \"" + name + "\", expected one of: " + names);
}

std::unique_ptr<render::VideoWriter> open_film(const std::filesystem::path& file, int width,
                                               int height, double fps) {
  return written([&] { return render::VideoWriter::open(file, width, height, fps); });
}

OffscreenFilm::OffscreenFilm(Session& session, const DesktopOptions& options,
                             std::function<void(Desktop&)> prepare)
    : session_(session), options_(options), prepare_(std::move(prepare)) {}

OffscreenFilm::~OffscreenFilm() = default;

void OffscreenFilm::open_desktop() {
  PlatformOptions where;
  where.size = request_.size;
  std::string why;
  desktop_.reset();
  platform_ = app::open_offscreen(where, why);
  if (!platform_) throw NoPictures(why);
  desktop_ = std::make_unique<Desktop>(*platform_, session_, options_);
  Ui& ui = desktop_->ui();
  ui.preferences.seen_hint = true;
  ui.filmed = true;
  ui.view.automatic_quality = false;
  if (prepare_) prepare_(*desktop_);
  // Without the interface its own picture of the scene is not seen.
  ui.view.quality = request_.with_interface ? CanvasQuality::best : CanvasQuality::coarsest;
}

void OffscreenFilm::begin(const FilmRequest& request) {
  camera_index(*session_.snapshot(), request.camera);
  request_ = request;
  open_desktop();
  video_ = open_film(request.file, request.size[0], request.size[1], request.fps);
  first_ = true;
}

/// The camera that was asked for, and after what it follows.
void OffscreenFilm::look() {
  const int index = camera_index(*session_.snapshot(), request_.camera);
  if (index >= 0) desktop_->scene().use_camera(index);
}

void OffscreenFilm::add() {
  // The first pictures lay the panels out and frame the scene.
  for (int i = first_ ? 4 : 1; i > 0; --i) {
    desktop_->frame();
    look();
  }
  if (first_) desktop_->frame();
  first_ = false;
  const auto picture = request_.with_interface
                           ? desktop_->window().picture()
                           : desktop_->scene().picture(request_.size[0], request_.size[1]);
  written([&] { video_->add(picture.value()); });
}

std::string OffscreenFilm::end() {
  const auto video = std::move(video_);
  written([&] { video->finish(); });
  const auto result = std::filesystem::absolute(video->result()).lexically_normal();
  return "film in " + result.string() + ": " + std::to_string(video->frames()) + " pictures";
}

}  // namespace pedicel::app
