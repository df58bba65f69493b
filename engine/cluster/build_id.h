#pragma once

#include <filesystem>
#include <string>

namespace pedicel::cluster {

/// The linker's number of this very program, hexadecimal: another one after every change of its
/// code, also one that no version number tells. Empty where the linker gave none.
std::string build_id();

/// The file of this program.
std::filesystem::path program_file();

/// "fma" or "baseline": which of their versions the C library's functions (sin, exp) take on this
/// processor, whatever instruction set the rods are solved with. They differ in last bits.
std::string math_level();

std::string host_name();

}  // namespace pedicel::cluster
