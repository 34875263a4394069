#include "core/cache_folder.hpp"

#include <cstdlib>

namespace damslip {

namespace {

std::filesystem::path& folder_in_use()
{
    static std::filesystem::path folder;
    return folder;
}

} // namespace

std::filesystem::path cache_folder()
{
    return folder_in_use();
}

void use_cache_folder(std::filesystem::path folder)
{
    folder_in_use() = std::move(folder);
}

std::filesystem::path user_cache_folder()
{
    namespace fs = std::filesystem;
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && fs::path(cache).is_absolute())
        return fs::path(cache) / "damslip";
    if (const char* home = std::getenv("HOME"); home && fs::path(home).is_absolute())
        return fs::path(home) / ".cache" / "damslip";
    return {};
}

} // namespace damslip
