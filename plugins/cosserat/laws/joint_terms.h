#pragma once

#include <string_view>

/// Terms of joint laws: what a joint adds to its linear spring, without a memory. Each has its
/// formula in NAME-inl.h beside this file, and its effect in plugins/effects/NAME.cpp. A new one
/// gets a row here and a line in joint_terms-inl.h.
namespace pedicel::laws {

/// Where the numbers of a term begin among those of a joint, and its bit in a set of terms. A
/// term's first number is its size: where it is 0, the term adds nothing.
struct JointTerm {
  std::string_view effect;
  int numbers;
  int first;
  unsigned bit;
};

inline constexpr JointTerm joint_terms[] = {
    {"clamp_play", 1, 0, 1u},
    {"material_nonlinearity", 1, 1, 2u},
    {"asymmetry", 4, 2, 4u},
};

/// Numbers that all terms of a joint have together.
inline constexpr int joint_term_numbers = [] {
  int sum = 0;
  for (const JointTerm& one : joint_terms) sum += one.numbers;
  return sum;
}();

/// The term of an effect; null: it is none.
constexpr const JointTerm* find_joint_term(std::string_view effect) {
  for (const JointTerm& one : joint_terms)
    if (one.effect == effect) return &one;
  return nullptr;
}

/// Index of an effect's first number; -1: it is no term.
constexpr int first_number(std::string_view effect) {
  const JointTerm* const found = find_joint_term(effect);
  return found ? found->first : -1;
}

}  // namespace pedicel::laws
