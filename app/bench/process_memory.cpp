#include "app/bench/process_memory.h"

#include <unistd.h>

#include <fstream>
#include <string>

namespace pedicel::app {

double resident_bytes() {
  long total = 0, resident = 0, of_files = 0;  // pages
  std::ifstream("/proc/self/statm") >> total >> resident >> of_files;
  return static_cast<double>(resident - of_files) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double peak_megabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024.0;
  return 0.0;
}

}  // namespace pedicel::app
