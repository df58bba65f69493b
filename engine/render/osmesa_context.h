#pragma once

#include <memory>
#include <string>

namespace pedicel::render {

/// OSMesa's part of an off-screen context, kept apart because osmesa.h brings <GL/gl.h>, whose
/// declarations must not meet <GL/glcorearb.h>.
class OsMesaContext {
 public:
  virtual ~OsMesaContext() = default;
  /// The entry point of an OpenGL function, nullptr where there is none.
  virtual void* address(const char* name) const = 0;

  /// Makes a context and makes it current on this thread; nothing and a sentence where it cannot.
  static std::unique_ptr<OsMesaContext> create(std::string& why);
};

}  // namespace pedicel::render
