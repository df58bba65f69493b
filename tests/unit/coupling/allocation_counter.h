#pragma once

/// Allocations of this program so far (operator new is counted in allocation_counter.cpp).
long allocations();
