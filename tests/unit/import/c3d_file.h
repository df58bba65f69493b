#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/frames.h"
#include "plugins/discrepancy/import/c3d_bytes.h"

namespace pedicel::discrepancy::testing {

/// Writes C3D files as the specification describes them: whole blocks of 512 bytes.
class C3dFile {
 public:
  C3dProcessor processor = C3dProcessor::intel;
  bool reals = true;
  double scale = 0.5;  ///< of integers
  double rate = 100.0;
  std::string unit = "mm", up;
  std::vector<std::string> labels = {"root", "tip"};
  /// Frame by frame, point by point.
  std::vector<std::vector<Vec3>> frames = {{Vec3(1.5, -2, 3), Vec3(4, 5, 6)},
                                           {Vec3(NAN, NAN, NAN), Vec3(7, 8.5, -9)}};
  int analog = 0;                                               ///< samples a frame
  std::vector<std::pair<std::string, std::vector<int>>> trial;  ///< words of TRIAL

  std::string bytes() const {
    const std::string parameters = parameter_section();
    const int first_block = 2 + static_cast<int>(parameters.size() / 512);
    std::string head;
    head += '\x02';
    head += '\x50';
    head += word(static_cast<int>(labels.size())) + word(analog) + word(1) +
            word(static_cast<int>(frames.size())) + word(10) + real(reals ? -scale : scale) +
            word(first_block) + word(analog > 0 ? 1 : 0) + real(rate);
    head.resize(512, '\0');
    return head + parameters + data();
  }

 private:
  std::string word(int value) const {
    const char low = static_cast<char>(value & 0xFF), high = static_cast<char>(value >> 8 & 0xFF);
    return processor == C3dProcessor::mips ? std::string{high, low} : std::string{low, high};
  }

  std::string real(double value) const {
    // DEC: four times as large as IEEE's number of the same bits, halves exchanged.
    const double stored = processor == C3dProcessor::dec ? 4.0 * value : value;
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(stored));
    const int high = static_cast<int>(bits >> 16), low = static_cast<int>(bits & 0xFFFF);
    return processor == C3dProcessor::intel ? word(low) + word(high) : word(high) + word(low);
  }

  std::string record(int id, const std::string& name, const std::string& rest) const {
    std::string text{static_cast<char>(name.size()), static_cast<char>(id)};
    return text + name + word(static_cast<int>(rest.size()) + 2) + rest;
  }
  std::string group(int id, const std::string& name) const {
    return record(-id, name, std::string(1, '\0'));
  }
  std::string texts(int id, const std::string& name, const std::vector<std::string>& values) const {
    std::size_t length = 1;
    for (const std::string& value : values) length = std::max(length, value.size());
    std::string rest{'\xFF', '\x02', static_cast<char>(length), static_cast<char>(values.size())};
    for (std::string value : values) {
      value.resize(length, ' ');
      rest += value;
    }
    return record(id, name, rest + std::string(1, '\0'));
  }
  std::string number(int id, const std::string& name, double value) const {
    return record(id, name, std::string{'\x04', '\0'} + real(value) + std::string(1, '\0'));
  }
  std::string words(int id, const std::string& name, const std::vector<int>& values) const {
    std::string rest{'\x02', '\x01', static_cast<char>(values.size())};
    for (const int value : values) rest += word(value);
    return record(id, name, rest + std::string(1, '\0'));
  }

  std::string parameter_section() const {
    std::string text{'\x01', '\x50', '\x02', static_cast<char>(processor)};
    text += group(1, "POINT") + texts(1, "LABELS", labels) + number(1, "RATE", rate) +
            number(1, "SCALE", reals ? -scale : scale);
    if (!unit.empty()) text += texts(1, "UNITS", {unit});
    if (!up.empty()) text += texts(1, "Y_SCREEN", {up});
    if (!trial.empty()) text += group(2, "TRIAL");
    for (const auto& [name, values] : trial) text += words(2, name, values);
    text.resize((text.size() / 512 + 1) * 512, '\0');
    return text;
  }

  std::string data() const {
    std::string text;
    for (const auto& frame : frames) {
      for (const Vec3& x : frame) {
        const bool seen = x.allFinite();
        for (const double value : x)
          text += reals ? real(seen ? value : 0.0)
                        : word(seen ? static_cast<int>(std::lround(value / scale)) : 0);
        text += reals ? real(seen ? 1.0 : -1.0) : word(seen ? 0x0101 : -1);
      }
      for (int i = 0; i < analog; ++i) text += reals ? real(77.0) : word(77);
    }
    return text;
  }
};

}  // namespace pedicel::discrepancy::testing
