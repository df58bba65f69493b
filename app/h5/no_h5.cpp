// In place of h5_log.cpp where HDF5 is not there.
#include "app/h5/h5_log.h"
#include "engine/core/check.h"

namespace pedicel::app {

MakeWatcher h5_log(const std::filesystem::path& file) {
  throw UsageError("--log " + file.string() +
                   ": this program was built without HDF5, expected one built with libhdf5-dev "
                   "installed, or a name that ends in .mcap");
}

}  // namespace pedicel::app
