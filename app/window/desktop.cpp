#include "app/window/desktop.h"

#include <imgui.h>

#include <chrono>

#include "app/panels/time_line.h"
#include "app/ui/selection_follow.h"
#include "app/ui/theme.h"

namespace pedicel::app {

namespace {

constexpr double text_points = 15.0;  // px of a line of text at scale 1

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Cursor cursor_of(ImGuiMouseCursor cursor) {
  switch (cursor) {
    case ImGuiMouseCursor_TextInput:
      return Cursor::text;
    case ImGuiMouseCursor_Hand:
      return Cursor::hand;
    case ImGuiMouseCursor_ResizeEW:
      return Cursor::size_across;
    case ImGuiMouseCursor_ResizeNS:
      return Cursor::size_down;
    default:
      return Cursor::arrow;
  }
}

}  // namespace

struct Desktop::Context {
  explicit Context(const Preferences& preferences) : context(ImGui::CreateContext()) {
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().LogFilename = nullptr;
    ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
    ImGui::GetIO().MouseDoubleClickTime = 0.35f;
    apply_theme(preferences.theme, 1.0f);
  }
  ~Context() { ImGui::DestroyContext(context); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  ImGuiContext* context;
};

Desktop::Desktop(Platform& platform, Session& session, const DesktopOptions& options)
    : platform_(platform),
      preferences_path_(options.preferences),
      context_(std::make_unique<Context>(Preferences{})),
      ui_(session, session.snapshot()),
      input_(platform),
      window_(platform),
      scene_(ui_, platform.gl()),
      film_(ui_, scene_, window_),
      actions_(ui_, platform, scene_, window_, film_) {
  ui_.preferences.theme = options.theme;
  if (!preferences_path_.empty() && std::filesystem::exists(preferences_path_))
    ui_.preferences = read_preferences(preferences_path_);
  if (options.theme_given) ui_.preferences.theme = options.theme;
  written_ = ui_.preferences;
  ui_.times.platform = platform.name();
  ui_.times.renderer = platform.renderer_name();
  ui_.now = platform.now();
  follow_fonts();
}

Desktop::~Desktop() {
  if (ui_.preferences != written_) write_preferences(ui_.preferences, preferences_path_);
}

/// Letters are made anew for another scale; themes only change colours.
void Desktop::follow_fonts() {
  const double scale = platform_.scale() * ui_.preferences.font_scale;
  if (scale != fonts_for_) {
    fonts_ = load_fonts(text_points * scale);
    ui_.bold = fonts_.bold;
    window_.take_letters();
  }
  if (scale != fonts_for_ || theme_ != ui_.preferences.theme)
    apply_theme(ui_.preferences.theme, static_cast<float>(scale));
  fonts_for_ = scale;
  theme_ = ui_.preferences.theme;
  ui_.scale = static_cast<float>(scale);
}

/// What is chosen stays the same thing in the newest snapshot.
void Desktop::follow_snapshot() {
  const std::shared_ptr<const Snapshot> newest = ui_.session.snapshot();
  ui_.selection = follow_selection(ui_.selection, *ui_.snapshot, *newest);
  ui_.snapshot = newest;
  follow_run(ui_);
}

bool Desktop::frame() {
  const auto start = std::chrono::steady_clock::now();
  follow_fonts();
  const std::vector<std::string> dropped = input_.begin_frame();
  const double last = ui_.now;
  ui_.now = platform_.now();
  // Pictures that were not painted take as long as nobody does anything.
  if (!window_.can_paint() || window_.painted_at() == last)
    ui_.times.picture +=
        (ui_.times.picture > 0.0 ? 0.1 : 1.0) * ((ui_.now - last) - ui_.times.picture);
  for (const std::string& path : dropped) ui_.open(path);
  ui_.session.update();
  film_.lead_run();
  follow_snapshot();
  shown_.follow(ui_, platform_, scene_);
  scene_.follow_camera();

  ImGui::NewFrame();
  actions_.ask_by_keys();
  const LayoutAreas areas = layout_.draw(ui_);
  scene_.draw(areas);
  draw_scene_texts(ui_, areas);
  draw_dialogs(ui_);
  actions_.perform_all();
  ImGui::Render();
  ui_.times.interface += 0.1 * (seconds_since(start) - scene_.seconds() - ui_.times.interface);
  platform_.set_cursor(
      ui_.draw.on && ui_.hover.distance > 0.0 ? Cursor::cross : cursor_of(ImGui::GetMouseCursor()));
  if (window_.paint(ui_.now, scene_.is_drawn_anew() || film_.running())) {
    film_.add();
    window_.present();
  }
  if (ui_.preferences != written_ && !ImGui::IsAnyMouseDown()) {
    written_ = ui_.preferences;
    write_preferences(written_, preferences_path_);
  }
  if (platform_.wants_to_close()) {
    platform_.stay_open();
    ui_.ask(Action::quit);
  }
  return !actions_.quits();
}

}  // namespace pedicel::app
