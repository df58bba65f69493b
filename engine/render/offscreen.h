#pragma once

#include <memory>
#include <string>

#include "engine/render/gl_functions.h"
#include "engine/render/osmesa_context.h"

namespace pedicel::render {

/// An OpenGL 3.3 core context without a window or a display: Mesa's software renderer through
/// OSMesa, opened at run time. It stays current on the thread that made it, and is to be used and
/// destroyed there.
class OffscreenContext {
 public:
  /// Nothing where OSMesa is absent or too old; `why` is then the sentence to show.
  static std::unique_ptr<OffscreenContext> create(std::string& why);

  /// The entry points of this context; they live as long as it does.
  const GlFunctions& gl() const { return gl_; }
  /// The driver's own name ("llvmpipe (LLVM 15.0.6, 256 bits)").
  std::string renderer_name() const;

 private:
  OffscreenContext(std::unique_ptr<OsMesaContext> context, const GlFunctions& gl)
      : context_(std::move(context)), gl_(gl) {}

  std::unique_ptr<OsMesaContext> context_;
  GlFunctions gl_;
};

}  // namespace pedicel::render
