#pragma once

#include <string>

namespace pedicel::app {

/// Keys by what stands on them; the numbers are GLFW's, so that a window hands them on as they are.
enum class Key : int {
  none = 0,
  space = 32,
  comma = 44,
  minus = 45,
  period = 46,
  slash = 47,
  digit_0 = 48,
  equal = 61,
  a = 65,
  b = 66,
  c = 67,
  d = 68,
  f = 70,
  g = 71,
  j = 74,
  k = 75,
  l = 76,
  n = 78,
  o = 79,
  p = 80,
  q = 81,
  r = 82,
  s = 83,
  v = 86,
  w = 87,
  x = 88,
  y = 89,
  z = 90,
  left_bracket = 91,
  right_bracket = 93,
  escape = 256,
  enter = 257,
  tab = 258,
  backspace = 259,
  insert = 260,
  del = 261,
  right = 262,
  left = 263,
  down = 264,
  up = 265,
  page_up = 266,
  page_down = 267,
  home = 268,
  end = 269,
  f1 = 290,
  f2 = 291,
  f3 = 292,
  f4 = 293,
  f11 = 300,
  f12 = 301,
  pad_subtract = 333,
  pad_add = 334,
  pad_enter = 335,
  left_shift = 340,
  left_control = 341,
  left_alt = 342,
  left_super = 343,
  right_shift = 344,
  right_control = 345,
  right_alt = 346,
  right_super = 347,
};
inline constexpr int key_count = 512;

/// One thing that a person did to the window.
struct InputEvent {
  enum class Kind { move, button, wheel, key, text, drop, leave };
  Kind kind = Kind::move;
  double x = 0.0, y = 0.0;  ///< move: px from the upper left corner; wheel: steps
  int button = 0;           ///< button: 0 left, 1 right, 2 middle
  Key key = Key::none;      ///< key
  bool down = false;        ///< button, key
  std::string text;         ///< text: UTF-8; drop: a file's path

  static InputEvent move(double x, double y) { return {Kind::move, x, y, 0, Key::none, false, {}}; }
  static InputEvent press(int button, bool down) {
    return {Kind::button, 0.0, 0.0, button, Key::none, down, {}};
  }
  static InputEvent wheel(double steps) {
    return {Kind::wheel, 0.0, steps, 0, Key::none, false, {}};
  }
  static InputEvent press(Key key, bool down) { return {Kind::key, 0.0, 0.0, 0, key, down, {}}; }
  static InputEvent typed(std::string text) {
    return {Kind::text, 0.0, 0.0, 0, Key::none, false, std::move(text)};
  }
  static InputEvent drop(std::string path) {
    return {Kind::drop, 0.0, 0.0, 0, Key::none, false, std::move(path)};
  }
};

}  // namespace pedicel::app
