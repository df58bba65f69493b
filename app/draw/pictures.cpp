#include "app/draw/pictures.h"

namespace pedicel::app {

namespace {

void write_over(render::Image& image, const Frame& frame, const render::Camera& camera) {
  using render::Corner;
  for (const auto& [place, text] : frame.labels) draw_label(image, camera, place, text);
  if (!frame.caption.empty()) draw_caption(image, frame.caption, Corner::top_left);
  if (!frame.note.empty()) draw_caption(image, frame.note, Corner::bottom_left);
  if (frame.legend) draw_legend(image, *frame.legend, Corner::top_right);
}

}  // namespace

Frame& FrameHistory::next() {
  newest_ = (newest_ + 1) % kept;
  count_ = std::min(count_ + 1, kept);
  Frame& frame = frames_[static_cast<std::size_t>(newest_)];
  frame.list.clear();
  frame.time = 0.0;
  frame.caption.clear();
  frame.note.clear();
  frame.legend.reset();
  frame.labels.clear();
  return frame;
}

const Frame* FrameHistory::back(int steps) const {
  if (steps < 0 || steps >= count_) return nullptr;
  return &frames_[static_cast<std::size_t>((newest_ + kept - steps) % kept)];
}

render::Camera camera_of(const world::SceneCamera& camera, const Vec3& anchor_W) {
  const bool follows = camera.follow.kind != world::Anchor::Kind::none;
  const Vec3 offset = follows ? anchor_W : Vec3(Vec3::Zero());
  render::Camera result;
  result.eye = camera.eye + offset;
  result.target = camera.target + offset;
  result.up = camera.up;
  result.field_of_view = camera.field_of_view;
  const double distance = (result.eye - result.target).norm();
  result.near_plane = 0.02 * distance;
  result.far_plane = 100.0 * distance;
  return result;
}

PictureTaker::PictureTaker(const render::RenderSettings& settings) {
  render::check(settings);
  context_ = render::OffscreenContext::create(why_);
  if (context_) renderer_ = std::make_unique<render::Renderer>(context_->gl(), settings);
}

PictureTaker::~PictureTaker() = default;

std::string PictureTaker::renderer_name() const {
  return context_ ? context_->renderer_name() : "";
}

std::optional<render::Image> PictureTaker::take(const Frame& frame, const render::Camera& camera,
                                                int width, int height) {
  if (!renderer_) return {};
  render::Image image = renderer_->render(frame.list, camera, width, height);
  write_over(image, frame, camera);
  return image;
}

std::optional<render::Renderer::Labelled> PictureTaker::sense(const Frame& frame,
                                                              const render::Camera& camera,
                                                              int width, int height, bool colours) {
  if (!renderer_) return {};
  if (colours) return renderer_->render_labelled(frame.list, camera, width, height);
  return render::Renderer::Labelled{{}, renderer_->label(frame.list, camera, width, height)};
}

void PictureTaker::set(const render::RenderSettings& settings) {
  render::check(settings);
  if (renderer_) renderer_->set(settings);
}

bool PictureTaker::save(const std::filesystem::path& path, const Frame& frame,
                        const render::Camera& camera, int width, int height) {
  const std::optional<render::Image> image = take(frame, camera, width, height);
  if (image) render::write_png(path, *image);
  return image.has_value();
}

void PictureTaker::open_video(const std::filesystem::path& path, const world::SceneVideo& video) {
  if (!renderer_) return;
  video_size_ = video.size;
  video_ = render::VideoWriter::open(path, video.size[0], video.size[1], video.fps);
}

void PictureTaker::add_to_video(const Frame& frame, const render::Camera& camera) {
  if (!video_) return;
  if (const auto image = take(frame, camera, video_size_[0], video_size_[1])) video_->add(*image);
}

std::optional<std::filesystem::path> PictureTaker::finish_video() {
  if (!video_) return {};
  video_->finish();
  const std::filesystem::path result = video_->result();
  video_.reset();
  return result;
}

}  // namespace pedicel::app
