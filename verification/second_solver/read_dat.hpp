#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace damslip {

/// Displacement of the crest at one time.
struct CrestSample {
    double time = 0.0; ///< [s]
    double x = 0.0;    ///< downstream, relative to the ground [m]
};

/// One static stage.
struct StageOutput {
    std::vector<double> displacement;             ///< (x, y) of the nodes of the set Ndam, by number [m]
    double normal_force = 0.0, shear_force = 0.0; ///< of the contact on the dam: up, and upstream [N]
};

/// The results that ccx has printed to its .dat file.
class CalculixOutput {
public:
    /// Kept by reference. @param file  its name, for messages
    CalculixOutput(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

    std::vector<double>
    frequencies() const; ///< of the first eigenvalue table [Hz]. @throws InputError where there is none
    std::vector<CrestSample> crest() const;  ///< of the node set Ncrest. @throws InputError where there is none
    std::vector<StageOutput> stages() const; ///< in their order. @throws InputError where there is none

private:
    [[noreturn]] void nothing(const char* what) const;

    std::string_view text_;
    std::string file_;
};

} // namespace damslip
