#include "core/version.hpp"

#include <cstdlib>
#include <string_view>

namespace damslip {

std::string program_version()
{
    return DAMSLIP_VERSION;
}

std::string program_verification()
{
    return DAMSLIP_VERIFICATION;
}

namespace {

VectorLevel find_vector_level()
{
#if DAMSLIP_HAS_AVX2
    const char* wanted = std::getenv("DAMSLIP_VECTOR_LEVEL");
    if (wanted && std::string_view(wanted) == "sse2") return VectorLevel::sse2;
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2")) return VectorLevel::avx2;
#endif
    return VectorLevel::sse2;
}

} // namespace

VectorLevel vector_level()
{
    static const VectorLevel level = find_vector_level();
    return level;
}

} // namespace damslip
