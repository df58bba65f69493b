#pragma once

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace pedicel::app {

/// What a film is to be like.
struct FilmRequest {
  std::filesystem::path file;          ///< *.mp4, or numbered pictures: frame_%05d.png
  double fps = 30.0;                   ///< Hz: pictures a second of the film
  std::array<int, 2> size{1280, 720};  ///< px
  std::string camera;                  ///< of the scene's; empty: the first
  bool with_interface = false;         ///< the window with its panels
};

/// Pictures were asked for and cannot be made here; exit code 77.
class NoPictures : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Who makes pictures of what a session shows; the session itself has none. Where the session's
/// commands wait, it calls add() each time that 1/fps of simulated time has passed, whatever that
/// takes; else the maker takes its pictures by the clock.
class FilmMaker {
 public:
  virtual ~FilmMaker() = default;
  /// Throws UsageError, io::WriteError, NoPictures.
  virtual void begin(const FilmRequest& request) = 0;
  virtual bool running() const = 0;
  /// A picture of the session's newest snapshot. Throws io::WriteError.
  virtual void add() = 0;
  /// Closes the film; what was made, to be told. Throws io::WriteError.
  virtual std::string end() = 0;
};

}  // namespace pedicel::app
