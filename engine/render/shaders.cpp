#include "engine/render/shaders.h"

namespace pedicel::render::shaders {

namespace {

/// The same for every program of a pass; FrameUniforms in programs.h mirrors it.
const std::string header = R"(#version 330 core
layout(std140) uniform Frame {
  mat4 view_projection;
  mat4 shadow_matrix;    // world to the shadow map's [0, 1]
  mat4 contact_matrix;   // world to the contact map's [0, 1]
  vec4 eye;              // W; w: far plane
  vec4 view_right;       // half width of the picture at distance 1
  vec4 view_up;          // half height
  vec4 view_forward;     // w: label of the ground
  vec4 sun_direction;    // towards the sun; w: normal offset in the shadow map, m
  vec4 sun_colour;
  vec4 zenith;
  vec4 horizon;
  vec4 bounce;           // light that comes up from the ground
  vec4 viewport;         // width, height, near plane, side of a shadow texel in [0, 1]
  vec4 ground_light;     // w: side of a checker field, m
  vec4 ground_dark;      // w: height of the ground, m
  vec4 ground_fade;      // centre x, y; where the fading begins and ends, m
};
)";

const std::string outputs = R"(
out vec3 v_position;
out vec3 v_normal;
out vec3 v_colour;
flat out vec3 v_surface;  // roughness, specular, share of light let through
flat out float v_label;
void put(vec3 position, vec3 normal, vec3 colour, vec3 surface, float through) {
  v_position = position;
  v_normal = normal;
  v_colour = colour;
  v_surface = vec3(surface.xy, through);
  v_label = surface.z;
  gl_Position = view_projection * vec4(position, 1.0);
}
)";

/// Colours stay as they are up to 0.6, so that a strain colour in the picture is the one of the
/// legend; only what is brighter is pressed together below 1.
const std::string tone = R"(
uniform sampler2DShadow shadow_map;
uniform sampler2D contact_map;
vec3 toned(vec3 colour) {
  const float knee = 0.6;
  vec3 over = max(colour - knee, 0.0) / (1.0 - knee);
  return pow(min(colour, knee) + (1.0 - knee) * (1.0 - exp(-over)), vec3(1.0 / 2.2));
}
float sun_reaching(vec3 position, vec3 normal) {
  vec3 p = (shadow_matrix * vec4(position + normal * sun_direction.w, 1.0)).xyz;
  vec2 t = vec2(viewport.w * 1.1, viewport.w * 0.45);
  float z = min(p.z, 1.0);
  return 0.25 * (texture(shadow_map, vec3(p.xy + vec2(t.x, t.y), z)) +
                 texture(shadow_map, vec3(p.xy + vec2(-t.y, t.x), z)) +
                 texture(shadow_map, vec3(p.xy - vec2(t.x, t.y), z)) +
                 texture(shadow_map, vec3(p.xy - vec2(-t.y, t.x), z)));
}
vec3 sky_colour(float up) {
  return mix(horizon.rgb, zenith.rgb, smoothstep(-0.03, 0.3, max(up, 0.0)));
}
)";

}  // namespace

std::string tube_vertex() {
  return header + outputs + R"(
layout(location = 0) in vec4 base;  // along, towards the pole (-1 .. 1), cos, sin around
layout(location = 1) in vec4 end0;  // position, radius
layout(location = 2) in vec4 end1;
layout(location = 3) in vec3 tangent0;
layout(location = 4) in vec3 tangent1;
layout(location = 5) in vec3 side0;
layout(location = 6) in vec3 side1;
layout(location = 7) in vec3 colour0;
layout(location = 8) in vec3 colour1;
layout(location = 9) in vec3 surface;  // roughness, specular, label
void main() {
  float s = base.x;
  float reach = distance(end0.xyz, end1.xyz);
  // The cone that touches both spheres leaves them at the angle `lean` from their equators.
  float lean = asin(clamp((end0.w - end1.w) / reach, -1.0, 1.0));
  float latitude = base.y < 0.0 ? mix(lean, -1.5707963, -base.y) : mix(lean, 1.5707963, base.y);
  // Cubic Hermite curve through the ends; straight where the tangents are.
  float s2 = s * s, s3 = s2 * s;
  vec3 centre = (2.0 * s3 - 3.0 * s2 + 1.0) * end0.xyz + (3.0 * s2 - 2.0 * s3) * end1.xyz +
                reach * ((s3 - 2.0 * s2 + s) * tangent0 + (s3 - s2) * tangent1);
  vec3 along = normalize(6.0 * (s - s2) * (end1.xyz - end0.xyz) +
                         reach * ((3.0 * s2 - 4.0 * s + 1.0) * tangent0 +
                                  (3.0 * s2 - 2.0 * s) * tangent1));
  vec3 side = mix(side0, side1, s);
  side = normalize(side - dot(side, along) * along);
  vec3 around = base.z * side + base.w * cross(along, side);
  vec3 normal = cos(latitude) * around + sin(latitude) * along;
  put(centre + mix(end0.w, end1.w, s) * normal, normal, mix(colour0, colour1, s),
      surface, 0.0);
}
)";
}

