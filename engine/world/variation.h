#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/diagnostics.h"

namespace pedicel::io {
class YamlNode;
}

namespace pedicel::world {

/// How one key of `--set` is drawn.
struct VariedNumber {
  enum class Distribution { uniform, normal, lognormal, choice };
  std::string key;
  Distribution distribution = Distribution::uniform;
  double low = 0.0, high = 0.0;        ///< uniform: within them; else drawn anew beyond them
  double mean = 0.0, deviation = 0.0;  ///< of the number itself, also where it is lognormal
  std::vector<std::string> values;     ///< of a choice
  SourcePosition where;
  /// A value was set by hand since, so that it does not vary: it is drawn, and not taken.
  bool held = false;
};

/// Of a map `vary`. Faults go to the node's diagnostics.
std::vector<VariedNumber> read_vary(const io::YamlNode& node);
/// Keys and values, drawn in the order of the keys: the same for the same seed, everywhere.
std::vector<std::pair<std::string, std::string>> draw(const std::vector<VariedNumber>& numbers,
                                                      std::uint64_t seed);

/// A map `vary: {KEY: {distribution: ..., ...}}`: numbers of a scene that differ from run to run.
class Variation {
 public:
  /// From a file with `format: pedicel-variation`, or a text of its map. Throws InvalidFile with
  /// every fault.
  static Variation read(const std::filesystem::path& path);
  static Variation parse(const std::string& text, const std::string& name);

  std::vector<std::pair<std::string, std::string>> draw(std::uint64_t seed) const {
    return world::draw(numbers_, seed);
  }
  const std::vector<VariedNumber>& numbers() const { return numbers_; }

 private:
  std::vector<VariedNumber> numbers_;
};

}  // namespace pedicel::world
