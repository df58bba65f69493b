#include "engine/render/gl_functions.h"

#include <stdexcept>
#include <string>

namespace pedicel::render {

GlFunctions GlFunctions::load(const std::function<void*(const char*)>& address) {
  GlFunctions gl;
  const auto find = [&](const char* name) {
    void* function = address(name);
    if (!function)
      throw std::runtime_error(std::string("OpenGL function ") + name +
                               " is missing, expected an OpenGL 3.3 core context");
    return function;
  };
#define PEDICEL_GL_LOAD(TYPE, NAME) gl.NAME = reinterpret_cast<PFNGL##TYPE##PROC>(find("gl" #NAME));
  PEDICEL_GL_FUNCTIONS(PEDICEL_GL_LOAD)
#undef PEDICEL_GL_LOAD
  return gl;
}

}  // namespace pedicel::render
