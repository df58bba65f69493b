#include "app/window/playback_window.h"

#include <imgui.h>

#include <algorithm>
#include <cstdint>

#include "app/ui/theme.h"

namespace pedicel::app {

namespace {

constexpr double line_height = 15.0;         // px of a line of text at scale 1
constexpr double picture_time = 1.0 / 30.0;  // s, of a step by hand
constexpr double slowest = 1.0 / 64.0, fastest = 64.0;
constexpr ImGuiWindowFlags bare = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                  ImGuiWindowFlags_NoSavedSettings |
                                  ImGuiWindowFlags_NoScrollWithMouse;

}  // namespace

struct PlaybackWindow::Context {
  Context() : context(ImGui::CreateContext()) {
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().LogFilename = nullptr;
  }
  ~Context() { ImGui::DestroyContext(context); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  ImGuiContext* context;
};

PlaybackWindow::PlaybackWindow(Platform& platform, const LogFilm& log)
    : platform_(platform),
      log_(log),
      context_(std::make_unique<Context>()),
      input_(platform),
      window_(platform),
      time_(log.begin()),
      now_(platform.now()) {
  fonts_ = load_fonts(line_height * platform.scale());
  apply_theme(Theme::dark, static_cast<float>(platform.scale()));
  window_.take_letters();
  if (platform.gl()) canvas_ = std::make_unique<SceneCanvas>(*platform.gl());
}

PlaybackWindow::~PlaybackWindow() = default;

void PlaybackWindow::follow_keys() {
  const ImGuiIO& io = ImGui::GetIO();
  const auto pressed = [](Key key) { return ImGui::IsKeyPressed(static_cast<int>(key)); };
  const auto step = [&](double seconds) { playing_ = false, advance(seconds); };
  if (io.KeyCtrl && pressed(Key::q)) quits_ = true;
  if (io.KeyCtrl) return;
  if (pressed(Key::space)) {
    playing_ = !playing_;
    if (playing_ && time_ >= log_.end()) time_ = log_.begin();
  }
  if (pressed(Key::right)) step(picture_time);
  if (pressed(Key::left)) step(-picture_time);
  if (pressed(Key::home)) time_ = log_.begin();
  if (pressed(Key::end)) time_ = log_.end(), playing_ = false;
  if (pressed(Key::equal) || pressed(Key::pad_add)) speed_ = std::min(fastest, 2.0 * speed_);
  if (pressed(Key::minus) || pressed(Key::pad_subtract)) speed_ = std::max(slowest, 0.5 * speed_);
  if (pressed(Key::f)) framed_ = false;
}

void PlaybackWindow::advance(double seconds) {
  time_ = std::clamp(time_ + seconds, log_.begin(), log_.end());
  if (time_ == log_.end()) playing_ = false;
}

// Left turns, right and middle move, the wheel goes nearer, as in the window of a scene.
void PlaybackWindow::lead_camera(int height) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActive()) {
    const auto dx = static_cast<double>(io.MouseDelta.x), dy = static_cast<double>(io.MouseDelta.y);
    if (ImGui::IsMouseDown(0) && !io.KeyShift)
      camera_.orbit(dx, dy, height);
    else
      camera_.pan(dx, dy, height);
  }
  if (ImGui::IsItemHovered() && io.MouseWheel != 0.0f)
    camera_.dolly(static_cast<double>(io.MouseWheel), camera_.target());
}

void PlaybackWindow::draw_scene(float height) {
  const ImVec2 size(ImGui::GetIO().DisplaySize.x, std::max(1.0f, height));
  ImGui::SetNextWindowPos({0.0f, 0.0f});
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0f);
  ImGui::Begin("scene", nullptr, bare | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PopStyleVar(2);
  ImGui::InvisibleButton("picture", size,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  lead_camera(static_cast<int>(size.y));
  list_.clear();
  log_.fill(time_, list_);
  if (!framed_) camera_.frame(list_.bounds(), static_cast<double>(size.x / size.y));
  framed_ = true;
  if (canvas_) {
    drawn_anew_ = canvas_->draw(list_, camera_.camera(), static_cast<int>(size.x),
                                static_cast<int>(size.y), quality_, true);
    const auto texture =
        reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(canvas_->texture()));
    ImGui::GetWindowDrawList()->AddImage(texture, {0.0f, 0.0f}, size, {0.0f, 1.0f}, {1.0f, 0.0f});
  }
  if (const std::string event = log_.event_at(time_); !event.empty())
    ImGui::GetWindowDrawList()->AddText({12.0f, size.y - 2.0f * ImGui::GetFontSize()},
                                        colour_u32(palette().text), event.c_str());
  ImGui::End();
}

void PlaybackWindow::draw_time_line(float height) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.0f, display.y - height});
  ImGui::SetNextWindowSize({display.x, height});
  ImGui::Begin("time", nullptr, bare);
  if (ImGui::Button(playing_ ? "Pause" : "Play")) {
    playing_ = !playing_;
    if (playing_ && time_ >= log_.end()) time_ = log_.begin();
  }
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::Text("%gx", speed_);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1.0f);
  const double begin = log_.begin(), end = log_.end();
  if (ImGui::SliderScalar("##time", ImGuiDataType_Double, &time_, &begin, &end, "%.3f s"))
    playing_ = false;
  ImGui::End();
}

bool PlaybackWindow::frame() {
  input_.begin_frame();
  const double last = now_;
  now_ = platform_.now();
  ImGui::NewFrame();
  follow_keys();
  if (playing_) advance(speed_ * (now_ - last));
  const float line = ImGui::GetFrameHeight() + 2.0f * ImGui::GetStyle().WindowPadding.y;
  draw_scene(ImGui::GetIO().DisplaySize.y - line);
  draw_time_line(line);
  ImGui::Render();
  if (window_.paint(now_, drawn_anew_)) window_.present();
  return !quits_ && !platform_.wants_to_close();
}

}  // namespace pedicel::app
