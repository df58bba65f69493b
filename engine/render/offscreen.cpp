#include "engine/render/offscreen.h"

#include <stdexcept>

namespace pedicel::render {

std::unique_ptr<OffscreenContext> OffscreenContext::create(std::string& why) {
  std::unique_ptr<OsMesaContext> context = OsMesaContext::create(why);
  if (!context) return nullptr;
  try {
    const auto gl = GlFunctions::load([&](const char* name) { return context->address(name); });
    return std::unique_ptr<OffscreenContext>(new OffscreenContext(std::move(context), gl));
  } catch (const std::runtime_error& error) {
    why = std::string("no pictures: ") + error.what();
    return nullptr;
  }
}

std::string OffscreenContext::renderer_name() const {
  const auto* name = reinterpret_cast<const char*>(gl_.GetString(GL_RENDERER));
  return name ? name : "unknown";
}

}  // namespace pedicel::render
