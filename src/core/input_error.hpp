#pragma once

#include "core/status.hpp"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace damslip {

/// One thing that is wrong with the input, in the words its user needs.
struct Diagnostic {
    std::string file;     ///< as the user named it; empty: the command line
    int line = 0;         ///< from 1; 0: unknown or the file as a whole
    int column = 0;       ///< from 1; 0: unknown
    std::string problem;  ///< what is there: "contact.friction = -0.77 is not allowed."
    std::string expected; ///< what is allowed, with unit and range; may be empty
    std::string fix;      ///< what to do about it; may be empty

    /// "file:line:column: error: problem" and the indented lines "expected: ..." and "fix: ...".
    std::string text() const;
};

/// The input is wrong: thrown while reading, before anything is computed, with everything found wrong at once.
class InputError : public std::runtime_error {
public:
    explicit InputError(Diagnostic diagnostic);
    explicit InputError(std::vector<Diagnostic> diagnostics);
    const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

private:
    std::vector<Diagnostic> diagnostics_;
};

/// A file whose lines are in order one by one, but not what they make together. @throws InputError, naming the file
[[noreturn]] void refuse(const std::filesystem::path& file, std::string problem, std::string expected, std::string fix);

/// A solver that found no answer, or lost its accuracy, where only an answer can be returned (exit code 4). Not an error of
/// the input: the scene is allowed, and says nothing wrong.
class NotConverged : public std::runtime_error {
public:
    explicit NotConverged(Diagnostic diagnostic);
    const Diagnostic& diagnostic() const { return diagnostic_; }

private:
    Diagnostic diagnostic_;
};

/// The user stopped a computation where nothing can be returned (exit code 4).
class Interrupted : public std::runtime_error {
public:
    /// @param where  what was going on: "the set-up of the finite elements"
    explicit Interrupted(const std::string& where);
};

/// The candidate nearest to `word` within an edit distance of 2 (3 for words of more than 8 letters); empty if none is
/// near.
std::string_view nearest(std::string_view word, const std::vector<std::string>& candidates);

/// What was asked for is wrong (exit code 2), as opposed to a file (exit code 3).
class UsageError : public InputError {
public:
    using InputError::InputError;
};

/// @throws UsageError  @param problem, expected, fix  as Diagnostic has them
[[noreturn]] inline void refuse_usage(std::string problem, std::string expected, std::string fix)
{
    throw UsageError(Diagnostic{"", 0, 0, std::move(problem), std::move(expected), std::move(fix)});
}

} // namespace damslip
