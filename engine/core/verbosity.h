#pragma once

namespace pedicel {

/// How much a run says on standard error, `-v N`: 0 nothing, 1 errors, 2 warnings too, 3 the start
/// and end lines and progress too, 4 every picture, break and file too. `--quiet` is 2.
enum class Verbosity { nothing, errors, warnings, lines, everything };

/// Of this program; `lines` until it is set.
Verbosity verbosity();
void set_verbosity(Verbosity level);

/// A line on standard error, where the program says as much.
void say(Verbosity level, const char* format, ...) __attribute__((format(printf, 2, 3)));

}  // namespace pedicel
