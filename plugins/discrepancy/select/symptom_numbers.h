#pragma once

#include "plugins/discrepancy/select/verdict.h"
#include "plugins/discrepancy/test/symptoms.h"

namespace pedicel::discrepancy {

/// Of each kind the clearest one, those that show first, the clearest before the others.
std::vector<SymptomNumber> symptom_numbers(const std::vector<Symptom>& symptoms);

/// Names of those that show.
std::vector<std::string> names_that_show(const std::vector<SymptomNumber>& symptoms);

/// "Seen: ..." with the sentences of the first `most` that show; empty where none does.
std::string symptoms_text(const Verdict& verdict, std::size_t most);

}  // namespace pedicel::discrepancy
