#include "app/sense/scene_sensors.h"

#include <algorithm>
#include <cmath>

#include "app/draw/tint.h"
#include "engine/core/check.h"
#include "engine/core/joined.h"

namespace pedicel::app {

namespace {

/// Hard edges, no shadows and few triangles: enough for small pictures to learn from.
render::RenderSettings fast(render::RenderSettings settings) {
  settings.samples = 1;
  settings.shadows = false;
  settings.shadow_size = 256;
  settings.detail = 0.5;
  settings.contact = false;
  return settings;
}

}  // namespace

SceneSensors::SceneSensors(const simulation::Simulation& simulation)
    : simulation_(simulation), view_(simulation) {
  for (const world::SceneCamera& one : simulation.scene().cameras)
    longest_latency_ = std::max(longest_latency_, one.noise.latency);
  remember();
}

void SceneSensors::see(Seen& seen) {
  seen.step = simulation_.world().steps();
  seen.frame.list.clear();
  view_.fill(seen.frame);
  seen.keypoints = keypoints_of(simulation_, view_.things());
  seen.cameras.clear();
  for (const world::SceneCamera& one : simulation_.scene().cameras)
    seen.cameras.push_back(view_.camera(one.name, seen.frame));
}

void SceneSensors::remember() {
  if (longest_latency_ == 0.0) return;
  const long step = simulation_.world().steps();
  if (!past_.empty() && past_.back().step == step) return;
  if (!past_.empty() && past_.back().step != step - 1) past_.clear();  // steps that were not seen
  const auto kept = static_cast<std::size_t>(
      std::ceil(longest_latency_ / simulation_.world().dt() - 1.0e-9) + 1.0);
  Seen seen;
  if (past_.size() >= kept) {  // its memory serves again
    seen = std::move(past_.front());
    past_.pop_front();
  }
  see(seen);
  past_.push_back(std::move(seen));
}

int SceneSensors::camera_index(const std::string& name) const {
  const auto& cameras = simulation_.scene().cameras;
  if (name.empty()) return cameras.empty() ? -1 : 0;
  const auto found = std::ranges::find(cameras, name, &world::SceneCamera::name);
  if (found != cameras.end()) return static_cast<int>(found - cameras.begin());
  throw UsageError("no camera " + in_quotes(name) +
                   ", expected one of: " + joined(cameras, &world::SceneCamera::name));
}

std::optional<SensedPicture> SceneSensors::take(PictureTaker& taker, const SenseRequest& wanted,
                                                std::uint64_t seed) {
  const int index = camera_index(wanted.camera);
  const world::SceneCamera own = index < 0
                                     ? world::SceneCamera{}
                                     : simulation_.scene().cameras[static_cast<std::size_t>(index)];
  const double latency = wanted.noise ? own.noise.latency : 0.0;
  const Seen* shown = &now_;
  if (latency > 0.0) {
    remember();
    const long step = simulation_.world().steps() -
                      static_cast<long>(std::ceil(latency / simulation_.world().dt() - 1.0e-9));
    const auto later =
        std::ranges::find_if(past_, [&](const Seen& one) { return one.step > step; });
    shown = later == past_.begin() ? &past_.front() : &*std::prev(later);
  } else {
    see(now_);
  }
  const render::Camera camera =
      index < 0 ? view_.camera("", shown->frame) : shown->cameras[static_cast<std::size_t>(index)];
  const std::array<int, 2> size = wanted.size.value_or(own.size);
  shown_ = shown, camera_ = camera, size_ = size;
  taker.set(wanted.fast ? fast(light_of(simulation_.scene().look))
                        : light_of(simulation_.scene().look));
  auto seen = taker.sense(shown->frame, camera, size[0], size[1], wanted.colours);
  if (!seen) return {};
  SensedPicture picture;
  picture.time = shown->frame.time;
  picture.camera = matrices_of(camera, size[0], size[1]);
  picture.image = std::move(seen->image);
  picture.map = std::move(seen->map);
  picture.keypoints = shown->keypoints;
  look_at(picture.keypoints, picture.camera, picture.map);
  if (wanted.noise)
    add_noise(picture, own.noise,
              Random(noise_seed(seed, own.name, static_cast<std::uint64_t>(shown->step))));
  return picture;
}

namespace {

/// What has each label, by itself.
std::vector<render::DrawList> parts_of(const render::DrawList& list, std::size_t labels) {
  std::vector<render::DrawList> parts(labels);
  for (render::DrawList& part : parts) part.ground.reset();
  const auto share = [&](auto render::DrawList::*items) {
    for (const auto& item : list.*items)
      if (item.label < labels) (parts[item.label].*items).push_back(item);
  };
  share(&render::DrawList::capsules);
  share(&render::DrawList::tubes);
  share(&render::DrawList::spheres);
  share(&render::DrawList::boxes);
  share(&render::DrawList::meshes);
  share(&render::DrawList::blades);
  return parts;
}

}  // namespace

std::vector<long> SceneSensors::areas_alone(PictureTaker& taker) const {
  const std::size_t labels = things().all().size();
  std::vector<long> areas(labels, 0);
  if (!shown_) return areas;
  const std::vector<render::DrawList> parts = parts_of(shown_->frame.list, labels);
  for (std::size_t l = 1; l < labels; ++l) {
    if (parts[l].bounds().isEmpty()) continue;
    Frame alone;
    alone.list = parts[l];
    const auto seen = taker.sense(alone, camera_, size_[0], size_[1], false);
    if (seen) areas[l] = std::ranges::count(seen->map.labels, static_cast<render::Label>(l));
  }
  return areas;
}

}  // namespace pedicel::app