std::string sphere_vertex() {
  return header + outputs + R"(
layout(location = 0) in vec3 direction;
layout(location = 1) in vec4 ball;  // centre, radius
layout(location = 2) in vec3 colour;
layout(location = 3) in vec3 surface;  // roughness, specular, label
void main() {
  put(ball.xyz + ball.w * direction, direction, colour, surface, 0.0);
}
)";
}

std::string mesh_vertex() {
  return header + outputs + R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 row0;
layout(location = 3) in vec4 row1;
layout(location = 4) in vec4 row2;
layout(location = 5) in vec3 colour;
layout(location = 6) in vec3 surface;  // roughness, specular, label
void main() {
  vec4 p = vec4(position, 1.0);
  // A stretched box keeps the directions of its face normals, so the same matrix serves both.
  vec3 n = normalize(vec3(dot(row0.xyz, normal), dot(row1.xyz, normal), dot(row2.xyz, normal)));
  put(vec3(dot(row0, p), dot(row1, p), dot(row2, p)), n, colour, surface, 0.0);
}
)";
}

std::string blade_vertex() {
  return header + outputs + R"(
layout(location = 0) in vec3 weights;
layout(location = 1) in vec3 a;
layout(location = 2) in vec3 b;
layout(location = 3) in vec3 c;
layout(location = 4) in vec3 colour;
layout(location = 5) in vec3 surface;  // roughness, specular, label
void main() {
  vec3 n = cross(b - a, c - a);
  put(weights.x * a + weights.y * b + weights.z * c, n / max(length(n), 1e-20), colour,
      surface, 0.6);
}
)";
}

std::string line_vertex() {
  return header + R"(
layout(location = 0) in vec2 corner;  // which end, which side
layout(location = 1) in vec3 a;
layout(location = 2) in vec3 b;
layout(location = 3) in vec4 look;    // colour, width in px
out vec3 v_colour;
void main() {
  v_colour = look.rgb;
  vec4 pa = view_projection * vec4(a, 1.0);
  vec4 pb = view_projection * vec4(b, 1.0);
  // Cut off what lies behind the near plane, where the division by w turns the picture over.
  float near = viewport.z;
  if (pa.w < near && pb.w > near) pa = mix(pa, pb, (near - pa.w) / (pb.w - pa.w));
  if (pb.w < near && pa.w > near) pb = mix(pb, pa, (near - pb.w) / (pa.w - pb.w));
  vec2 direction = (pb.xy / pb.w - pa.xy / pa.w) * viewport.xy;
  float reach = length(direction);
  vec2 across = reach > 1e-6 ? vec2(-direction.y, direction.x) / reach : vec2(0.0);
  vec4 p = corner.x < 0.5 ? pa : pb;
  gl_Position = p + vec4(corner.y * look.w * across / viewport.xy * p.w, -1e-5 * p.w, 0.0);
}
)";
}

std::string ground_vertex() {
  return header + R"(
out vec3 v_position;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  v_position = vec3(ground_fade.xy + corner * ground_fade.w, ground_dark.w);
  gl_Position = view_projection * vec4(v_position, 1.0);
}
)";
}

std::string full_screen_vertex() {
  return header + R"(
out vec2 v_screen;
void main() {
  v_screen = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
  gl_Position = vec4(v_screen, 1.0, 1.0);
}
)";
}

