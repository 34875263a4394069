#include "core/file.hpp"

#include "core/input_error.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <istream>
#include <mutex>
#include <openssl/evp.h>
#include <set>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace damslip {

namespace fs = std::filesystem;

namespace {

/// What makes two names the same file.
using FileIdentity = std::pair<dev_t, ino_t>;

std::optional<FileIdentity> identity_of(const fs::path& path)
{
    struct stat status{};
    if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
    return FileIdentity{status.st_dev, status.st_ino};
}

/// Of the commands on their way, see InputsKept.
struct KnownFiles {
    struct Output {
        fs::path path, folder; ///< folder: where the file or others beside it go
        std::string named;
        bool is_folder = false;
    };
    std::mutex mutex;
    int commands = 0;
    std::vector<Output> outputs;
    std::set<FileIdentity> inputs, own;
};

KnownFiles& known_files()
{
    static KnownFiles known;
    return known;
}

fs::path without_links(const fs::path& path)
{
    std::error_code error;
    const fs::path there = fs::weakly_canonical(path, error);
    return error ? path : there;
}

/// @throws InputError for a file that output goes to
void remember_input(const fs::path& path)
{
    KnownFiles& known = known_files();
    const std::lock_guard lock(known.mutex);
    if (known.commands == 0) return;
    const std::optional<FileIdentity> file = identity_of(path);
    if (!file || known.own.contains(*file) || (!cache_folder().empty() && path.parent_path() == cache_folder())) return;
    for (const KnownFiles::Output& output : known.outputs)
        if (!output.is_folder && identity_of(output.path) == file)
            throw InputError(Diagnostic{path.string(), 0, 0,
                                        fmt::format("{} {} is this file, which is read here: it would be overwritten.",
                                                    output.named, output.path.string()),
                                        "an output that is no input of the same command",
                                        fmt::format("choose another name for {}", output.named)});
    known.inputs.insert(*file);
}

/// The file is an input, in a folder that output goes to.
bool overwrites_input(const fs::path& target)
{
    KnownFiles& known = known_files();
    const std::lock_guard lock(known.mutex);
    if (known.commands == 0) return false;
    const std::optional<FileIdentity> file = identity_of(target);
    if (!file || known.own.contains(*file) || !known.inputs.contains(*file)) return false;
    const fs::path folder = without_links(target).parent_path();
    return std::any_of(known.outputs.begin(), known.outputs.end(),
                       [&](const KnownFiles::Output& output) { return output.folder == folder; });
}

void remember_own(const fs::path& written)
{
    KnownFiles& known = known_files();
    const std::lock_guard lock(known.mutex);
    if (known.commands == 0) return;
    if (const std::optional<FileIdentity> file = identity_of(written)) known.own.insert(*file);
}

} // namespace

InputsKept::InputsKept()
{
    KnownFiles& known = known_files();
    const std::lock_guard lock(known.mutex);
    ++known.commands;
}

InputsKept::~InputsKept()
{
    KnownFiles& known = known_files();
    const std::lock_guard lock(known.mutex);
    if (--known.commands > 0) return;
    known.outputs.clear();
    known.inputs.clear();
    known.own.clear();
}

void keep_from_inputs(const fs::path& output, OutputPath kind, const std::string& named)
{
    KnownFiles& known = known_files();
    const std::lock_guard lock(known.mutex);
    if (known.commands == 0) return;
    const fs::path there = without_links(output);
    const bool is_folder = kind == OutputPath::folder;
    known.outputs.push_back({output, is_folder && !there.has_filename() ? there.parent_path() // "out/"
                                     : is_folder                        ? there
                                                                        : there.parent_path(),
                             named, is_folder});
}

std::string read_file(const fs::path& path, std::uintmax_t max_bytes, const LookAtStart& look)
{
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status) || path.native().find('\0') != std::string::npos) // the system reads a name up to a NUL
        refuse(path, "there is no such file.", "a readable file",
               "check the name; relative names start from the file that mentions them");
    if (fs::is_directory(status))
        refuse(path, "this is a folder, not a file.", "a readable file", "name a file inside it");
    std::ifstream in(path, std::ios::binary);
    if (!in) refuse(path, "the file cannot be opened.", "a readable file", "check its read permission");
    remember_input(path);
    const auto check = [&](std::uintmax_t size) {
        if (size > max_bytes)
            refuse(path, fmt::format("the file is larger than {} MB.", max_bytes >> 20), "a readable file",
                   "this is not one of the formats read here; cut it down");
    };
    if (fs::is_regular_file(status)) check(fs::file_size(path, error));
    std::string content;
    std::array<char, 1 << 16> block;
    while (in.read(block.data(), block.size()) || in.gcount() > 0) {
        const bool first = content.empty();
        content.append(block.data(), static_cast<std::size_t>(in.gcount()));
        check(content.size());
        if (first && look) look(content);
    }
    return content;
}

