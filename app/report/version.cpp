#include "app/report/version.h"

#include <sys/utsname.h>

#include <fstream>
#include <thread>

namespace pedicel::app {

std::string version() {
  return PEDICEL_VERSION;
}

std::string git_hash() {
  return PEDICEL_GIT_HASH;
}

std::string machine() {
  std::string name = "unknown processor";
  std::ifstream cpu("/proc/cpuinfo");
  for (std::string line; std::getline(cpu, line);) {
    if (!line.starts_with("model name")) continue;
    name = line.substr(std::min(line.find(':') + 2, line.size()));
    break;
  }
  utsname system{};
  uname(&system);
  return std::to_string(std::thread::hardware_concurrency()) + " x " + name + ", " +
         system.sysname + " " + system.release;
}

}  // namespace pedicel::app
