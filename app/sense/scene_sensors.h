#pragma once

#include <deque>
#include <memory>

#include "app/sense/noise.h"

namespace pedicel::app {

/// Which picture is wanted of a scene.
struct SenseRequest {
  std::string camera;                           ///< of the scene; empty: the first, or one of all
  std::optional<std::array<int, 2>> size = {};  ///< px; else the camera's own
  bool colours = true;
  bool noise = true;  ///< the camera's own, its latency included
  bool fast = false;  ///< hard edges and no shadows; labels and depths of coarser shapes
};

/// The cameras of a simulation, which must outlive it.
class SceneSensors {
 public:
  explicit SceneSensors(const simulation::Simulation& simulation);

  const NamedThings& things() const { return view_.things(); }
  /// The same labels for other pictures of the simulation.
  SceneView& view() { return view_; }

  /// To be called after every step where a camera comes late: keeps what is seen for it.
  void remember();

  /// What a camera shows now: with its latency, what it saw that long ago (at the start what it saw
  /// then). Noise is drawn from the seed, the camera's name and the step that is shown, so that it
  /// depends neither on other cameras nor on how many pictures are taken. Throws UsageError for an
  /// unknown camera; nothing where pictures cannot be taken.
  std::optional<SensedPicture> take(PictureTaker& taker, const SenseRequest& wanted,
                                    std::uint64_t seed);

  /// Pixels of the last picture that each thing would cover with nothing before it, by label; those
  /// of the ground are left out.
  std::vector<long> areas_alone(PictureTaker& taker) const;

 private:
  struct Seen {
    long step = 0;
    Frame frame;
    std::vector<Keypoint> keypoints;
    std::vector<render::Camera> cameras;  // of the scene, as they stood
  };
  void see(Seen& seen);
  int camera_index(const std::string& name) const;

  const simulation::Simulation& simulation_;
  SceneView view_;
  double longest_latency_ = 0.0;  // s
  std::deque<Seen> past_;
  Seen now_;
  const Seen* shown_ = nullptr;  // by the last picture
  render::Camera camera_;        // of it
  std::array<int, 2> size_{0, 0};
};

}  // namespace pedicel::app
