#pragma once

namespace pedicel::app {

/// Resident memory of this process now, bytes, without what it maps from files: its code.
double resident_bytes();

/// The most that it ever was, MiB.
double peak_megabytes();

}  // namespace pedicel::app
