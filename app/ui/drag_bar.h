#pragma once

namespace pedicel::app {

struct Ui;

struct BarRange {
  double low = 0.0, high = 1.0;  ///< ends of the bar
  bool logarithmic = false;      ///< px are decades, not shares
  bool whole = false;            ///< only whole numbers
};

/// A bar that a drag changes from the value it has: a press alone changes nothing, the bar's whole
/// length is the whole range, and a logarithmic one takes at least 160 px a decade (2 px change it
/// by less than 4 %). Shift makes it ten times finer. Ctrl+click or a double click types a value,
/// which may lie beyond the ends. True when the value was changed.
bool drag_bar(const Ui& ui, const char* id, double& value, const BarRange& range);

/// The value that a drag of `px` makes of `start`, on a bar of `width` px at that scale (px a
/// point).
double dragged_value(double start, double px, double width, double scale, const BarRange& range);

}  // namespace pedicel::app
