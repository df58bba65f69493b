#pragma once

#include <string>

namespace pedicel::app {

std::string version();   ///< "0.2.0"
std::string git_hash();  ///< of the sources that were built; "unknown" outside a checkout
std::string machine();   ///< "2 x Intel(R) Xeon(R) ..., Linux 6.1"

}  // namespace pedicel::app
