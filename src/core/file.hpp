#pragma once

#include "core/input_error.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace damslip {

using LookAtStart = std::function<void(const std::string& first_bytes)>;

/// The whole file as bytes. @throws InputError when it is missing, a folder, unreadable or larger than `max_bytes`, which is seen
/// before it is read where the file has a size
/// @param look  at the first bytes (64 KiB, if there are as many) before the rest is read; throws for what is not to be read on
std::string read_file(const std::filesystem::path& path, std::uintmax_t max_bytes = 256u << 20,
                      const LookAtStart& look = {});

/// Reads a line without its end, as std::getline does; of one that is longer than `most` bytes what is beyond them is passed over.
/// @returns false: the stream is at its end
bool read_line(std::istream& in, std::string& line, std::size_t most = 1u << 20);

/// Something on the disk that is there for the time being, such as a file that is being written: a process that is asked to end waits until
/// it is gone. Deleting it is its owner's.
class Temporary {
public:
    Temporary();
    ~Temporary();
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    static bool any(); ///< may be asked in a signal handler
};

/// Writes beside the target and renames: the file appears whole or not at all. Makes missing parent folders. A link is
/// kept: what it leads to is written. A device or a pipe (FIFO) takes the bytes as they come and is never replaced.
/// @throws InputError when it cannot be written; for a folder or a socket
void write_file(const std::filesystem::path& path, std::string_view content);

/// The same for what is too large to be held: bytes go beside the target as they come, finish() renames. Without it
/// nothing appears.
class FileWriter {
public:
    explicit FileWriter(const std::filesystem::path& path);
    ~FileWriter();
    FileWriter(const FileWriter&) = delete;
    FileWriter& operator=(const FileWriter&) = delete;

    void write(std::string_view bytes); ///< @throws InputError as write_file()
    void finish();

private:
    Temporary kept_;
    std::filesystem::path named_, target_, part_; ///< part_: empty for a device or a pipe
    int descriptor_ = -1;
};

/// Makes a folder and those above it; one that is there stays. @throws InputError when it cannot be made
void make_folder(const std::filesystem::path& path);

enum class OutputPath {
    file,         ///< a file, a device or a pipe, through links too
    regular_file, ///< a file alone: others are written beside it
    folder
};

/// What would keep output from being written to `path`, said before anything is computed: a folder for a file and the
/// reverse, a parent that is no folder, no write permission, a name that is empty, too long, or holds control characters
/// (they reach job scripts and terminals). Makes nothing.
/// @param named  how the user gave it: "--out"
/// @returns what is wrong and what to do; nothing: it can be written as far as can be seen
std::optional<Diagnostic> output_path_problem(const std::filesystem::path& path, OutputPath kind,
                                              const std::string& named);

/// A name for files made of `name`: letters, digits, "-", "+" and "." stay, others become "_"; what is longer than 80 characters
/// is cut and told apart by a part of its SHA-256.
std::string file_word(std::string_view name);

/// The same, told apart by a part of its SHA-256 from another of the names that would have the same word, capitals or not.
std::string file_word(std::string_view name, const std::vector<std::string>& among);

/// SHA-256 of the bytes, 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

/// Folder of what is dear to make and the same in all runs, reduced rock say; empty: nothing is kept. It changes times, no
/// results. Empty until use_cache_folder() has been called: the program calls it, other programs may.
std::filesystem::path cache_folder();

/// Of this process, before its runs begin.
void use_cache_folder(std::filesystem::path folder);

/// $XDG_CACHE_HOME/damslip, else ~/.cache/damslip; empty when neither is an absolute path.
std::filesystem::path user_cache_folder();

/// SHA-256 of bytes that come in parts; of all at once sha256() of core/file.hpp.
class Sha256 {
public:
    Sha256();
    ~Sha256();
    Sha256(const Sha256&) = delete;
    Sha256& operator=(const Sha256&) = delete;

    void add(std::string_view bytes);
    std::string finish(); ///< 64 lower-case hexadecimal digits; once

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// While one lives, a command is on its way, and no file it reads may be one that its output goes to: read_file() refuses a
/// file named by keep_from_inputs(), FileWriter one that has been read and lies where output goes. Files the command has
/// written itself and those of the cache are no inputs. Commands within commands share what is known.
class InputsKept {
public:
    InputsKept();
    ~InputsKept();
    InputsKept(const InputsKept&) = delete;
    InputsKept& operator=(const InputsKept&) = delete;
};

/// Output goes to this file, or into this folder. Does nothing where no InputsKept lives. @param named  how the user gave it: "--out"
void keep_from_inputs(const std::filesystem::path& output, OutputPath kind, const std::string& named);

} // namespace damslip
