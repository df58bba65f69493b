#include "pedicel/app/window/desktop.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "pedicel/app/panels/time_line.h"
#include "pedicel/app/session/live/robot_goal.h"
#include "pedicel/app/session/session_files.h"
#include "pedicel/app/session/session_films.h"
#include "pedicel/app/tools/draw_tool.h"
#include "pedicel/app/ui/selection_follow.h"
#include "pedicel/app/ui/theme.h"

namespace pedicel::app {

namespace {

constexpr double least_above_ground = 0.01;  // m, of the eye
constexpr double text_points = 15.0;         // px of a line of text at scale 1

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

/// Undo, redo, copy, cut, paste, choose all: those of the text that is typed.
bool edits_text(const Binding& binding) {
  constexpr std::array keys{Key::z, Key::y, Key::c, Key::x, Key::v, Key::a};
  return binding.control && std::ranges::find(keys, binding.key) != keys.end();
}

/// What neither the document nor the run nor the view behind a dialog feels.
bool acts_over_dialogs(Action action) {
  switch (action) {
    case Action::cancel:
    case Action::reload:  // of a file that could not be read
    case Action::help:
    case Action::info:
    case Action::screenshot:
    case Action::video:
    case Action::full_screen:
    case Action::larger_text:
    case Action::smaller_text:
    case Action::quit:
      return true;
    default:
      return false;
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
      draw_tool_(std::make_unique<DrawTool>()) {
  ui_.preferences.theme = options.theme;
  if (!preferences_path_.empty() && std::filesystem::exists(preferences_path_))
    ui_.preferences = read_preferences(preferences_path_);
  if (options.theme_given) ui_.preferences.theme = options.theme;
  written_ = ui_.preferences;
  ui_.times.platform = platform.name();
  ui_.times.renderer = platform.renderer_name();
  ui_.now = platform.now();
  if (platform.gl()) {
    painter_ = std::make_unique<GuiPainter>(*platform.gl());
    canvas_ = std::make_unique<SceneCanvas>(*platform.gl());
  }
  if (!session.films().maker()) session.films().set_maker(this);
  follow_fonts();
}

Desktop::~Desktop() {
  if (video_) end();
  if (ui_.session.films().maker() == this) ui_.session.films().set_maker(nullptr);
  if (ui_.preferences != written_) write_preferences(ui_.preferences, preferences_path_);
}

/// Letters are made anew for another scale; themes only change colours.
void Desktop::follow_fonts() {
  const double scale = platform_.scale() * ui_.preferences.font_scale;
  if (scale != fonts_for_) {
    fonts_ = load_fonts(text_points * scale);
    ui_.bold = fonts_.bold;
    if (painter_) painter_->upload(*ImGui::GetIO().Fonts);
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

/// Another document: its own first camera, and nothing chosen. The same one read anew keeps both.
void Desktop::follow_document() {
  const Snapshot& snapshot = *ui_.snapshot;
  std::set<std::string> plants;
  for (const PlantSnapshot& plant : snapshot.plants) plants.insert(plant.model->name);
  // An experiment's plant takes the place of all others, and has no file.
  const bool others = !plants.empty() && !shown_plants_.empty() &&
                      std::ranges::none_of(plants, [&](const std::string& name) {
                        return shown_plants_.contains(name);
                      });
  if (!plants.empty()) shown_plants_ = std::move(plants);
  if (shown_path_ != ui_.session.files().path()) {
    shown_path_ = ui_.session.files().path();
    framed_ = false;
    ui_.selection = {};
  }
  if (others && ui_.session.history().size() == 0) framed_ = false;
  frame_new_plant();
  frame_new_robot();
  std::string title = "Pedicel";
  if (!shown_path_.empty()) title = shown_path_.filename().string() + " - " + title;
  platform_.set_title(title);
  if (framed_ || !snapshot.assets || !ui_.session.is_simulated()) return;
  framed_ = true;
  if (!snapshot.assets->scene.cameras.empty())
    use_camera(0);
  else
    ui_.ask(Action::frame_all);
}

/// One that was imported, as soon as it is there.
void Desktop::frame_new_plant() {
  for (const PlantSnapshot& plant : ui_.snapshot->plants) {
    if (ui_.frame_plant.empty() || plant.model->name != ui_.frame_plant) continue;
    Eigen::AlignedBox3d box;
    for (int e = 0; e < plant.model->size(); ++e)
      box.extend(plant.state.position[static_cast<std::size_t>(e)]);
    box.extend(plant.model->root.position);
    ui_.frame_box = box;
    ui_.frame_plant.clear();
  }
}

/// All is shown where a part of it is out of the picture.
void Desktop::frame_new_robot() {
  if (!ui_.frame_robot || !ui_.snapshot->robot.present || !ui_.session.is_simulated()) return;
  ui_.frame_robot = false;
  const ImVec2 low = scene_.low, high(low.x + scene_.size.x, low.y + scene_.size.y);
  const bool seen = std::ranges::all_of(ui_.snapshot->robot.links, [&](const Pose& link) {
    const auto at = scene_.project(link.position);
    return at && at->x > low.x && at->x < high.x && at->y > low.y && at->y < high.y;
  });
  if (!seen) ui_.ask(Action::frame_all);
}

void Desktop::keys() {
  const ImGuiIO& io = ImGui::GetIO();
  for (const Binding& binding : bindings()) {
    if (ui_.dialog != Dialog::none && !acts_over_dialogs(binding.action)) continue;
    // While a text is typed, only what cannot be part of it.
    if (types_text() && (edits_text(binding) || (!binding.control && binding.key < Key::f1)))
      continue;
    if (binding.control != io.KeyCtrl || binding.shift != io.KeyShift) continue;
    const bool repeats = binding.action == Action::step || binding.action == Action::step_back;
    if (ImGui::IsKeyPressed(static_cast<int>(binding.key), repeats)) ui_.ask(binding.action);
  }
}

bool Desktop::frame() {
  const auto start = std::chrono::steady_clock::now();
  follow_fonts();
  const std::vector<std::string> dropped = input_.begin_frame();
  const double last = ui_.now;
  ui_.now = platform_.now();
  // Pictures that were not painted take as long as nobody does anything.
  if (!painter_ || painted_at_ == last)
    ui_.times.picture +=
        (ui_.times.picture > 0.0 ? 0.1 : 1.0) * ((ui_.now - last) - ui_.times.picture);
  for (const std::string& path : dropped) ui_.open(path);
  ui_.session.update();
  lead_film();
  follow_snapshot();
  follow_document();
  follow_camera();

  ImGui::NewFrame();
  keys();
  const LayoutAreas areas = layout_.draw(ui_);
  draw_scene(areas);
  draw_scene_texts(ui_, areas);
  draw_dialogs(ui_);
  perform_all();
  ImGui::Render();
  ui_.times.interface += 0.1 * (seconds_since(start) - scene_seconds_ - ui_.times.interface);
  platform_.set_cursor(
      ui_.draw.on && ui_.hover.distance > 0.0 ? Cursor::cross : cursor_of(ImGui::GetMouseCursor()));
  paint();
  if (ui_.preferences != written_ && !ImGui::IsAnyMouseDown()) {
    written_ = ui_.preferences;
    write_preferences(written_, preferences_path_);
  }
  if (platform_.wants_to_close()) {
    platform_.stay_open();
    ui_.ask(Action::quit);
  }
  return !quits_;
}

void Desktop::draw_scene(const LayoutAreas& areas) {
  scene_drawn_ = false;
  scene_seconds_ = 0.0;
  const ImVec2 size(areas.scene_max.x - areas.scene_min.x, areas.scene_max.y - areas.scene_min.y);
  if (size.x < 8 || size.y < 8) return;
  ImGui::SetNextWindowPos(areas.scene_min);
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
  ImGui::Begin("scene", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoBackground);
  ImGui::PopStyleVar(2);
  ImGui::InvisibleButton("picture", size,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  scene_ = {areas.scene_min, size, camera_.camera()};
  const bool handle = tool_handles_.update(ui_, scene_);
  const bool tool = (ui_.dialog == Dialog::none && draw_tool_->update(ui_, scene_)) || handle;
  mouse_.update(ui_, camera_, scene_, view_.shapes(), tool);
  if (const auto* assets = ui_.snapshot->assets.get();
      ui_.view.camera < 0 && assets && assets->scene.ground)
    camera_.stay_above(assets->scene.ground->height + least_above_ground);
  if (ui_.frame_box) {
    camera_.frame(*ui_.frame_box, size.x / size.y);
    ui_.frame_box.reset();
    ui_.view.camera = -1;
  }
  scene_.camera = camera_.camera();
  ui_.view_eye = scene_.camera.eye, ui_.view_target = scene_.camera.target;
  ui_.view_fov = scene_.camera.field_of_view;

  const auto start = std::chrono::steady_clock::now();
  list_.clear();
  ui_.view.goal_hits.clear();
  if (const auto ghost = robot_ghost(*ui_.snapshot))
    ui_.view.goal_hits = robot_contacts_.at_goal(*ui_.snapshot, ghost->links);
  measured_.update(ui_.view, ui_.session, *ui_.snapshot);
  view_.fill(list_, *ui_.snapshot, ui_.view, ui_.selection, ui_.hover);
  measured_.add_to(list_);
  draw_tool_->add_to(list_, ui_, scene_);
  ui_.times.list = seconds_since(start);
  if (canvas_) {
    quality_.automatic = ui_.view.automatic_quality;
    if (!quality_.automatic) quality_.level = ui_.view.quality;
    scene_drawn_ = canvas_->draw(list_, scene_.camera, scene_.width(), scene_.height(), quality_,
                                 ui_.view.shadows);
    ui_.view.quality = ui_.times.quality = quality_.level;
    ui_.times.triangles = canvas_->triangles();
    scene_seconds_ = seconds_since(start);
    ui_.times.scene += 0.2 * (scene_seconds_ - ui_.times.scene);
    const auto texture =
        reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(canvas_->texture()));
    ImGui::GetWindowDrawList()->AddImage(texture, areas.scene_min, areas.scene_max, ImVec2(0, 1),
                                         ImVec2(1, 0));
  }
  tool_handles_.draw(*ImGui::GetWindowDrawList(), ui_, scene_);
  draw_labels();
  ImGui::End();
}

/// Whether the window would look otherwise than it was painted last. Now and then it is painted
/// anyway, for window systems that forget what was covered.
bool Desktop::has_to_paint() {
  constexpr double at_least_every = 0.5;  // s
  const std::uint64_t key = interface_key(*ImGui::GetDrawData());
  const bool same = key == painted_key_ && !scene_drawn_ && !video_ && target_ &&
                    target_->width() == platform_.size()[0] &&
                    target_->height() == platform_.size()[1];
  if (same && ui_.now - painted_at_ < at_least_every) return false;
  painted_key_ = key;
  painted_at_ = ui_.now;
  return true;
}

void Desktop::paint() {
  if (painter_ && !has_to_paint()) return platform_.rest();
  if (!painter_) {
    platform_.present(nullptr);
    return;
  }
  const auto [width, height] = platform_.size();
  if (width < 1 || height < 1) return;
  if (!target_ || target_->width() != width || target_->height() != height) {
    target_.reset();
    target_ = std::make_unique<render::RenderTarget>(*platform_.gl(), width, height, 1);
  }
  target_->bind();
  const ImVec4& back = palette().window;
  platform_.gl()->ClearColor(back.x, back.y, back.z, 1.0f);
  platform_.gl()->Clear(GL_COLOR_BUFFER_BIT);
  painter_->paint(*ImGui::GetDrawData());
  add();
  platform_.present(target_.get());
}

std::optional<render::Image> Desktop::window_picture() const {
  if (!target_) return {};
  return target_->read();
}

std::optional<render::Image> Desktop::scene_picture(int width, int height) {
  if (!canvas_) return {};
  return canvas_->still(list_, camera_.camera(), width, height);
}

}  // namespace pedicel::app