bool read_line(std::istream& in, std::string& line, std::size_t most)
{
    line.clear();
    if (!in.good()) return false;
    std::streambuf& bytes = *in.rdbuf();
    constexpr int end = std::char_traits<char>::eof();
    int c = bytes.sbumpc();
    if (c == end) in.setstate(std::ios::eofbit | std::ios::failbit);
    if (c == end) return false;
    for (; c != end && c != '\n'; c = bytes.sbumpc())
        if (line.size() < most) line += static_cast<char>(c);
    if (c == end) in.setstate(std::ios::eofbit);
    return true;
}

namespace {

constexpr std::size_t longest_name = 255;     ///< of a file or folder, bytes
constexpr std::size_t longest_file_word = 80; ///< leaves room for what is put around it
constexpr std::size_t longest_path = PATH_MAX - 1;

bool is_stream(fs::file_type type)
{
    return type == fs::file_type::character || type == fs::file_type::fifo;
}

/// The file behind links, whether it exists or not. @param error  set for links in a circle
fs::path behind_links(fs::path path, std::error_code& error)
{
    constexpr int most = 40; // as the system follows
    for (int k = 0; k < most; ++k) {
        if (!fs::is_symlink(fs::symlink_status(path, error))) {
            error.clear();
            return path;
        }
        const fs::path target = fs::read_symlink(path, error);
        if (error) return path;
        path = target.is_absolute() ? target : path.parent_path() / target;
    }
    error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
    return path;
}

/// All bytes into an open descriptor. @returns errno; 0: all written
int write_all(int descriptor, std::string_view content)
{
    while (!content.empty()) {
        const ssize_t n = ::write(descriptor, content.data(), content.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return errno;
        content.remove_prefix(static_cast<std::size_t>(n));
    }
    return 0;
}

[[noreturn]] void refuse_write(const fs::path& path, const std::string& why,
                               const char* expected = "a folder with write permission and space left")
{
    refuse(path, "cannot be written: " + why, expected, "choose another output");
}

std::atomic<int> temporaries{0};
} // namespace

Temporary::Temporary()
{
    ++temporaries;
}

Temporary::~Temporary()
{
    --temporaries;
}

bool Temporary::any()
{
    return temporaries > 0;
}

FileWriter::FileWriter(const fs::path& path) : named_(path)
{
    std::error_code error;
    target_ = behind_links(path, error);
    if (error) refuse_write(named_, error.message());
    const fs::file_type type = fs::status(target_, error).type();
    if (type == fs::file_type::directory) refuse_write(named_, "it is a folder.", "a file");
    if (!is_stream(type)) {
        if (fs::exists(fs::file_status(type)) && type != fs::file_type::regular)
            refuse_write(named_, "it is no file.", "a file");
        error.clear();
        if (target_.has_parent_path()) fs::create_directories(target_.parent_path(), error);
        if (error) refuse_write(named_, error.message());
        if (overwrites_input(target_))
            refuse_write(named_, "it is an input of this command.", "a folder that holds no input of the same name");
        part_ = target_.parent_path() /
                fmt::format(".damslip.{}.{}.part", ::getpid(), sha256(target_.filename().string()).substr(0, 8));
    }
    const fs::path& file = part_.empty() ? target_ : part_;
    const int flags = part_.empty() ? 0 : O_CREAT | O_TRUNC;
    descriptor_ = ::open(file.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666);
    if (descriptor_ < 0) refuse_write(named_, std::strerror(errno));
}

FileWriter::~FileWriter()
{
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    std::error_code error;
    if (!part_.empty()) fs::remove(part_, error);
}

void FileWriter::write(std::string_view bytes)
{
    if (const int failure = write_all(descriptor_, bytes); failure != 0) refuse_write(named_, std::strerror(failure));
}

void FileWriter::finish()
{
    std::error_code error;
    if (::close(std::exchange(descriptor_, -1)) != 0)
        error.assign(errno, std::generic_category());
    else if (!part_.empty())
        fs::rename(part_, target_, error);
    if (!error) {
        if (!part_.empty()) remember_own(target_);
        return;
    }
    const std::string why = error.message();
    if (!part_.empty()) fs::remove(part_, error);
    refuse_write(named_, why);
}

void write_file(const fs::path& path, std::string_view content)
{
    std::error_code error; // a resolved scene that is run again into its own folder has the same bytes
    if (overwrites_input(path) && fs::file_size(path, error) == content.size() && !error && read_file(path) == content) return;
    FileWriter file(path);
    file.write(content);
    file.finish();
}

void make_folder(const fs::path& path)
{
    std::error_code error;
    fs::create_directories(path, error);
    if (error) refuse_write(path, error.message());
}

std::optional<Diagnostic> output_path_problem(const fs::path& path, OutputPath kind, const std::string& named)
{
    const std::string text = path.string();
    const char* const wanted = kind == OutputPath::folder ? "a folder, made if it is not there" : "a file";
    const auto problem = [&](std::string what, std::string expected, std::string fix) {
        return Diagnostic{"", 0, 0, named + " " + std::move(what), std::move(expected), std::move(fix)};
    };
    if (text.empty()) return problem("is empty.", wanted, "name one, or leave " + named + " out");
    if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }))
        return problem(text + " has a line break or another control character in its name.",
                       "a name of printable characters", "rename it: such names break job scripts and file lists");
    if (text.size() > longest_path) return problem("has a path of more than 4095 bytes.", wanted, "shorten it");
    constexpr std::size_t endings = 32; // "... .12-of-40.sqlite-journal"
    const std::size_t longest = longest_name - (kind == OutputPath::regular_file ? endings : 0);
    for (const fs::path& part : path)
        if (part.string().size() > longest)
            return problem(fmt::format("has a name of {} bytes.", part.string().size()),
                           fmt::format("at most {} bytes for a file or folder", longest), "shorten it");
    std::error_code error;
    const fs::path target = behind_links(path, error);
    if (error) return problem(text + ": " + error.message() + ".", wanted, "choose another");
    const fs::file_type type = fs::status(target, error).type();
    const bool exists = fs::exists(fs::file_status(type));
    if (kind == OutputPath::folder) {
        if (exists && type != fs::file_type::directory)
            return problem(text + " is not a folder.", wanted, "choose another, or move the file away");
    } else if (type == fs::file_type::directory || !path.has_filename()) {
        return problem(text + " is a folder.", wanted, "name a file inside it: " + (path / "NAME").string());
    } else if (exists && kind == OutputPath::regular_file && type != fs::file_type::regular) {
        return problem(text + " is a device or a pipe.", "a file: others are kept beside it",
                       "name a file, or leave " + named + " out: standard output then has the rows");
    } else if (exists && type != fs::file_type::regular && !is_stream(type)) {
        return problem(text + " is no file.", wanted, "choose another");
    }
    if (exists) {
        if (::access(target.c_str(), W_OK) != 0)
            return problem(text + " is write-protected.", "write permission",
                           "choose another, or change its permission");
        if (type == fs::file_type::directory || is_stream(type)) return std::nullopt;
    }
    fs::path folder = fs::absolute(target, error).parent_path();
    while (!fs::exists(fs::status(folder, error)) && folder.has_relative_path()) folder = folder.parent_path();
    if (!fs::is_directory(fs::status(folder, error)))
        return problem(fmt::format("{} lies below {}, which is not a folder.", text, folder.string()), wanted,
                       "choose another");
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        return problem(fmt::format("{}: the folder {} cannot be written.", text, folder.string()), "write permission",
                       "choose another, or change its permission");
    return std::nullopt;
}

