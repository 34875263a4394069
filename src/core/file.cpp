#include "core/file.hpp"

#include "core/input_error.hpp"

#include <array>
#include <fmt/format.h>
#include <fstream>
#include <openssl/evp.h>
#include <system_error>
#include <unistd.h>

namespace damslip {

namespace fs = std::filesystem;

std::string read_file(const fs::path& path, std::uintmax_t max_bytes)
{
    const auto fail = [&](std::string problem, std::string fix) {
        throw InputError(Diagnostic{path.string(), 0, 0, std::move(problem), "a readable file", std::move(fix)});
    };
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status))
        fail("there is no such file.", "check the name; relative names start from the file that mentions them");
    if (fs::is_directory(status)) fail("this is a folder, not a file.", "name a file inside it");
    std::ifstream in(path, std::ios::binary);
    if (!in) fail("the file cannot be opened.", "check its read permission");
    std::string content;
    std::array<char, 1 << 16> block;
    while (in.read(block.data(), block.size()) || in.gcount() > 0) {
        content.append(block.data(), static_cast<std::size_t>(in.gcount()));
        if (content.size() > max_bytes)
            fail(fmt::format("the file is larger than {} MB.", max_bytes >> 20),
                 "this is not one of the formats read here; cut it down");
    }
    return content;
}

void write_file(const fs::path& path, std::string_view content)
{
    const auto fail = [&](const std::string& why) {
        throw InputError(Diagnostic{path.string(), 0, 0, "cannot be written: " + why,
                                    "a folder with write permission and space left", "choose another output folder"});
    };
    std::error_code error;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
    if (error) fail(error.message());
    fs::path part = path;
    part += fmt::format(".{}.part", ::getpid());
    {
        std::ofstream out(part, std::ios::binary);
        out.write(content.data(), static_cast<std::streamsize>(content.size()));
        out.flush();
        if (!out) {
            fs::remove(part, error);
            fail("the write failed");
        }
    }
    fs::rename(part, path, error);
    if (error) fail(error.message());
}

std::string sha256(std::string_view bytes)
{
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int length = 0;
    EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr);
    std::string hex;
    for (unsigned int i = 0; i < length; ++i) hex += fmt::format("{:02x}", digest[i]);
    return hex;
}

} // namespace damslip
