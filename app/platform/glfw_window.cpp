#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <utility>

#include "app/platform/platform.h"

namespace pedicel::app {

namespace {

/// GLFW is started once and stays until the program ends.
bool start_glfw(std::string& why) {
  static std::string reason;
  static const bool started = [] {
    glfwSetErrorCallback([](int, const char* text) { reason = text; });
    return glfwInit() == GLFW_TRUE;
  }();
  if (started) return true;
  const bool display = std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY");
  why = display ? "no window: the display cannot be opened (" + reason + ")"
                : "no window: there is no display (DISPLAY is not set)";
  why += "; runs, pictures and films work off screen, with --headless";
  return false;
}

std::string utf8(unsigned code) {
  std::string text;
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0 | (code >> 6));
    text += static_cast<char>(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    text += static_cast<char>(0xE0 | (code >> 12));
    text += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
    text += static_cast<char>(0x80 | (code & 0x3F));
  }
  return text;
}

class GlfwWindow : public Platform {
 public:
  GlfwWindow(GLFWwindow* window, const PlatformOptions& options)
      : window_(window), scale_(options.scale) {
    glfwMakeContextCurrent(window_);
    gl_ = render::GlFunctions::load(
        [](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); });
    glfwSwapInterval(0);  // software OpenGL must not wait for a beam that is not there
    listen();
    constexpr int shapes[] = {GLFW_ARROW_CURSOR,     GLFW_IBEAM_CURSOR,   GLFW_HAND_CURSOR,
                              GLFW_CROSSHAIR_CURSOR, GLFW_HRESIZE_CURSOR, GLFW_VRESIZE_CURSOR};
    for (const int shape : shapes) cursors_.push_back(glfwCreateStandardCursor(shape));
  }
  ~GlfwWindow() override {
    for (GLFWcursor* cursor : cursors_) glfwDestroyCursor(cursor);
    glfwDestroyWindow(window_);
  }
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  std::string_view name() const override { return "window"; }
  const render::GlFunctions* gl() const override { return &gl_; }

  std::vector<InputEvent> poll() override {
    glfwPollEvents();
    return std::exchange(events_, {});
  }
  std::array<int, 2> size() const override {
    std::array<int, 2> size{};
    glfwGetFramebufferSize(window_, &size[0], &size[1]);
    return size;
  }
  double scale() const override {
    if (scale_ > 0.0) return scale_;
    float x = 1.0f, y = 1.0f;
    glfwGetWindowContentScale(window_, &x, &y);
    return std::clamp(static_cast<double>(x), 0.5, 4.0);
  }
  double now() const override { return glfwGetTime(); }
  void present(const render::RenderTarget* picture) override {
    if (picture) picture->resolve_to(0);
    glfwSwapBuffers(window_);
    pace();
  }

  /// Until somebody does something, or a twentieth of a second: the simulation may have news.
  void rest() override {
    glfwWaitEventsTimeout(0.05);
    last_picture_ = glfwGetTime();
  }

  bool wants_to_close() const override { return glfwWindowShouldClose(window_); }
  void stay_open() override { glfwSetWindowShouldClose(window_, GLFW_FALSE); }
  void set_title(const std::string& title) override {
    if (title == title_) return;
    title_ = title;
    glfwSetWindowTitle(window_, title.c_str());
  }
  void set_cursor(Cursor cursor) override {
    if (cursor == cursor_) return;
    cursor_ = cursor;
    glfwSetCursor(window_, cursors_[static_cast<std::size_t>(cursor)]);
  }
  void set_full_screen(bool on) override;
  std::string clipboard() const override {
    const char* text = glfwGetClipboardString(window_);
    return text ? text : "";
  }
  void set_clipboard(const std::string& text) override {
    glfwSetClipboardString(window_, text.c_str());
  }

 private:
  static GlfwWindow& of(GLFWwindow* window) {
    return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window));
  }
  void listen();
  /// No more than 60 pictures a second: the rest of the time belongs to the simulation.
  void pace() {
    constexpr double period = 1.0 / 60.0;
    const double left = last_picture_ + period - glfwGetTime();
    if (left > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(left));
    last_picture_ = glfwGetTime();
  }

  GLFWwindow* window_;
  double scale_;
  render::GlFunctions gl_;
  std::vector<InputEvent> events_;
  std::vector<GLFWcursor*> cursors_;
  Cursor cursor_ = Cursor::arrow;
  std::string title_;
  double last_picture_ = 0.0;
  std::array<int, 4> windowed_{0, 0, 1280, 720};  // place and size before full screen
};

void GlfwWindow::listen() {
  glfwSetWindowUserPointer(window_, this);
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    // Events are in screen units, pictures in pixels.
    std::array<int, 2> units{}, pixels = of(window).size();
    glfwGetWindowSize(window, &units[0], &units[1]);
    const double ratio = units[0] > 0 ? static_cast<double>(pixels[0]) / units[0] : 1.0;
    of(window).events_.push_back(InputEvent::move(ratio * x, ratio * y));
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
    if (button < 3) of(window).events_.push_back(InputEvent::press(button, action == GLFW_PRESS));
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double y) {
    of(window).events_.push_back(InputEvent::wheel(y));
  });
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
    if (key > 0 && key < key_count && action != GLFW_REPEAT)
      of(window).events_.push_back(InputEvent::press(static_cast<Key>(key), action == GLFW_PRESS));
  });
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned code) {
    of(window).events_.push_back(InputEvent::typed(utf8(code)));
  });
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    for (int i = 0; i < count; ++i) of(window).events_.push_back(InputEvent::drop(paths[i]));
  });
  glfwSetCursorEnterCallback(window_, [](GLFWwindow* window, int inside) {
    if (!inside) of(window).events_.push_back({InputEvent::Kind::leave, 0, 0, 0, {}, false, {}});
  });
}

void GlfwWindow::set_full_screen(bool on) {
  if (on == (glfwGetWindowMonitor(window_) != nullptr)) return;
  auto& [x, y, width, height] = windowed_;
  if (!on) {
    glfwSetWindowMonitor(window_, nullptr, x, y, width, height, GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  if (!mode) return;
  glfwGetWindowPos(window_, &x, &y);
  glfwGetWindowSize(window_, &width, &height);
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

}  // namespace

std::unique_ptr<Platform> open_window(const PlatformOptions& options, std::string& why) {
  if (!start_glfw(why)) return nullptr;
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // the picture comes from a framebuffer of its own
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  GLFWwindow* window =
      glfwCreateWindow(options.size[0], options.size[1], options.title.c_str(), nullptr, nullptr);
  if (!window) {
    why =
        "no window: this display offers no OpenGL 3.3 core; runs, pictures and films work off "
        "screen, with --headless";
    return nullptr;
  }
  try {
    return std::make_unique<GlfwWindow>(window, options);
  } catch (const std::runtime_error& error) {
    why = std::string("no window: ") + error.what() + "; runs work off screen, with --headless";
    return nullptr;
  }
}

}  // namespace pedicel::app