namespace {

/// @param word  made of `name`
std::string with_hash(std::string word, std::string_view name)
{
    constexpr std::size_t digits = 8;
    return word.substr(0, longest_file_word - digits - 1) + "-" + sha256(name).substr(0, digits);
}

} // namespace

std::string file_word(std::string_view name)
{
    std::string word;
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        word += plain || c == '-' || c == '+' || c == '.' ? c : '_';
    }
    return word.size() <= longest_file_word ? word : with_hash(std::move(word), name);
}

std::string file_word(std::string_view name, const std::vector<std::string>& among)
{
    const auto folded = [](std::string_view of) {
        std::string word = file_word(of);
        for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return word;
    };
    const bool alone = std::none_of(among.begin(), among.end(), [&](const std::string& other) {
        return other != name && folded(other) == folded(name);
    });
    return alone ? file_word(name) : with_hash(file_word(name), name);
}

std::string sha256(std::string_view bytes)
{
    Sha256 hash;
    hash.add(bytes);
    return hash.finish();
}

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

struct Sha256::State {
    std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context{EVP_MD_CTX_new(), EVP_MD_CTX_free};
};

Sha256::Sha256() : state_(std::make_unique<State>())
{
    EVP_DigestInit_ex(state_->context.get(), EVP_sha256(), nullptr);
}

Sha256::~Sha256() = default;

void Sha256::add(std::string_view bytes)
{
    EVP_DigestUpdate(state_->context.get(), bytes.data(), bytes.size());
}

std::string Sha256::finish()
{
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int length = 0;
    EVP_DigestFinal_ex(state_->context.get(), digest.data(), &length);
    std::string hex;
    for (unsigned int i = 0; i < length; ++i) hex += fmt::format("{:02x}", digest[i]);
    return hex;
}

} // namespace damslip
