#include "plugins/discrepancy/select/symptom_numbers.h"

namespace pedicel::discrepancy {

std::vector<SymptomNumber> symptom_numbers(const std::vector<Symptom>& symptoms) {
  std::vector<SymptomNumber> numbers;
  for (const SymptomPair& pair : paired(symptoms, {})) {
    const Symptom& one = pair.before;
    numbers.push_back({one.name, one.subject, one.value, one.standard_error, one.unit, one.shows(),
                       one.speaks_for, one.sentence});
  }
  return numbers;
}

std::vector<std::string> names_that_show(const std::vector<SymptomNumber>& symptoms) {
  std::vector<std::string> names;
  for (const SymptomNumber& one : symptoms)
    if (one.shows) names.push_back(one.name);
  return names;
}

std::string symptoms_text(const Verdict& verdict, std::size_t most) {
  std::string text;
  std::size_t told = 0;
  for (const SymptomNumber& one : verdict.symptoms) {
    if (!one.shows || told == most) break;
    std::string causes;
    for (const std::string& cause : one.speaks_for) causes += (causes.empty() ? "" : ", ") + cause;
    text += "Seen: " + one.sentence + (causes.empty() ? "" : " Speaks for " + causes + ".") + "\n";
    ++told;
  }
  return text;
}

}  // namespace pedicel::discrepancy
