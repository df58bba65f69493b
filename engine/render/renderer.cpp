#include "engine/render/renderer.h"

#include <map>
#include <string>

#include "engine/core/check.h"
#include "engine/render/colour_space.h"
#include "engine/render/contact_map.h"
#include "engine/render/frame_geometry.h"
#include "engine/render/label_pass.h"
#include "engine/render/programs.h"
#include "engine/render/render_target.h"
#include "engine/render/shadow_map.h"

namespace pedicel::render {

namespace {

constexpr int largest_side = 8192;
constexpr int smallest_shadow = 256;  // px

std::array<float, 16> columns(const Mat4& m) {
  std::array<float, 16> values;
  Eigen::Map<Eigen::Matrix4f>(values.data()) = m.cast<float>();
  return values;
}
std::array<float, 4> floats(const Vec3& v, double w = 0.0) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
          static_cast<float>(w)};
}
std::array<float, 4> floats(const Colour& colour, double w = 0.0) {
  const Colour c = to_linear(colour);
  return {c.r, c.g, c.b, static_cast<float>(w)};
}
std::array<float, 4> scaled(std::array<float, 4> v, double factor) {
  for (int i = 0; i < 3; ++i) v[i] *= static_cast<float>(factor);
  return v;
}

}  // namespace

void check(const RenderSettings& s) {
  const auto refuse = [](const std::string& field, const std::string& value,
                         const std::string& bound) {
    throw UsageError("RenderSettings." + field + " = " + value + ": must be " + bound);
  };
  if (s.samples != 1 && s.samples != 2 && s.samples != 4)
    refuse("samples", std::to_string(s.samples), "1, 2 or 4");
  if (s.shadow_size < smallest_shadow || s.shadow_size > largest_side)
    refuse("shadow_size", std::to_string(s.shadow_size) + " px", "between 256 and 8192");
  if (!(s.to_sun.z() > 0.0) || !s.to_sun.allFinite())
    refuse("to_sun.z", std::to_string(s.to_sun.z()), "> 0 (the sun is above the horizon)");
  if (!(s.sun >= 0.0)) refuse("sun", std::to_string(s.sun), ">= 0");
  if (!(s.detail > 0.0)) refuse("detail", std::to_string(s.detail), "> 0");
  if (!(s.exposure > 0.0)) refuse("exposure", std::to_string(s.exposure), "> 0");
}

class Renderer::Implementation {
 public:
  Implementation(const GlFunctions& gl, const RenderSettings& settings)
      : gl_(gl),
        settings_(settings),
        programs_(gl_),
        shapes_(gl_),
        cache_(gl_),
        seen_(gl_, shapes_, cache_),
        ghost_(gl_, shapes_, cache_),
        casting_(gl_, shapes_, cache_),
        contact_(gl_) {
    gl_.GenVertexArrays(1, &empty_array_);
  }
  ~Implementation() { gl_.DeleteVertexArrays(1, &empty_array_); }

