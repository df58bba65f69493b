#include "engine/render/osmesa_context.h"

#ifdef PEDICEL_HAS_OSMESA

#include <GL/osmesa.h>
#include <dlfcn.h>

#include <array>
#include <string>

#ifdef __SANITIZE_ADDRESS__
/// OSMesa keeps about 100 bytes of every context for the life of the program; that is its own.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa\n";
}
#endif

namespace pedicel::render {

namespace {

struct Library {
  decltype(&OSMesaCreateContextAttribs) create = nullptr;
  decltype(&OSMesaDestroyContext) destroy = nullptr;
  decltype(&OSMesaMakeCurrent) make_current = nullptr;
  decltype(&OSMesaGetProcAddress) address = nullptr;
};

/// What still works.
const char* const rest = "; runs work without, with --no-pictures";

template <class Function>
bool find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(::dlsym(library, name));
  return function != nullptr;
}

/// The library stays open for the life of the program: LLVM inside it does not survive closing.
bool open_library(Library& library, std::string& why) {
  void* handle = ::dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
  if (!handle) handle = ::dlopen("libOSMesa.so", RTLD_NOW | RTLD_LOCAL);
  if (!handle) {
    why = std::string(
              "no pictures: the library libOSMesa.so.8 cannot be opened (Debian package "
              "libosmesa6)") +
          rest;
    return false;
  }
  if (find(handle, "OSMesaCreateContextAttribs", library.create) &&
      find(handle, "OSMesaDestroyContext", library.destroy) &&
      find(handle, "OSMesaMakeCurrent", library.make_current) &&
      find(handle, "OSMesaGetProcAddress", library.address))
    return true;
  why = std::string("no pictures: libOSMesa.so.8 is too old, expected version 12 or newer") + rest;
  return false;
}

class OpenedContext : public OsMesaContext {
 public:
  OpenedContext(const Library& library, ::OSMesaContext context)
      : library_(library), context_(context) {}
  ~OpenedContext() override { library_.destroy(context_); }
  OpenedContext(const OpenedContext&) = delete;
  OpenedContext& operator=(const OpenedContext&) = delete;

  /// OSMesa wants memory to draw to; we draw to framebuffer objects, so it stays small.
  bool make_current() {
    return library_.make_current(context_, pixels_.data(), GL_UNSIGNED_BYTE, side, side);
  }
  void* address(const char* name) const override {
    return reinterpret_cast<void*>(library_.address(name));
  }

 private:
  static constexpr int side = 16;
  Library library_;
  ::OSMesaContext context_;
  std::array<unsigned char, 4 * side * side> pixels_{};
};

}  // namespace

std::unique_ptr<OsMesaContext> OsMesaContext::create(std::string& why) {
  Library library;
  if (!open_library(library, why)) return nullptr;
  static constexpr std::array<int, 11> attributes = {OSMESA_FORMAT,
                                                     OSMESA_RGBA,
                                                     OSMESA_DEPTH_BITS,
                                                     0,
                                                     OSMESA_PROFILE,
                                                     OSMESA_CORE_PROFILE,
                                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                                     3,
                                                     OSMESA_CONTEXT_MINOR_VERSION,
                                                     3,
                                                     0};
  ::OSMesaContext handle = library.create(attributes.data(), nullptr);
  if (handle) {
    auto context = std::make_unique<OpenedContext>(library, handle);
    if (context->make_current()) return context;
  }
  why = std::string("no pictures: OSMesa could not make an OpenGL 3.3 core context") + rest;
  return nullptr;
}

}  // namespace pedicel::render

#else

namespace pedicel::render {

std::unique_ptr<OsMesaContext> OsMesaContext::create(std::string& why) {
  why =
      "no pictures: this program was built without OSMesa (Debian package libosmesa6-dev), "
      "build it again with it; runs work without, with --no-pictures";
  return nullptr;
}

}  // namespace pedicel::render

#endif
