#include "app/view/scene_canvas.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/view/list_key.h"

namespace pedicel::app {

namespace {

constexpr double slow = 1.0 / 22.0, quick = 1.0 / 60.0;  // s, of a picture
constexpr int still_pictures = 24;  // unchanged ones before it is drawn at its best
constexpr int calm_pictures = 90;   // this many quick ones before quality rises again

}  // namespace

render::RenderSettings settings_of_level(int level) {
  constexpr std::array<int, 6> samples = {4, 4, 2, 1, 1, 1};
  constexpr std::array<int, 6> shadow_sizes = {2048, 2048, 1024, 1024, 512, 512};
  constexpr std::array<double, 6> details = {1.0, 0.7, 0.5, 0.35, 0.2, 0.1};
  const auto i =
      static_cast<std::size_t>(std::clamp(level, CanvasQuality::best, CanvasQuality::coarsest));
  render::RenderSettings settings;
  settings.samples = samples[i];
  settings.shadow_size = shadow_sizes[i];
  settings.detail = details[i];
  settings.shadows = level < CanvasQuality::coarsest;
  return settings;
}

double resolution_of_level(int level) {
  constexpr std::array<double, 6> shares = {1.0, 1.0, 1.0, 1.0, 0.75, 0.6};
  return shares[static_cast<std::size_t>(std::clamp(level, 0, CanvasQuality::coarsest))];
}

SceneCanvas::SceneCanvas(const render::GlFunctions& gl) : gl_(gl), renderer_(gl) {
  gl_.GenTextures(1, &texture_);
  gl_.GenFramebuffers(1, &framebuffer_);
}

SceneCanvas::~SceneCanvas() {
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(1, &texture_);
}

void SceneCanvas::resize(int width, int height) {
  if (size_ == std::array<int, 2>{width, height}) return;
  size_ = {width, height};
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
}

double least_width_of_level(int level) {
  constexpr std::array<double, 6> widths = {0.0, 0.0, 0.8, 1.3, 1.4, 1.4};
  return widths[static_cast<std::size_t>(std::clamp(level, 0, CanvasQuality::coarsest))];
}

void widen(render::DrawList& list, const render::Camera& camera, int height, double pixels) {
  const Vec3 forward = (camera.target - camera.eye).normalized();
  const double share = 0.5 * pixels / camera.focal_length(height);
  const auto least = [&](const Vec3& place) {
    return share * std::max(0.0, (place - camera.eye).dot(forward));
  };
  for (render::TubeSegment& t : list.tubes) {
    t.r0 = std::max(t.r0, least(t.p0));
    t.r1 = std::max(t.r1, least(t.p1));
  }
}

bool SceneCanvas::draw(const render::DrawList& list, const render::Camera& camera, int width,
                       int height, CanvasQuality& quality, bool shadows) {
  Shown what{list_key(list, camera), width, height, quality.level, shadows};
  Shown finest = what;
  finest.level = CanvasQuality::best;
  if (what == shown_ || finest == shown_) {
    // The eye looks longer at what stands still.
    const bool refines = quality.automatic && shown_ != finest;
    if (!refines || ++same_ != still_pictures) return false;
    paint(list, camera, finest);
    return true;
  }
  same_ = 0;
  const auto start = std::chrono::steady_clock::now();
  paint(list, camera, what);
  adapt(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), quality);
  return true;
}

void SceneCanvas::paint(const render::DrawList& list, const render::Camera& camera,
                        const Shown& what) {
  shown_ = what;
  render::RenderSettings settings = settings_of_level(what.level);
  settings.shadows = settings.shadows && what.shadows;
  renderer_.set(settings);
  const double share = resolution_of_level(what.level);
  const auto part = [share](int side) { return std::max(1, static_cast<int>(share * side)); };
  resize(part(what.width), part(what.height));
  const double least = least_width_of_level(what.level);
  if (least > 0.0) {
    widened_ = list;
    widen(widened_, camera, size_[1], least);
  }
  renderer_.draw(least > 0.0 ? widened_ : list, camera, size_[0], size_[1], framebuffer_);
  // Software OpenGL works while we go on: without this the time would count for somebody else.
  std::array<unsigned char, 4> pixel{};
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  gl_.ReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
}

/// One slow picture may be somebody else's doing; the smoothed time decides.
void SceneCanvas::adapt(double seconds, CanvasQuality& quality) {
  if (level_ != quality.level) seconds_ = 0.7 * slow, calm_ = 0;
  level_ = quality.level;
  seconds_ += 0.2 * (std::min(seconds, 4.0 * slow) - seconds_);
  if (!quality.automatic) return;
  if (seconds_ > slow && quality.level < CanvasQuality::coarsest) {
    ++quality.level;
  } else if (seconds_ < quick && quality.level > CanvasQuality::best && ++calm_ > calm_pictures) {
    --quality.level;
  }
}

render::Image SceneCanvas::still(const render::DrawList& list, const render::Camera& camera,
                                 int width, int height) {
  renderer_.set(settings_of_level(CanvasQuality::best));
  return renderer_.render(list, camera, width, height);
}

}  // namespace pedicel::app