  const RenderTarget& draw(const DrawList& list, const Camera& camera, int width, int height) {
    prepare_target(width, height);
    prepare_shadow(width, height);
    cache_.drop_unused();
    const Detail detail(camera, width, height, settings_.detail);
    seen_.prepare(list, detail);
    if (list.ghost) ghost_.prepare(*list.ghost, detail);
    Eigen::AlignedBox3d casters = list.bounds();
    if (casters.isEmpty()) casters.extend(camera.target);
    const SunView sun = fit_sun(casters, settings_.to_sun, shadow_->size());
    casting_.prepare(list, Detail(settings_.detail / sun.texel));
    FrameUniforms frame = light(list, casters);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_LESS);
    if (list.ground && settings_.contact) draw_contact(frame, casters, list.ground->height);
    // Everywhere beyond the map, where its border says that nothing is close.
    if (!settings_.contact) frame.contact_matrix[12] = frame.contact_matrix[13] = 2.0f;
    draw_shadow(frame, sun);
    look(frame, camera, casters, width, height);
    draw_picture(frame, list.ground.has_value());
    if (list.ghost) draw_ghost(list.ghost_opacity);
    return *target_;
  }

  /// Of the geometry that was prepared last: by draw() of the same list, or here.
  LabelMap label(const DrawList& list, const Camera& camera, int width, int height, bool prepared) {
    if (!prepared) {
      cache_.drop_unused();
      seen_.prepare(list, Detail(camera, width, height, settings_.detail));
    }
    if (!labels_) labels_ = std::make_unique<LabelPass>(gl_);
    Eigen::AlignedBox3d casters = list.bounds();
    if (casters.isEmpty()) casters.extend(camera.target);
    FrameUniforms frame = light(list, casters);
    look(frame, camera, casters, width, height);
    if (list.ground) frame.view_forward[3] = static_cast<float>(list.ground->label);
    programs_.set_frame(frame);
    return labels_->draw(seen_, list.ground.has_value(), empty_array_, width, height);
  }

  void set(const RenderSettings& settings) {
    if (settings.samples != settings_.samples) target_.reset();
    settings_ = settings;
  }

  long triangles() const { return seen_.triangles(); }

 private:
  void prepare_target(int width, int height) {
    if (target_ && target_->width() == width && target_->height() == height) return;
    target_.reset();
    target_ = std::make_unique<RenderTarget>(gl_, width, height, settings_.samples);
  }

  void prepare_shadow(int width, int height) {
    // Without shadows the map says that everything is lit.
    const int side =
        settings_.shadows ? shadow_side(settings_.shadow_size, width, height) : smallest_shadow;
    std::unique_ptr<DepthMap>& map = shadows_[side];
    if (!map) map = std::make_unique<DepthMap>(gl_, side, true);
    shadow_ = map.get();
  }

  FrameUniforms light(const DrawList& list, const Eigen::AlignedBox3d& casters) const {
    const double exposure = settings_.exposure;
    FrameUniforms frame;
    frame.sun_colour = scaled(floats(Colour{1.0f, 0.965f, 0.91f}), settings_.sun * exposure);
    frame.zenith = scaled(floats(Colour::hex(0x8fb2dc)), exposure);
    frame.horizon = scaled(floats(Colour::hex(0xe8eef4)), exposure);
    frame.bounce = scaled(floats(Colour::hex(0x8f887c)), exposure);
    const Ground ground = list.ground.value_or(Ground{});
    frame.ground_light = floats(ground.light, ground.cell);
    frame.ground_dark = floats(ground.dark, ground.height);
    const Vec3 centre = casters.center();
    const double size = std::max(casters.diagonal().norm(), 0.5);
    frame.ground_fade = floats(Vec3(centre.x(), centre.y(), 1.0 * size), 8.0 * size);
    return frame;
  }

  void look(FrameUniforms& frame, const Camera& camera, const Eigen::AlignedBox3d& casters,
            int width, int height) const {
    // The ground must not end at the far plane before it has faded.
    Camera wide = camera;
    wide.far_plane =
        std::max(camera.far_plane, (camera.eye - casters.center()).norm() +
                                       20.0 * std::max(casters.diagonal().norm(), 0.5));
    const Mat4 view = wide.view();
    const double up = 0.5 * height / camera.focal_length(height);
    frame.view_projection = columns(wide.projection(static_cast<double>(width) / height) * view);
    frame.eye = floats(camera.eye, wide.far_plane);
    frame.view_right = floats(view.block<1, 3>(0, 0).transpose() * up * width / height);
    frame.view_up = floats(view.block<1, 3>(1, 0).transpose() * up);
    frame.view_forward = floats(-view.block<1, 3>(2, 0).transpose());
    frame.viewport = {static_cast<float>(width), static_cast<float>(height),
                      static_cast<float>(camera.near_plane),
                      shadow_ ? 1.0f / static_cast<float>(shadow_->size()) : 0.0f};
  }

  /// Round things cast with their far side: the near side, whose coarse facets lie now inside, now
  /// outside those that are seen, would shade itself in stripes. The contact map's view is
  /// mirrored, so there the lower sides are kept, as they should be.
  void draw_casters() const {
    gl_.Enable(GL_CULL_FACE);
    gl_.CullFace(GL_FRONT);
    for (const Kind kind : {Kind::tube, Kind::sphere, Kind::mesh, Kind::blade}) {
      if (kind == Kind::mesh) gl_.Disable(GL_CULL_FACE);  // loaded meshes may not be closed
      programs_.use_depth(kind);
      casting_.draw(kind);
    }
  }

  void draw_contact(FrameUniforms& frame, const Eigen::AlignedBox3d& casters, double height) const {
    const Mat4 view = ContactMap::view_from_below(casters, height);
    frame.contact_matrix = columns(to_texture(view));
    frame.view_projection = columns(view);
    programs_.set_frame(frame);
    contact_.depths().begin();
    draw_casters();
    contact_.blur(programs_, empty_array_);
  }

  void draw_shadow(FrameUniforms& frame, const SunView& sun) const {
    frame.shadow_matrix = columns(to_texture(sun.matrix));
    frame.sun_direction = floats(settings_.to_sun.normalized(), 2.0 * sun.texel);
    frame.view_projection = columns(sun.matrix);
    programs_.set_frame(frame);
    shadow_->begin();
    if (!settings_.shadows) return;
    gl_.Enable(GL_POLYGON_OFFSET_FILL);
    gl_.PolygonOffset(1.5f, 2.0f);
    draw_casters();
    gl_.Disable(GL_POLYGON_OFFSET_FILL);
  }

  void draw_picture(const FrameUniforms& frame, bool ground) const {
    programs_.set_frame(frame);
    target_->bind();
    gl_.Clear(GL_DEPTH_BUFFER_BIT);
    shadow_->bind_texture(shadow_unit);
    contact_.bind_texture(contact_unit);
    draw_lit(seen_);
    gl_.BindVertexArray(empty_array_);
    if (ground) {
      programs_.use_ground();
      gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
    gl_.DepthFunc(GL_LEQUAL);  // the sky lies at the far end of the depth range
    programs_.use_sky();
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }

  /// Its depths first, so that of its own surfaces only the nearest is blended; a little farther
  /// away than it is, so that it does not flicker through the thing that it is the ghost of.
  void draw_ghost(float opacity) const {
    gl_.Enable(GL_POLYGON_OFFSET_FILL);
    gl_.PolygonOffset(2.0f, 4.0f);
    gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_lit(ghost_);
    gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl_.Enable(GL_BLEND);
    gl_.BlendColor(0.0f, 0.0f, 0.0f, opacity);
    gl_.BlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
    draw_lit(ghost_);
    gl_.Disable(GL_BLEND);
    gl_.Disable(GL_POLYGON_OFFSET_FILL);
  }

  void draw_lit(const FrameGeometry& geometry) const {
    for (int kind = 0; kind < kind_count; ++kind) {
      programs_.use_lit(static_cast<Kind>(kind));
      geometry.draw(static_cast<Kind>(kind), true);
    }
  }

  GlFunctions gl_;
  RenderSettings settings_;
  Programs programs_;
  UnitMeshes shapes_;
  MeshCache cache_;
  FrameGeometry seen_, ghost_, casting_;
  std::map<int, std::unique_ptr<DepthMap>> shadows_;  // by their sides, px
  DepthMap* shadow_ = nullptr;                        // of the last picture
  std::unique_ptr<LabelPass> labels_;                 // once it is asked for
  ContactMap contact_;
  std::unique_ptr<RenderTarget> target_;
  GLuint empty_array_ = 0;
};