std::string lit_fragment() {
  return header + tone + R"(
in vec3 v_position;
in vec3 v_normal;
in vec3 v_colour;
flat in vec3 v_surface;
out vec4 pixel;
void main() {
  vec3 to_eye = normalize(eye.xyz - v_position);
  vec3 n = normalize(v_normal);
  if (!gl_FrontFacing) n = -n;
  float facing = dot(n, sun_direction.xyz);
  float sun = sun_reaching(v_position, n * sign(facing));
  // Diffuse: the sun, and a hemisphere of sky above and lit ground below.
  vec3 ambient = mix(bounce.rgb, zenith.rgb * 0.55 + horizon.rgb * 0.45, n.z * 0.5 + 0.5) * 0.5;
  float through = v_surface.z * max(-facing, 0.0);
  vec3 light = v_colour * (ambient + sun_colour.rgb * sun * (max(facing, 0.0) + through));
  // Highlight: normalised Blinn-Phong with Schlick's Fresnel term, and a blurred sky.
  vec3 half_way = normalize(sun_direction.xyz + to_eye);
  float roughness2 = v_surface.x * v_surface.x;
  float shine = 2.0 / (roughness2 * roughness2 + 1e-3) - 1.0;
  float lobe = (shine + 8.0) * 0.125 * pow(max(dot(n, half_way), 1e-4), shine);
  float grazing = 1.0 - clamp(dot(n, to_eye), 0.0, 1.0);
  float grazing2 = grazing * grazing;
  float fresnel = 0.04 + 0.96 * grazing2 * grazing2 * grazing;
  light += v_surface.y * sun_colour.rgb * (0.05 * lobe * sun * max(facing, 0.0));
  vec3 mirrored = reflect(-to_eye, n);
  vec3 seen = mix(bounce.rgb, sky_colour(mirrored.z), smoothstep(-0.25, 0.25, mirrored.z));
  light += v_surface.y * (1.0 - 0.8 * v_surface.x) * fresnel * seen;
  pixel = vec4(toned(light), 1.0);
}
)";
}

std::string line_fragment() {
  return header + tone + R"(
in vec3 v_colour;
out vec4 pixel;
void main() { pixel = vec4(pow(v_colour, vec3(1.0 / 2.2)), 1.0); }
)";
}

std::string ground_fragment() {
  return header + tone + R"(
in vec3 v_position;
out vec4 pixel;
// The mean of a square wave (+1, -1, period 2) over a pixel: its integral is a triangle wave.
vec2 triangle(vec2 x) { return abs(fract(x * 0.5) * 2.0 - 1.0); }
float checker(vec2 x) {
  vec2 w = max(fwidth(x) * 1.2, 1e-4);
  vec2 mean = (triangle(x + 0.5 * w) - triangle(x - 0.5 * w)) / w;
  return mean.x * mean.y;
}
void main() {
  vec3 base = mix(ground_dark.rgb, ground_light.rgb, 0.5 + 0.5 *
                  checker(v_position.xy / ground_light.w));
  float sun = sun_reaching(v_position, vec3(0.0, 0.0, 1.0));
  vec2 c = (contact_matrix * vec4(v_position, 1.0)).xy;
  float contact = 1.0 - 0.75 * texture(contact_map, c).r;
  vec3 ambient = (zenith.rgb * 0.55 + horizon.rgb * 0.45) * 0.5 * contact;
  vec3 light = base * (ambient + sun_colour.rgb * sun * sun_direction.z * mix(contact, 1.0, 0.5));
  float fade = smoothstep(ground_fade.z, ground_fade.w, distance(v_position.xy, ground_fade.xy));
  pixel = vec4(toned(mix(light, horizon.rgb, fade)), 1.0);
}
)";
}

std::string sky_fragment() {
  return header + tone + R"(
in vec2 v_screen;
out vec4 pixel;
void main() {
  vec3 ray = normalize(view_forward.xyz + v_screen.x * view_right.xyz + v_screen.y * view_up.xyz);
  pixel = vec4(toned(sky_colour(ray.z)), 1.0);
}
)";
}

std::string blur_fragment() {
  return header + R"(
uniform sampler2D depth_map;
in vec2 v_screen;
out vec4 pixel;
void main() {
  vec2 centre = v_screen * 0.5 + 0.5;
  vec2 texel = 1.0 / vec2(textureSize(depth_map, 0));
  float sum = 0.0, weights = 0.0;
  for (int y = -4; y <= 4; ++y)
    for (int x = -4; x <= 4; ++x) {
      float weight = exp(-float(x * x + y * y) / 8.0);
      float height = texture(depth_map, centre + 1.5 * vec2(x, y) * texel).r;
      sum += weight * (1.0 - height) * (1.0 - height);
      weights += weight;
    }
  pixel = vec4(sum / weights, 0.0, 0.0, 1.0);
}
)";
}

/// The clip coordinate w is the distance along the view axis, since the projection's last row is
/// (0, 0, -1, 0).
std::string label_fragment() {
  return header + R"(
flat in float v_label;
out vec2 pixel;
void main() { pixel = vec2(v_label, 1.0 / gl_FragCoord.w); }
)";
}

std::string ground_label_fragment() {
  return header + R"(
out vec2 pixel;
void main() { pixel = vec2(view_forward.w, 1.0 / gl_FragCoord.w); }
)";
}

std::string empty_fragment() {
  return "#version 330 core\nvoid main() {}\n";
}

}  // namespace pedicel::render::shaders
