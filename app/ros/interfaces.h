#pragma once

#include <string>

namespace pedicel::app {

/// The IPv4 address of a network interface of this machine, from its name ("eth0") or its address.
/// Throws UsageError, with what there is, where it has none.
std::string address_of_interface(const std::string& text);

}  // namespace pedicel::app
