#include "fe2d/solver/blas_threads.hpp"

#include <dlfcn.h>

#include <initializer_list>
#include <new>
#include <sys/mman.h>
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
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
    constexpr std::size_t buffer = 129u << 20; // with what it is aligned by
    void* const trial = ::mmap(nullptr, buffer, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (trial == MAP_FAILED) throw std::bad_alloc();
    ::munmap(trial, buffer);
}

} // namespace damslip::fe2d
