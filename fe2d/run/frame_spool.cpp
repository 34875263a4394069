#include "fe2d/run/frame_spool.hpp"

#include "core/input_error.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <stdlib.h>
#include <unistd.h>

namespace damslip::fe2d {

namespace {

[[noreturn]] void refuse_spool()
{
    throw InputError(Diagnostic{"", 0, 0, "The frames of the run could not be kept in a temporary file.",
                                "room on the disk of temporary files (TMPDIR, else /tmp)",
                                "free some, or ask for fewer frames"});
}

/// In the folder of temporary files; gone with its last reader. Null where none can be had.
std::FILE* nameless_file()
{
    std::error_code none;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(none);
    if (none) return nullptr;
    std::string name = (folder / "damslip_frames_XXXXXX").string();
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) return nullptr;
    unlink(name.c_str());
    std::FILE* file = fdopen(descriptor, "w+b");
    if (!file) close(descriptor);
    return file;
}

void write_values(std::FILE* file, const double* values, std::size_t count)
{
    if (std::fwrite(&count, sizeof count, 1, file) != 1 || std::fwrite(values, sizeof(double), count, file) != count)
        refuse_spool();
}

template <class Values>
void read_values(std::FILE* file, Values& values)
{
    std::size_t count = 0;
    if (std::fread(&count, sizeof count, 1, file) != 1) refuse_spool();
    values.resize(count);
    if (std::fread(values.data(), sizeof(double), count, file) != count) refuse_spool();
}

/// The parts of a frame, in the order of the file.
template <class Frame, class Take>
void for_each_part(Frame& frame, const Take& take)
{
    take(frame.dam);
    take(frame.rock);
    take(frame.pressure);
    take(frame.shear);
    take(frame.slip);
    take(frame.opening);
    take(frame.joint_water);
    take(frame.water);
    take(frame.states);
}

} // namespace

FrameSpool::FrameSpool(double interval) : file_(nameless_file()), interval_(interval)
{
    if (!file_) refuse_spool();
}

void FrameSpool::add(const RunFrame& frame)
{
    std::fseek(file_.get(), 0, SEEK_END);
    const long place = std::ftell(file_.get());
    const double instant[] = {frame.time, frame.mean_slip};
    write_values(file_.get(), instant, 2);
    for_each_part(frame, [&](const auto& part) {
        write_values(file_.get(), part.data(), static_cast<std::size_t>(part.size()));
    });
    places_.push_back(place);
    last_ = frame.time;
    next_ = interval_ * (std::floor(frame.time / interval_ + 1e-9) + 1.0);
}

RunFrame FrameSpool::read(std::size_t index) const
{
    std::fseek(file_.get(), places_[index], SEEK_SET);
    RunFrame frame;
    std::vector<double> instant;
    read_values(file_.get(), instant);
    frame.time = instant[0];
    frame.mean_slip = instant[1];
    for_each_part(frame, [&](auto& part) { read_values(file_.get(), part); });
    return frame;
}

} // namespace damslip::fe2d
