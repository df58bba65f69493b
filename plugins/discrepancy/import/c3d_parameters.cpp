#include "plugins/discrepancy/import/c3d_parameters.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace pedicel::discrepancy {

namespace {

constexpr std::size_t most_records = 4096;

std::string capitals(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return out;
}

}  // namespace

C3dParameters::C3dParameters(const C3dBytes& bytes, std::size_t at, const std::string& file,
                             Diagnostics& diagnostics)
    : bytes_(bytes) {
  // Four bytes come before the first record. A record without a name ends the list.
  std::size_t records = 0;
  for (at += 4; at != 0 && bytes_.byte(at) != 0 && ++records <= most_records;) {
    const std::size_t next = read_record(at);
    if (next != 0 && next <= at) {
      diagnostics.error({file}, "the parameter at byte " + std::to_string(at) +
                                    " is broken, expected a name, a place of the next one, a type "
                                    "and its values within the file");
      return;
    }
    at = next;
  }
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    for (const Group& group : groups_)
      if (group.id == group_of_[i]) parameters_[i].group = group.name;
}

// The next record's place; 0 behind the last one, and 1 where this one is broken.
std::size_t C3dParameters::read_record(std::size_t at) {
  constexpr std::size_t broken = 1;
  const auto letters = static_cast<std::size_t>(std::abs(int{bytes_.signed_byte(at)}));
  const int id = bytes_.signed_byte(at + 1);
  const std::size_t link = at + 2 + letters;
  if (id == 0 || !bytes_.has(link, 3)) return broken;
  const std::string name = capitals(bytes_.text(at + 2, letters));
  const std::size_t step = bytes_.word(link);
  if (id < 0) {
    groups_.push_back({-id, name});
  } else {
    C3dParameter parameter;
    parameter.name = name;
    if (!read_parameter(link + 2, parameter)) return broken;
    parameters_.push_back(std::move(parameter));
    group_of_.push_back(id);
  }
  return step == 0 ? 0 : link + step;
}

bool C3dParameters::read_parameter(std::size_t at, C3dParameter& parameter) {
  parameter.type = bytes_.signed_byte(at);
  const std::size_t width = static_cast<std::size_t>(std::abs(parameter.type));
  const std::size_t dimensions = bytes_.byte(at + 1);
  constexpr std::size_t most_dimensions = 7;
  if ((width != 1 && width != 2 && width != 4) || dimensions > most_dimensions) return false;
  for (std::size_t d = 0; d < dimensions; ++d) {
    parameter.dimensions.push_back(bytes_.byte(at + 2 + d));
    parameter.count *= parameter.dimensions.back();
    if (parameter.count > bytes_.size()) return false;
  }
  parameter.at = at + 2 + dimensions;
  return bytes_.has(parameter.at, parameter.count * width);
}

const C3dParameter* C3dParameters::find(const std::string& group, const std::string& name) const {
  const auto found = std::ranges::find_if(
      parameters_, [&](const C3dParameter& p) { return p.group == group && p.name == name; });
  return found == parameters_.end() ? nullptr : &*found;
}

std::optional<double> C3dParameters::number(const std::string& group, const std::string& name,
                                            std::size_t index) const {
  const C3dParameter* p = find(group, name);
  if (p == nullptr || index >= p->count) return std::nullopt;
  if (p->type == 4) return bytes_.real(p->at + 4 * index);
  if (p->type == 2) return bytes_.signed_word(p->at + 2 * index);
  if (p->type == 1) return bytes_.byte(p->at + index);
  return std::nullopt;
}

std::optional<std::size_t> C3dParameters::whole(const std::string& group, const std::string& name,
                                                std::size_t index) const {
  constexpr double most = 1.0e9;
  const C3dParameter* p = find(group, name);
  if (p != nullptr && p->type == 2 && index < p->count) return bytes_.word(p->at + 2 * index);
  const std::optional<double> value = number(group, name, index);
  if (!value || !(*value >= 0.0 && *value <= most)) return std::nullopt;
  return static_cast<std::size_t>(std::lround(*value));
}

std::vector<std::string> C3dParameters::texts(const std::string& group,
                                              const std::string& name) const {
  const C3dParameter* p = find(group, name);
  if (p == nullptr || p->type != -1 || p->count == 0) return {};
  const std::size_t length = p->dimensions.empty() ? 1 : p->dimensions.front();
  std::vector<std::string> found;
  for (std::size_t at = 0; at + length <= p->count; at += length) {
    std::string_view text = bytes_.text(p->at + at, length);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\0')) text.remove_suffix(1);
    found.emplace_back(text);
  }
  return found;
}

}  // namespace pedicel::discrepancy
