#include "fe2d/solver/blas_threads.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <initializer_list>
#include <mutex>
#include <new>
#include <sys/resource.h>

namespace damslip::fe2d {

void use_one_blas_thread()
{
    using SetThreads = void (*)(int);
    for (const char* name : {"openblas_set_num_threads", "omp_set_num_threads"})
        if (const auto set = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, name))) set(1);
}

void demand_blas_memory()
{
    static std::mutex mutex;
    static bool taken = false; // OpenBLAS keeps what it has once taken
    const std::lock_guard lock(mutex);
    rlimit limit{};
    if (taken || ::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
    constexpr std::size_t buffer = 130u << 20; // with what it is aligned by
    void* const trial = std::malloc(buffer);
    if (!trial) throw std::bad_alloc();
    std::free(trial);
    using Factorise = void (*)(const char* triangle, const int* n, double* a, const int* rows, int* info);
    if (const auto factorise = reinterpret_cast<Factorise>(dlsym(RTLD_DEFAULT, "dpotrf_"))) {
        double one = 1.0;
        int n = 1, info = 0;
        factorise("L", &n, &one, &n, &info);
    }
    taken = true;
}

} // namespace damslip::fe2d
