#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/session/film.h"

namespace pedicel::app {

class Session;

/// What the command line asks of the window.
struct DesktopRequest {
  std::string file;                    ///< scene, plant or log; empty: the first start's scene
  double unit = 0.0;                   ///< m, of a lone table's or MTG's lengths; 0: as it says
  std::vector<std::string> set;        ///< "key=value", over what the files say
  std::vector<std::string> packages;   ///< "NAME=PATH"
  std::array<int, 2> size{1280, 720};  ///< px
  std::string platform = "window";     ///< window | offscreen | null
  std::string theme;                   ///< dark | light; empty: as remembered
  double scale = 0.0;                  ///< 1, of texts; 0: as the monitor says
  bool playing = false;                ///< plays at once
  std::string screenshot;       ///< a picture is written there, and the program ends; empty: none
  std::string script;           ///< commands done before the picture is taken; empty: none
  bool with_interface = false;  ///< the picture shows the panels, too
  double time = 0.0;            ///< s, simulated before the picture
  std::string record;           ///< a film is written there, and the program ends; empty: none
  std::optional<double> duration, fps;  ///< s, Hz, of the film; else the scene's
  bool sized = false;                   ///< `size` was asked for
  std::string camera;                   ///< of the scene's; empty: the first
  bool quiet = false;                   ///< says nothing of a film's progress
  std::vector<std::string> show;        ///< panels that are in front: "Plots"
  std::string colours;  ///< of stems: strain | margin | contact | residual; empty: their own
};
/// Opens the window and stays until it is closed: the exit code. Nothing where there is no window
/// to open (it has said why, in one line).
using OpenDesktop = std::function<std::optional<int>(const DesktopRequest&)>;

/// Makes films of a session off screen, for scripts.
using MakeFilms = std::function<std::unique_ptr<FilmMaker>(Session&)>;

/// The whole program: reads the command line, does what it says, returns the exit code. Without
/// `open_desktop` there is no window. Codes:
/// (0 ok, 1 runtime failure, 2 usage, 3 a file is invalid or missing, 4 the simulation is unstable,
/// 5 an expectation is not met, 6 output cannot be written, 77 pictures were asked for and there is
/// no OpenGL, 128 plus the signal where one stopped it).
int run_cli(int argc, char** argv, const OpenDesktop& open_desktop = {},
            const MakeFilms& make_films = {});

}  // namespace pedicel::app
