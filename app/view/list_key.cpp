#include "app/view/list_key.h"

#include <bit>

namespace pedicel::app {

namespace {

/// A word at a time, so that a scene of thousands of stems costs less than a millisecond: the
/// mixing of FNV-1a with the high bits brought down after each multiplication.
class Key {
 public:
  void add(std::uint64_t bits) {
    value_ = (value_ ^ bits) * 0x9e3779b97f4a7c15ull;
    value_ ^= value_ >> 29;
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(float value) { add(static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(value))); }
  void add(const Vec3& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  void add(const Pose& pose) {
    add(pose.position);
    for (int i = 0; i < 4; ++i) add(pose.rotation.coeffs()[i]);
  }
  void add(const render::Colour& c) { add(c.r), add(c.g), add(c.b); }
  void add(const render::Shading& m) { add(m.colour), add(m.roughness), add(m.specular); }
  void add(const render::TubeSegment& t) {
    for (const Vec3* v : {&t.p0, &t.p1, &t.tangent0, &t.tangent1}) add(*v);
    add(t.r0), add(t.r1), add(t.colour0), add(t.colour1), add(t.roughness), add(t.specular);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

void add_solids(Key& key, const render::DrawList& list) {
  for (const auto& c : list.capsules)
    key.add(c.p0), key.add(c.p1), key.add(c.r0), key.add(c.r1), key.add(c.material);
  for (const auto& s : list.spheres) key.add(s.centre), key.add(s.radius), key.add(s.material);
  for (const auto& b : list.boxes) key.add(b.pose), key.add(b.half_extents), key.add(b.material);
  for (const auto& m : list.meshes) {
    key.add(static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(m.mesh.get())));
    key.add(m.pose), key.add(m.material);
  }
}

void add_list(Key& key, const render::DrawList& list) {
  for (const std::size_t count :
       {list.capsules.size(), list.tubes.size(), list.spheres.size(), list.boxes.size(),
        list.meshes.size(), list.blades.size(), list.lines.size()})
    key.add(static_cast<std::uint64_t>(count));
  for (const auto& tube : list.tubes) key.add(tube);
  add_solids(key, list);
  for (const auto& b : list.blades) key.add(b.a), key.add(b.b), key.add(b.c), key.add(b.material);
  for (const auto& l : list.lines) key.add(l.a), key.add(l.b), key.add(l.colour), key.add(l.width);
  if (const auto& g = list.ground)
    key.add(g->height), key.add(g->cell), key.add(g->light), key.add(g->dark);
  key.add(static_cast<std::uint64_t>(list.ground.has_value()));
  key.add(static_cast<std::uint64_t>(list.ghost != nullptr));
  if (!list.ghost) return;
  key.add(list.ghost_opacity);
  add_list(key, *list.ghost);
}

}  // namespace

std::uint64_t list_key(const render::DrawList& list, const render::Camera& camera) {
  Key key;
  add_list(key, list);
  key.add(camera.eye), key.add(camera.target), key.add(camera.up);
  key.add(camera.field_of_view), key.add(camera.near_plane), key.add(camera.far_plane);
  return key.value();
}

}  // namespace pedicel::app
