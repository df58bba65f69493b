#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "engine/core/frames.h"
#include "engine/io/bounds.h"

namespace pedicel::plant {

/// What a slider of a number spans; both 0: it has none.
struct Slider {
  double low = 0.0, high = 0.0;
  bool logarithmic = false;
};

/// A member that is one of a few words, by their indices. The first word is meant where the key is
/// left out.
template <typename Owner>
struct WordMember {
  std::span<const std::string_view> words;
  int (*get)(const Owner&) = nullptr;
  void (*set)(Owner&, int) = nullptr;
  bool always_written = false;  ///< also where it is the first word
};

/// One key of a plant file, described once beside the struct that holds its value. The reader, the
/// writer, the edits, the commands, the window's fields and the manual's rows walk lists of these.
template <typename Owner>
struct PlantKey {
  std::string_view name;                 ///< as files say it
  std::string_view unit = "1";           ///< "1": it has none
  io::Bounds bounds = io::any_number;    ///< of a number
  std::string_view sentence = {};        ///< what it is or does
  std::string_view label = {};           ///< of its field in the window
  std::string_view tip = {};             ///< short, for the window and the help of commands
  Slider slider = {};                    ///< of a number of the whole plant
  std::optional<double> otherwise = {};  ///< what a number is that is left out; none: it is needed
  std::optional<double> usual = {};      ///< what a command gives it that does not say it
  bool (*stands)(const Owner&) = nullptr;  ///< whether its owner has it; null: each has
  /// A number that is needed or has `otherwise`; one that may be absent; a direction, likewise, P;
  /// a text; one of a few words.
  std::variant<double Owner::*, std::optional<double> Owner::*, Vec3 Owner::*,
               std::optional<Vec3> Owner::*, std::string Owner::*, WordMember<Owner>>
      member = {};

  bool is_number() const { return member.index() < 2; }
};

/// The number of a key; nothing where its owner lacks it, or it is no number.
template <typename Owner>
std::optional<double> number_of(const Owner& owner, const PlantKey<Owner>& key) {
  if (const auto* needed = std::get_if<double Owner::*>(&key.member)) return owner.*(*needed);
  if (const auto* absent = std::get_if<std::optional<double> Owner::*>(&key.member))
    return owner.*(*absent);
  return std::nullopt;
}

/// Sets the number of a key; nothing takes it away, where it may be absent.
template <typename Owner>
void set_number_of(Owner& owner, const PlantKey<Owner>& key, std::optional<double> value) {
  if (const auto* needed = std::get_if<double Owner::*>(&key.member); needed && value)
    owner.*(*needed) = *value;
  if (const auto* absent = std::get_if<std::optional<double> Owner::*>(&key.member))
    owner.*(*absent) = value;
}

/// The key of that name among `keys`; null where there is none.
template <typename Keys>
auto find_key(const Keys& keys, std::string_view name) -> decltype(std::data(keys)) {
  for (const auto& key : keys)
    if (key.name == name) return &key;
  return nullptr;
}

/// Names of keys that are numbers, for a sentence: "stretch, bend, force".
template <typename Keys>
std::string number_names(const Keys& keys, const std::string& between = ", ") {
  std::string names;
  for (const auto& key : keys)
    if (key.is_number()) names += (names.empty() ? "" : between) + std::string(key.name);
  return names;
}

template <auto Member>
struct MemberOf;
template <typename Owner_, typename Value_, Value_ Owner_::*Member>
struct MemberOf<Member> {
  using Owner = Owner_;
  using Value = Value_;
};

/// An enumeration whose values are numbered as `words` are.
template <auto Member>
constexpr auto one_of(std::span<const std::string_view> words, bool always_written = false) {
  using Owner = typename MemberOf<Member>::Owner;
  using Value = typename MemberOf<Member>::Value;
  static_assert(std::is_enum_v<Value>);
  return WordMember<Owner>{
      words, [](const Owner& owner) { return static_cast<int>(owner.*Member); },
      [](Owner& owner, int i) { owner.*Member = static_cast<Value>(i); }, always_written};
}

}  // namespace pedicel::plant
