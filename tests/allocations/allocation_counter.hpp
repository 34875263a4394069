#pragma once

namespace damslip::test {

/// How often this thread has asked for memory: malloc, calloc, realloc and aligned_alloc, through which operator new and Eigen go.
/// Whoever links allocation_counter.cpp has them replaced.
long allocations();

} // namespace damslip::test
