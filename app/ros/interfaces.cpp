#include "app/ros/interfaces.h"

#include <arpa/inet.h>
#include <ifaddrs.h>

#include "engine/core/check.h"
#include "engine/core/diagnostics.h"

namespace pedicel::app {

std::string address_of_interface(const std::string& text) {
  ifaddrs* all = nullptr;
  std::string found, known;
  if (::getifaddrs(&all) != 0) all = nullptr;
  for (const ifaddrs* one = all; one; one = one->ifa_next) {
    if (!one->ifa_addr || one->ifa_addr->sa_family != AF_INET) continue;
    char address[INET_ADDRSTRLEN] = "";
    const auto* own = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    ::inet_ntop(AF_INET, &own->sin_addr, address, sizeof address);
    if (found.empty() && (text == address || text == one->ifa_name)) found = address;
    known += std::string(address) + " (" + one->ifa_name + "), ";
  }
  if (all) ::freeifaddrs(all);
  if (found.empty())
    throw UsageError("--ros-interface " + in_quotes(text) +
                     ": no interface of this machine, expected " + known + "or any");
  return found;
}

}  // namespace pedicel::app
