#pragma once

namespace damslip::fe2d {

/// Sets OpenBLAS and OpenMP to one thread (no-op with another BLAS): results then do not depend on the number of cores,
/// and runs do not compete with each other. Reading OPENBLAS_NUM_THREADS happens at load time, so the environment is
/// too late for a running program.
void use_one_blas_thread();

/// OpenBLAS takes 128 MB at its first product, keeps them, and asks for them again and again, for ever, where they cannot be
/// had. To be called before: where the address space is limited (ulimit -v) it asks once, and has OpenBLAS take them.
/// @throws std::bad_alloc
void demand_blas_memory();

} // namespace damslip::fe2d
