#include "app/session/commands/command_table.h"
#include "app/session/session.h"
#include "app/session/session_films.h"
#include "engine/world/settings.h"

/// Films of what is done.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

FilmRequest request_of(const Command& c) {
  FilmRequest request;
  request.file = c.word("file");
  request.fps = c.number_or("fps", request.fps);
  if (c.has("size")) request.size = world::to_picture_size(c.word("size"), "size");
  request.camera = c.word_or("camera", "");
  request.with_interface = c.whole_or("ui", 0) != 0;
  return request;
}

}  // namespace

std::vector<CommandDescription> film_commands() {
  return {
      {"record",
       {{"file", Kind::text, true, "*.mp4, or pictures: frame_%05d.png"},
        {"fps", Kind::number, false, "Hz, pictures a simulated second (30)", {0.0, 1000.0, true}},
        {"size", Kind::word, false, "WxH, px (1280x720)"},
        {"camera", Kind::word, false, "of the scene's (the first)"},
        {"ui", Kind::whole, false, "1: the window with its panels (0: the scene alone)"}},
       "Begins a film of what is done from now on.",
       [](Session& session, const Command& c) { session.films().begin(request_of(c)); }},
      {"stop recording",
       {},
       "Ends the film.",
       [](Session& session, const Command&) { return session.films().end(); }},
  };
}

}  // namespace pedicel::app
