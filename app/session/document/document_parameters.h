#pragma once

#include <string>
#include <vector>

#include "app/session/document/document.h"

namespace pedicel::app {

/// A described number of the document that may be changed while it runs.
struct SessionParameter {
  std::string key;    ///< as in `set`: "rods.newton_iterations", "plants.tomato.material.density"
  std::string group;  ///< "rods", "coupling", "tomato"
  std::string unit, sentence;
  double value = 0.0, initial = 0.0;  ///< now; as the files say
  double minimum = 0.0, maximum = 0.0;
  bool flag = false;         ///< 0 or 1
  bool whole = false;        ///< only whole numbers
  bool logarithmic = false;  ///< spans orders of magnitude
  bool restarts = false;     ///< a change starts the run anew
  bool changed = false;      ///< over what the files say
};

/// Every described number of a document, with what it is in `files`, the same document without the
/// settings that were made since.
std::vector<SessionParameter> document_parameters(const Document& document, const Document& files);

}  // namespace pedicel::app
