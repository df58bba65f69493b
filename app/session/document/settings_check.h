#pragma once

#include "app/session/document/document.h"

namespace pedicel::app {

/// Tries the document's settings on the scene, the solver's and the contacts' parameters, and the
/// plants. Throws UsageError with every fault.
void check_settings(const Document& document);

}  // namespace pedicel::app
