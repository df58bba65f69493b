#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/platform/input.h"
#include "engine/render/gl_functions.h"
#include "engine/render/render_target.h"

namespace pedicel::app {

struct PlatformOptions {
  std::array<int, 2> size{1280, 720};  ///< px, of the picture
  double scale = 0.0;                  ///< 1, of everything that is written; 0: as the monitor says
  std::string title = "Pedicel";
};

enum class Cursor { arrow, text, hand, cross, size_across, size_down };

/// Where the interface is shown and where its input comes from. The program above it is the same on
/// every platform: in a window, off screen, or nowhere (null: it has no OpenGL and draws nothing).
class Platform {
 public:
  virtual ~Platform() = default;

  virtual std::string_view name() const = 0;
  /// Null on the null platform. Current on the thread that made the platform.
  virtual const render::GlFunctions* gl() const { return nullptr; }
  /// The OpenGL driver; empty without one.
  std::string renderer_name() const;

  /// What happened since the last call, in its order. Waits for nothing.
  virtual std::vector<InputEvent> poll() = 0;
  virtual std::array<int, 2> size() const = 0;  ///< px
  virtual double scale() const { return 1.0; }  ///< 1, see PlatformOptions
  /// Time of the picture now being made, s. Off screen each picture takes 1/60 s.
  virtual double now() const = 0;
  /// Shows the picture (null: `picture` is null).
  virtual void present(const render::RenderTarget* picture) = 0;

  /// In place of present() where the picture would be the one that is shown.
  virtual void rest() { present(nullptr); }

  virtual bool wants_to_close() const { return false; }
  /// Takes that wish for answered.
  virtual void stay_open() {}
  virtual void set_title(const std::string&) {}
  virtual void set_cursor(Cursor) {}
  virtual void set_full_screen(bool) {}
  virtual std::string clipboard() const { return clipboard_; }
  virtual void set_clipboard(const std::string& text) { clipboard_ = text; }

 protected:
  std::string clipboard_;
};

/// Opens "window", "offscreen" or "null". Nothing where this machine cannot: `why` is then one
/// sentence that says so and what still works. Throws UsageError, listing the names, for another.
std::unique_ptr<Platform> open_platform(std::string_view name, const PlatformOptions& options,
                                        std::string& why);

/// Input for the platforms without a person: tests and scripts put it in, poll() gives it out.
class ScriptedPlatform : public Platform {
 public:
  explicit ScriptedPlatform(const PlatformOptions& options)
      : size_(options.size), scale_(options.scale > 0.0 ? options.scale : 1.0) {}

  void send(const InputEvent& event) { events_.push_back(event); }
  void resize(int width, int height) { size_ = {width, height}; }

  std::vector<InputEvent> poll() override { return std::exchange(events_, {}); }
  std::array<int, 2> size() const override { return size_; }
  double scale() const override { return scale_; }
  double now() const override { return static_cast<double>(pictures_) / 60.0; }
  void present(const render::RenderTarget*) override { ++pictures_; }

 private:
  std::array<int, 2> size_;
  double scale_;
  long pictures_ = 0;
  std::vector<InputEvent> events_;
};

/// The platforms by themselves; open_platform() chooses. `why` as there.
std::unique_ptr<Platform> open_window(const PlatformOptions& options, std::string& why);
std::unique_ptr<ScriptedPlatform> open_offscreen(const PlatformOptions& options, std::string& why);
std::unique_ptr<ScriptedPlatform> open_null(const PlatformOptions& options);

}  // namespace pedicel::app
