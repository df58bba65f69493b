#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace pedicel::app {

struct PlayRequest {
  std::string log;
  std::vector<std::string> packages;   ///< "NAME=PATH"
  std::string film;                    ///< *.mp4, or frame_%05d.png; empty: none
  std::string picture;                 ///< *.png; empty: none
  std::optional<double> at;            ///< s, of the picture; absent: the end
  std::optional<double> from, to;      ///< s, of the film; absent: all
  double fps = 30.0;                   ///< Hz, of simulated time
  std::array<int, 2> size{1280, 720};  ///< px
  bool quiet = false;
};

/// A film, a picture or both of a log. Returns the exit code: 77 where no pictures can be taken.
/// Throws InvalidFile, UsageError and render::OutputError.
int play_off_screen(const PlayRequest& request);

}  // namespace pedicel::app
