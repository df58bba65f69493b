#include "app/steer/act.h"

#include <cstdlib>
#include <cstring>
#include <sstream>

#include "engine/core/check.h"

namespace pedicel::app {

bool Act::operator==(const Act& other) const {
  // Numbers bit by bit: one that is not a number is equal to itself here.
  return step == other.step && kind == other.kind && name == other.name &&
         numbers.size() == other.numbers.size() &&
         (numbers.empty() ||
          std::memcmp(numbers.data(), other.numbers.data(), numbers.size() * sizeof(double)) == 0);
}

std::string to_text(const Act& act) {
  std::ostringstream text;
  text << act.step << ' ' << static_cast<int>(act.kind) << ' ' << act.numbers.size();
  text << std::hexfloat;
  for (const double number : act.numbers) text << ' ' << number;
  text << ' ' << act.name;
  return text.str();
}

Act act_of_text(const std::string& line) {
  const UsageError fault("a saved run is damaged: expected step, kind, numbers and a name");
  const char* at = line.c_str();
  const auto whole = [&] {
    char* end = nullptr;
    const long value = std::strtol(at, &end, 10);
    if (end == at || value < 0) throw fault;
    at = end;
    return value;
  };
  Act act;
  act.step = whole();
  const long kind = whole(), count = whole();
  if (kind >= Act::kinds || count > 100000) throw fault;
  act.kind = static_cast<Act::Kind>(kind);
  for (long i = 0; i < count; ++i) {
    char* end = nullptr;
    act.numbers.push_back(std::strtod(at, &end));
    if (end == at) throw fault;
    at = end;
  }
  if (*at != ' ') throw fault;
  act.name = at + 1;
  return act;
}

}  // namespace pedicel::app
