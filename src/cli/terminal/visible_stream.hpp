#pragma once

#include <ostream>
#include <streambuf>
#include <string>

namespace damslip::cli {

/// A stream in front of another one that lets no control character through but newline and tab (visible()):
/// names and titles come from files, and what they hold must not move a terminal's cursor or hide text.
class VisibleStream : public std::ostream {
public:
    explicit VisibleStream(std::ostream& sink);
    bool used() const { return buffer_.used(); } ///< has anything been written?

private:
    class Buffer : public std::streambuf {
    public:
        explicit Buffer(std::ostream& sink) : sink_(sink) {}
        bool used() const { return used_; }

    protected:
        int_type overflow(int_type c) override;
        std::streamsize xsputn(const char* text, std::streamsize count) override;
        int sync() override;

    private:
        bool put(std::string_view text);

        std::ostream& sink_;
        bool used_ = false;
        std::string unfinished_; ///< first bytes of a character, at most two
    };
    Buffer buffer_;
};

} // namespace damslip::cli
