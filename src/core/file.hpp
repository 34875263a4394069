#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace damslip {

/// The whole file as bytes. @throws InputError when it is missing, a folder, unreadable or larger than `max_bytes`.
std::string read_file(const std::filesystem::path& path, std::uintmax_t max_bytes = 256u << 20);

/// Writes beside the target and renames: the file appears whole or not at all. Makes missing parent folders.
/// @throws InputError when the folder cannot be written.
void write_file(const std::filesystem::path& path, std::string_view content);

/// SHA-256 of the bytes, 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

} // namespace damslip
