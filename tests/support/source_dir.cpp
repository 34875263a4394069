#include "source_dir.hpp"

const char* source_dir()
{
    return DAMSLIP_SOURCE_DIR;
}
