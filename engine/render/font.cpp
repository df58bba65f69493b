#include "engine/render/font.h"

#include <algorithm>
#include <map>
#include <string>

namespace pedicel::render {

namespace {

struct Drawn {
  char32_t character;
  const char* strokes;
};

// Strokes are separated by spaces. The first character is the kind: '-' straight from point to
// point, '~' a smooth open curve, 'o' a smooth closed one (quadratic B-splines over the points).
// Then pairs of x and y, each one digit 0..9, a..z; y counts from the descender line: 0 descender,
// 4 baseline, c height of a small x, g cap height.
constexpr Drawn drawn[] = {
    {'0', "o0g7g7a74040a"},
    {'1', "-1d4g44"},
    {'2', "~0d0g7g7b04 -0474"},
    {'3', "~0e0g7g7a3a ~3a7a740406"},
    {'4', "-545g0878"},
    {'5', "-6g1g0a ~0a1c7c740406"},
    {'6', "o0b7b7404 ~5g0e07"},
    {'7', "-0g7g24"},
    {'8', "o0g7g7a0a o0a7a7404"},
    {'9', "o09797g0g ~7d7624"},
    {'A', "-044g84 -1878"},
    {'B', "-4g0g0444 -0a4a ~4g8g8a4a ~4a8a8444"},
    {'C', "~8d8g0g0a048487"},
    {'D', "-3g0g0434 ~3g8g8a8434"},
    {'E', "-7g0g0474 -0a6a"},
    {'F', "-7g0g04 -0a6a"},
    {'G', "~8d8g0g0a048489 -4989"},
    {'H', "-0g04 -8g84 -0a8a"},
    {'I', "-0g04"},
    {'J', "-5g59 ~59540407"},
    {'K', "-0g04 -7g09 -3c74"},
    {'L', "-0g0474"},
    {'M', "-040g58aga4"},
    {'N', "-040g848g"},
    {'O', "o0g9g9a94040a"},
    {'P', "-040g4g -0949 ~4g8g8949"},
    {'Q', "o0g9g9a94040a -57a3"},
    {'R', "-040g4g -0949 ~4g8g8949 -4984"},
    {'S', "~7e7g0g0a7a740406"},
    {'T', "-0g8g -4g44"},
    {'U', "-0g09 ~09048489 -898g"},
    {'V', "-0g448g"},
    {'W', "-0g346g94cg"},
    {'X', "-0g84 -8g04"},
    {'Y', "-0g4a8g -4a44"},
    {'Z', "-0g8g0484"},
    {'a', "o0c6c6404 -6c64"},
    {'b', "-0g04 o0c6c6404"},
    {'c', "~6a6c0c046466"},
    {'d', "o0c6c6404 -6g64"},
    {'e', "-0868 ~686c0c046466"},
    {'f', "~4g1g1d -1d14 -0c4c"},
    {'g', "o0c6c6404 -6c64 ~64600002"},
    {'h', "-0g04 ~090c6c69 -6964"},
    {'i', "-0c04 -0g0g"},
    {'j', "-2c23 ~232000 -2g2g"},
    {'k', "-0g04 -5c07 -2964"},
    {'l', "-0g04"},
    {'m', "-0c04 ~090c5c59 -5954 ~595caca9 -a9a4"},
    {'n', "-0c04 ~090c6c69 -6964"},
    {'o', "o0c6c6404"},
    {'p', "-0c00 o0c6c6404"},
    {'q', "o0c6c6404 -6c60"},
    {'r', "-0c04 ~090c4c"},
    {'s', "~5a5c0c0858540406"},
    {'t', "-1f17 ~171444 -0c4c"},
    {'u', "-0c07 ~07046467 -6c64"},
    {'v', "-0c346c"},
    {'w', "-0c244c648c"},
    {'x', "-0c64 -6c04"},
    {'y', "-0c34 -6c21"},
    {'z', "-0c6c0464"},
    {'.', "-0404"},
    {',', "-1402"},
    {':', "-0404 -0b0b"},
    {';', "-1402 -1b1b"},
    {'!', "-0g08 -0404"},
    {'?', "~0d0g6g6b3b38 -3434"},
    {'-', "-0949"},
    {'+', "-0969 -3c36"},
    {'=', "-0b6b -0767"},
    {'/', "-036g"},
    {'\\', "-0g63"},
    {'(', "~3h0d0531"},
    {')', "~0h3d3501"},
    {'[', "-3h0h0131"},
    {']', "-0h3h3101"},
    {'{', "~4h2h2909 ~09292141"},
    {'}', "~0h2h2949 ~49292101"},
    {'%', "o0g4g4b0b o59999454 -8g14"},
    {'_', "-0363"},
    {'<', "-6d0965"},
    {'>', "-0d6905"},
    {'*', "-3g3a -0e6c -6e0c"},
    {'#', "-2g14 -6g54 -0c7c -0878"},
    {'"', "-0g0d -3g3d"},
    {'\'', "-0g0d"},
    {'|', "-0h01"},
    {'^', "-0c3g6c"},
    {'~', "~080b4b48888b"},
    {'`', "-0g2e"},
    {'@', "o0gaga303 o3c7c7737"},
    {'$', "~7e7g0g0a7a740406 -4h42"},
    {'&', "o1g5g5b1b ~2b09046489 -3b84"},
    {U'\u00b0', "o0g4g4c0c"},
    {U'\u00b5', "-0c00 ~07046467 -6c64"},
    {U'\u03bc', "-0c00 ~07046467 -6c64"},
    {U'\u00b1', "-0b6b -3e38 -0565"},
    {U'\u00b7', "-0909"},
    {U'\u00d7', "-0c66 -6c06"},
    {U'\u00b2', "~0f0h4h4e0b -0b4b"},
    {U'\u00b3', "~0g0h4h4e2e ~2e4e4b0b0c"},
    {U'\u2013', "-0969"},
    {U'\u2192', "-09a9 -7ca976"},
    {U'\u2264', "-6e0b68 -0565"},
    {U'\u2265', "-0e6b08 -0565"},
    {U'\ufffd', "-0g6g64040g"},
};

using Points = std::vector<Eigen::Vector2d>;

int digit(char c) {
  return c <= '9' ? c - '0' : c - 'a' + 10;
}

Points parse_points(std::string_view pairs) {
  Points points;
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2)
    points.emplace_back(digit(pairs[i]), digit(pairs[i + 1]) - 4);
  return points;
}

/// Quadratic B-spline: each inner control point bends the way between the midpoints beside it.
Points smoothed(const Points& control, bool closed) {
  constexpr int parts = 8;
  const int n = static_cast<int>(control.size());
  const auto at = [&](int i) { return control[static_cast<std::size_t>((i + n) % n)]; };
  Points curve;
  const int first = closed ? 0 : 1, last = closed ? n : n - 1;
  for (int i = first; i < last; ++i) {
    const bool from_end = !closed && i == 1, to_end = !closed && i == n - 2;
    const Eigen::Vector2d a = from_end ? at(0) : Eigen::Vector2d(0.5 * (at(i - 1) + at(i)));
    const Eigen::Vector2d b = to_end ? at(n - 1) : Eigen::Vector2d(0.5 * (at(i) + at(i + 1)));
    for (int k = 0; k <= parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      curve.push_back((1 - t) * (1 - t) * a + 2 * t * (1 - t) * at(i) + t * t * b);
    }
  }
  return curve;
}

Glyph parse_glyph(std::string_view text) {
  Glyph result;
  while (!text.empty()) {
    const std::size_t end = text.find(' ');
    const std::string_view stroke = text.substr(0, end);
    const Points points = parse_points(stroke.substr(1));
    result.strokes.push_back(stroke[0] == '-' ? points : smoothed(points, stroke[0] == 'o'));
    for (const auto& p : points) result.width = std::max(result.width, p.x());
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
  return result;
}

std::map<char32_t, Glyph> make_glyphs() {
  std::map<char32_t, Glyph> glyphs;
  for (const Drawn& one : drawn) glyphs[one.character] = parse_glyph(one.strokes);
  glyphs[' '].width = font::space;
  return glyphs;
}

}  // namespace

const Glyph& glyph(char32_t character) {
  static const std::map<char32_t, Glyph> glyphs = make_glyphs();
  const auto found = glyphs.find(character);
  return found != glyphs.end() ? found->second : glyphs.at(U'\ufffd');
}

std::vector<char32_t> decode_utf8(std::string_view text) {
  std::vector<char32_t> characters;
  std::size_t i = 0;
  while (i < text.size()) {
    const auto lead = static_cast<unsigned char>(text[i++]);
    const int more = lead < 0x80       ? 0
                     : lead >> 5 == 6  ? 1
                     : lead >> 4 == 14 ? 2
                     : lead >> 3 == 30 ? 3
                                       : -1;
    char32_t value = more == 0 ? lead : lead & (0x3fu >> (more < 0 ? 0 : more));
    int left = more;
    while (left > 0 && i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80) {
      value = (value << 6) | (static_cast<unsigned char>(text[i++]) & 0x3fu);
      --left;
    }
    characters.push_back(left == 0 ? value : U'\ufffd');
  }
  return characters;
}

}  // namespace pedicel::render
