#pragma once

#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/select/findings.h"

namespace pedicel::discrepancy {

/// Puts the ratios of modulus, density and damping time that the data see far more closely than
/// either of the two into the verdict: a swing sees modulus over density, and neither alone.
void report_ratios(const Findings& findings, Diagnosis& diagnosis);

}  // namespace pedicel::discrepancy