Renderer::Renderer(const GlFunctions& gl, const RenderSettings& settings) {
  check(settings);
  implementation_ = std::make_unique<Implementation>(gl, settings);
}
Renderer::~Renderer() = default;

void Renderer::set(const RenderSettings& settings) {
  check(settings);
  implementation_->set(settings);
}

namespace {

void check_size(int width, int height) {
  if (width < 1 || height < 1 || width > largest_side || height > largest_side)
    throw UsageError("picture of " + std::to_string(width) + " x " + std::to_string(height) +
                     " px: must be between 1 x 1 and 8192 x 8192");
}

}  // namespace

Image Renderer::render(const DrawList& list, const Camera& camera, int width, int height) {
  check_size(width, height);
  check(camera);
  return implementation_->draw(list, camera, width, height).read();
}

LabelMap Renderer::label(const DrawList& list, const Camera& camera, int width, int height) {
  check_size(width, height);
  check(camera);
  return implementation_->label(list, camera, width, height, false);
}

Renderer::Labelled Renderer::render_labelled(const DrawList& list, const Camera& camera, int width,
                                             int height) {
  Labelled both;
  both.image = render(list, camera, width, height);
  both.map = implementation_->label(list, camera, width, height, true);
  return both;
}

void Renderer::draw(const DrawList& list, const Camera& camera, int width, int height,
                    unsigned framebuffer) {
  check_size(width, height);
  check(camera);
  implementation_->draw(list, camera, width, height).resolve_to(framebuffer);
}

long Renderer::triangles() const {
  return implementation_->triangles();
}

}  // namespace pedicel::render
