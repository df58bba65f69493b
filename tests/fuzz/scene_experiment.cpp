#include <array>

#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/scene/scene_state.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

namespace {

constexpr std::array names = {"experiment.yaml",      "scene.yaml",
                              "plant.yaml",           "arm.urdf",
                              "push/joints.csv",      "push/commands.csv",
                              "push/torques.csv",     "push/markers.csv",
                              "push/pixels_left.csv", "push/wrench_wrist.csv",
                              "push/events.csv"};

/// An input holds the files of a folder: "=== NAME" begins one; what stands before the first is the
/// experiment.yaml. Only the names above are written: no other place is.
void write_files(const fuzz::Folder& folder, const std::string& text) {
  std::string name = "experiment.yaml";
  std::size_t start = 0;
  while (start <= text.size()) {
    const std::size_t mark = text.find("\n=== ", start);
    const std::size_t end = mark == std::string::npos ? text.size() : mark + 1;
    bool known = false;
    for (const char* one : names) known = known || name == one;
    if (known) folder.write(name, text.substr(start, end - start));
    if (mark == std::string::npos) return;
    const std::size_t line_end = std::min(text.find('\n', mark + 5), text.size());
    name = text.substr(mark + 5, line_end - mark - 5);
    start = line_end + 1;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  std::filesystem::create_directories(folder.path() / "push");
  for (const char* name : names) std::filesystem::remove(folder.path() / name);
  write_files(folder, fuzz::text_of(data, size));
  Diagnostics diagnostics;
  const auto experiment = discrepancy::read_experiment(folder.path(), diagnostics);
  fuzz::require_answer(experiment, diagnostics);
  if (!experiment) return 0;
  try {
    discrepancy::nominal_state(*experiment);
  } catch (const InvalidFile&) {
    // The scene's coupling may be faulty.
  }
  return 0;
}
