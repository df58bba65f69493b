#include "plugins/discrepancy/data/experiment.h"

#include "plugins/discrepancy/files/experiment_files.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

namespace {

/// An input holds the files of a folder: "=== NAME" begins one; what stands before the first is the
/// experiment.yaml.
void write_files(const fuzz::Folder& folder, const std::string& text) {
  std::string name = "experiment.yaml";
  std::size_t start = 0;
  while (start <= text.size()) {
    const std::size_t mark = text.find("\n=== ", start);
    const std::size_t end = mark == std::string::npos ? text.size() : mark + 1;
    folder.write(name, text.substr(start, end - start));
    if (mark == std::string::npos) return;
    const std::size_t line_end = std::min(text.find('\n', mark + 5), text.size());
    name = text.substr(mark + 5, line_end - mark - 5);
    // Only the names that the seeds use: no other place is written to.
    if (name != "plant.yaml" && name != "markers.csv" && name != "hold.csv" &&
        name != "force.csv" && name != "events.csv")
      name = "other";
    start = line_end + 1;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  for (const char* name :
       {"experiment.yaml", "plant.yaml", "markers.csv", "hold.csv", "force.csv", "events.csv"})
    std::filesystem::remove(folder.path() / name);
  write_files(folder, fuzz::text_of(data, size));
  Diagnostics diagnostics;
  fuzz::require_answer(discrepancy::read_experiment(folder.path(), diagnostics), diagnostics);
  return 0;
}
