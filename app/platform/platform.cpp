#include "app/platform/platform.h"

#include "engine/core/check.h"
#include "engine/render/offscreen.h"

namespace pedicel::app {

namespace {

class OffscreenPlatform : public ScriptedPlatform {
 public:
  OffscreenPlatform(const PlatformOptions& options,
                    std::unique_ptr<render::OffscreenContext> context)
      : ScriptedPlatform(options), context_(std::move(context)) {}

  std::string_view name() const override { return "offscreen"; }
  const render::GlFunctions* gl() const override { return &context_->gl(); }

 private:
  std::unique_ptr<render::OffscreenContext> context_;
};

class NullPlatform : public ScriptedPlatform {
 public:
  using ScriptedPlatform::ScriptedPlatform;
  std::string_view name() const override { return "null"; }
};

}  // namespace

std::string Platform::renderer_name() const {
  if (!gl()) return "";
  const auto* text = reinterpret_cast<const char*>(gl()->GetString(GL_RENDERER));
  return text ? text : "unknown";
}

std::unique_ptr<ScriptedPlatform> open_offscreen(const PlatformOptions& options, std::string& why) {
  auto context = render::OffscreenContext::create(why);
  if (!context) return nullptr;
  return std::make_unique<OffscreenPlatform>(options, std::move(context));
}

std::unique_ptr<ScriptedPlatform> open_null(const PlatformOptions& options) {
  return std::make_unique<NullPlatform>(options);
}

std::unique_ptr<Platform> open_platform(std::string_view name, const PlatformOptions& options,
                                        std::string& why) {
  if (name == "window") return open_window(options, why);
  if (name == "offscreen") return open_offscreen(options, why);
  if (name == "null") return open_null(options);
  throw UsageError("platform " + std::string(name) + ": expected window, offscreen or null");
}

}  // namespace pedicel::app
