#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace damslip {

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

} // namespace damslip
