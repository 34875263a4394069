#include "verification/second_solver/read_dat.hpp"

#include "core/input_error.hpp"

#include <cmath>
#include <map>
#include <sstream>

namespace damslip {

namespace {

/// All words of a line that are numbers; empty where one is none.
std::vector<double> numbers_of(const std::string& line)
{
    std::istringstream words(line);
    std::vector<double> numbers;
    std::string word;
    while (words >> word) {
        std::size_t used = 0;
        try {
            numbers.push_back(std::stod(word, &used));
        } catch (const std::exception&) {
            return {};
        }
        if (used != word.size()) return {};
    }
    return numbers;
}

} // namespace

void CalculixOutput::nothing(const char* what) const
{
    throw InputError(Diagnostic{file_, 0, 0, std::string("no ") + what + " in the file.",
                                "the .dat file of ccx for the deck of the same scene and --analysis",
                                "write the deck anew and run ccx; its messages say why there are no results"});
}

std::vector<double> CalculixOutput::frequencies() const
{
    std::istringstream lines{std::string(text_)};
    std::string line;
    std::vector<double> found;
    bool inside = false;
    while (std::getline(lines, line)) {
        if (line.find("E I G E N V A L U E   O U T P U T") != std::string::npos) inside = true;
        if (line.find("P A R T I C I P A T I O N") != std::string::npos) break;
        // mode, eigenvalue, frequency in rad/s, in cycles/s, imaginary part
        if (const std::vector<double> n = numbers_of(line); inside && n.size() == 5) found.push_back(n[3]);
    }
    if (found.empty()) nothing("eigenvalues");
    return found;
}

std::vector<CrestSample> CalculixOutput::crest() const
{
    std::istringstream lines{std::string(text_)};
    std::string line;
    std::vector<CrestSample> found;
    constexpr std::string_view mark = "for set NCREST and time";
    while (std::getline(lines, line)) {
        const std::size_t at = line.find(mark);
        if (at == std::string::npos) continue;
        const std::vector<double> time = numbers_of(line.substr(at + mark.size()));
        std::string row;
        while (std::getline(lines, row) && row.find_first_not_of(' ') == std::string::npos) {
        }
        const std::vector<double> u = numbers_of(row); // node, x, y, z
        if (time.size() == 1 && u.size() == 4) found.push_back({time[0], u[1]});
    }
    if (found.empty()) nothing("displacements of the crest");
    return found;
}

std::vector<StageOutput> CalculixOutput::stages() const
{
    std::istringstream lines{std::string(text_)};
    std::string line;
    std::map<long, StageOutput> found; // by the time of their end, 1 s a stage
    constexpr std::string_view nodes = "for set NDAM and time", contact = "total surface force";
    long stage = 0;
    std::vector<double> u;
    while (std::getline(lines, line)) {
        if (const std::size_t at = line.find(nodes); at != std::string::npos) {
            const std::vector<double> time = numbers_of(line.substr(at + nodes.size()));
            const double t = time.empty() ? 0.0 : time[0];
            stage = std::abs(t - std::round(t)) < 1e-6 ? std::lround(t) : 0; // 0: an increment on the way
            u.clear();
            std::getline(lines, line); // blank
            while (std::getline(lines, line)) {
                const std::vector<double> row = numbers_of(line);
                if (row.size() != 4) break;
                u.insert(u.end(), {row[1], row[2]});
            }
            if (stage > 0) found[stage].displacement = u;
        }
        if (line.find(contact) == std::string::npos) continue;
        std::vector<double> sum;
        while (sum.empty() && std::getline(lines, line)) sum = numbers_of(line);
        if (stage > 0 && sum.size() == 6) {
            found[stage].shear_force = -sum[0];
            found[stage].normal_force = sum[1];
        }
    }
    std::vector<StageOutput> all;
    for (auto& [number, output] : found) all.push_back(std::move(output));
    if (all.empty()) nothing("static stages");
    return all;
}

} // namespace damslip
