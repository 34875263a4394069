#pragma once

#include <filesystem>

namespace damslip {

/// Folder of what is dear to make and the same in all runs, reduced rock say; empty: nothing is kept. It changes times, no
/// results. Empty until use_cache_folder() has been called: the program calls it, other programs may.
std::filesystem::path cache_folder();

/// Of this process, before its runs begin.
void use_cache_folder(std::filesystem::path folder);

/// $XDG_CACHE_HOME/damslip, else ~/.cache/damslip; empty when neither is an absolute path.
std::filesystem::path user_cache_folder();

} // namespace damslip
