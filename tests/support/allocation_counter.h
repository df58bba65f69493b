#pragma once

/// Allocations of this program so far. allocation_counter.cpp, which a test program lists among its
/// sources, replaces the global operator new by one that counts.
long allocations();
