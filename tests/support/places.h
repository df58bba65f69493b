#pragma once

#include <filesystem>

/// Where the tree lies. A function, so that no test's object depends on it and clones share what is
/// compiled.
namespace pedicel::test {

/// The tree.
std::filesystem::path source_folder();
/// The folder of measured data beside it, which may be absent.
std::filesystem::path shared_folder();

}  // namespace pedicel::test
