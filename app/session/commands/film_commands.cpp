#include <cstdio>

#include "app/session/commands/command_table.h"
#include "app/session/session.h"
#include "app/session/session_films.h"
#include "engine/core/check.h"

/// Films of what is done.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

std::array<int, 2> size_of(const std::string& text) {
  std::array<int, 2> size{};
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size[0], &size[1], &rest) != 2 || size[0] < 16 ||
      size[1] < 16 || size[0] > 8192 || size[1] > 8192)
    throw UsageError("size \"" + text + "\", expected WxH in px, 16 to 8192 each (1280x720)");
  return size;
}

FilmRequest request_of(const Command& c) {
  FilmRequest request;
  request.file = c.word("file");
  request.fps = c.number_or("fps", request.fps);
  if (!(request.fps > 0.0 && request.fps <= 1000.0))
    throw UsageError("fps, expected Hz above 0 and at most 1000");
  if (c.has("size")) request.size = size_of(c.word("size"));
  request.camera = c.word_or("camera", "");
  request.with_interface = c.whole_or("ui", 0) != 0;
  return request;
}

Result begin_recording(Session& session, const Command& c) {
  session.films().begin(request_of(c));
  return {};
}

Result end_recording(Session& session, const Command&) {
  return session.films().end();
}

}  // namespace

std::vector<CommandDescription> film_commands() {
  const Scope s = Scope::session;
  return {
      {"record",
       s,
       {{"file", Kind::text, true, "*.mp4, or pictures: frame_%05d.png"},
        {"fps", Kind::number, false, "Hz, pictures a simulated second (30)"},
        {"size", Kind::word, false, "WxH, px (1280x720)"},
        {"camera", Kind::word, false, "of the scene's (the first)"},
        {"ui", Kind::whole, false, "1: the window with its panels (0: the scene alone)"}},
       "Begins a film of what is done from now on.",
       begin_recording},
      {"stop recording", s, {}, "Ends the film.", end_recording},
  };
}

}  // namespace pedicel::app
