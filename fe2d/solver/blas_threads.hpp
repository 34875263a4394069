#pragma once

namespace damslip::fe2d {

/// Sets OpenBLAS and OpenMP to one thread (no-op with another BLAS): results then do not depend on the number of cores,
/// and runs do not compete with each other. Reading OPENBLAS_NUM_THREADS happens at load time, so the environment is
/// too late for a running program.
void use_one_blas_thread();

} // namespace damslip::fe2d
