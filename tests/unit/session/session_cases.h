#pragma once

#include <gtest/gtest.h>

#include <string>

#include "app/session/session.h"
#include "tests/support/places.h"

/// A stem, a branch that hangs from its middle, a fruit at the branch's end.
namespace pedicel::app {

inline const char* const draw_lines[] = {
    "new plant p",
    "draw stem p stem 0,0,0;0,0,0.15;0,0,0.3 0.004",
    "draw stem p branch 0,0,0.15;0.05,0,0.16;0.1,0,0.15 0.0015",
    "add fruit p berry branch 1 0.01 force=2 bend=0.5",
};

inline void must(const Result& result) {
  EXPECT_TRUE(result.ok) << result.text;
}

inline void draw_plant(Session& session) {
  for (const char* line : draw_lines) must(session.run_text(line));
}

/// A session whose commands wait for the simulation.
inline SessionOptions waiting() {
  SessionOptions options;
  options.waits = true;
  return options;
}

inline std::filesystem::path source(const std::string& path) {
  return pedicel::test::source_folder() / path;
}

}  // namespace pedicel::app
