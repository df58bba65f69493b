#include "tests/support/places.h"

namespace pedicel::test {

std::filesystem::path source_folder() {
  return PEDICEL_SOURCE_FOLDER;
}

std::filesystem::path shared_folder() {
  return PEDICEL_SOURCE_FOLDER "/../shared";
}

}  // namespace pedicel::test
