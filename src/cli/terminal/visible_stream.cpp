#include "cli/terminal/visible_stream.hpp"

#include "core/text.hpp"

namespace damslip::cli {

VisibleStream::VisibleStream(std::ostream& sink) : std::ostream(nullptr), buffer_(sink)
{
    rdbuf(&buffer_);
}

bool VisibleStream::Buffer::put(std::string_view text)
{
    sink_ << visible(text, LineEnds::kept);
    return sink_.good();
}

VisibleStream::Buffer::int_type VisibleStream::Buffer::overflow(int_type c)
{
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char one = traits_type::to_char_type(c);
    return xsputn(&one, 1) == 1 ? c : traits_type::eof();
}

std::streamsize VisibleStream::Buffer::xsputn(const char* text, std::streamsize count)
{
    used_ = used_ || count > 0;
    const std::string whole = unfinished_ + std::string(text, static_cast<std::size_t>(count));
    const std::size_t kept = unfinished_bytes(whole);
    unfinished_ = whole.substr(whole.size() - kept);
    return put(std::string_view(whole).substr(0, whole.size() - kept)) ? count : 0;
}

int VisibleStream::Buffer::sync()
{
    const bool whole = put(unfinished_);
    unfinished_.clear();
    sink_.flush();
    return whole && sink_.good() ? 0 : -1;
}

} // namespace damslip::cli
