#include "fe2d/solver/blas_threads.hpp"

#include <dlfcn.h>

#include <initializer_list>

namespace damslip::fe2d {

void use_one_blas_thread()
{
    using SetThreads = void (*)(int);
    for (const char* name : {"openblas_set_num_threads", "omp_set_num_threads"})
        if (const auto set = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, name))) set(1);
}

} // namespace damslip::fe2d
