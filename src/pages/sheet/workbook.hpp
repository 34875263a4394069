#pragma once

#include "analysis/fe/contact_runs.hpp"
#include "analysis/prepare/ready.hpp"
#include "fe2d/run/run_history.hpp"
#include "pages/sheet/workbook.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

/// Calculations as a spreadsheet whose cells are formulas: what is checked by hand.
namespace damslip::pages {

/// A number with the formula that makes it: its text is that of a spreadsheet, of references to cells and of numbers.
class Formula {
public:
    Formula(double value); ///< a constant
    Formula(std::string text, double value, bool compound = true);

    double value() const { return value_; }
    const std::string& text() const { return text_; } ///< without "="
    bool constant() const { return constant_; }

    friend Formula operator+(const Formula& a, const Formula& b) { return combined(a, "+", b, a.value_ + b.value_); }
    friend Formula operator-(const Formula& a, const Formula& b) { return combined(a, "-", b, a.value_ - b.value_); }
    friend Formula operator*(const Formula& a, const Formula& b) { return combined(a, "*", b, a.value_ * b.value_); }
    friend Formula operator/(const Formula& a, const Formula& b) { return combined(a, "/", b, a.value_ / b.value_); }
    friend Formula operator-(const Formula& a) { return 0.0 - a; }

private:
    static Formula combined(const Formula& a, const char* sign, const Formula& b, double value);
    std::string inside() const { return compound_ ? "(" + text_ + ")" : text_; } ///< as an operand

    std::string text_;
    double value_;
    bool compound_ = false, constant_ = false;
};

Formula sqrt(const Formula& a);
Formula abs(const Formula& a);
Formula max(const Formula& a, const Formula& b);
/// a > b ? then : otherwise
Formula if_greater(const Formula& a, const Formula& b, const Formula& then, const Formula& otherwise);
Formula sum(const std::vector<Formula>& terms);

/// A file of worksheets (xlsx), each filled from top to bottom. Every formula is written with its value, so that a reader that does not
/// compute shows it too. The same content gives the same cells.
class Workbook {
public:
    explicit Workbook(std::filesystem::path file);
    ~Workbook();
    Workbook(const Workbook&) = delete;
    Workbook& operator=(const Workbook&) = delete;

    void begin(const std::string& name);      ///< the next worksheet; a name that exists gets a number
    void title(const std::string& text);      ///< a bold line after an empty one
    void note(const std::string& text);       ///< a line of text
    void head(const std::vector<std::string>& columns); ///< of a list, bold

    /// A line "name | value | unit | source". @returns the reference to its cell, for formulas on this worksheet
    Formula put(const std::string& name, const Formula& value, const std::string& unit, const std::string& source = {});
    void word(const std::string& name, const std::string& text); ///< a line without a number
    /// A line of a list: its name, then its cells. @returns their references
    std::vector<Formula> row(const std::string& name, const std::vector<Formula>& cells);
    /// What the program has beside what the sheet has, and their difference over the larger.
    void compare(const std::string& name, const Formula& of_sheet, double of_program, const std::string& unit);

    void close(); ///< writes the file, whole or not at all @throws InputError where it cannot be written

private:
    struct Sheet;
    enum class Bold { no, yes };
    void words(int column, const std::string& text, Bold bold = Bold::no); ///< in the line
    Formula cell(int column, const Formula& value);
    std::filesystem::path part() const { return file_.string() + ".part"; } ///< until it is closed
    std::filesystem::path file_;
    std::unique_ptr<Sheet> sheet_;
    int row_ = 0;
};

/// A worksheet for each load combination of limit equilibrium: weights, water, uplift, crack, factors, stresses, yield
/// acceleration; numbers that are given in blue, the others formulas of them, at the end beside the program's.
/// Given are: the length of the crack (its condition is a cell that has to be 0), uplift pressures other than heads of
/// water, added mass (an integral over the face), forces of anchors.
/// @param combinations  Ready::combinations() @throws InputError where the file cannot be written
void write_equilibrium_sheets(const std::filesystem::path& file, const Ready& ready,
                              const std::vector<sliding::Equilibrium>& combinations);

/// Forces on the base at one instant of a run by finite elements, kept while the run is at hand.
struct BaseInstant {
    std::string label; ///< "rock_1.0_h, polarity +1"
    double time = 0.0, slip = 0.0;                          ///< [s], [m]
    double normal_force = 0.0, shear_force = 0.0, position = 0.0; ///< RunHistory, [N/m], [N/m], from the heel [m]
    std::vector<double> distance, area, pressure, shear;    ///< of the pairs [m], [m], [Pa], [Pa]
};

/// The instant with the least (c A' + mu N')/|T|, A' the length under pressure, with the peak strength; while the base slides, where it is 1, the one with the largest shear.
/// @pre the history holds the values of the pairs
BaseInstant worst_instant(const ContactRun& run, const Contact& strength);

/// One worksheet for each run.
void write_base_sheets(const std::filesystem::path& file, const Contact& strength, const std::vector<BaseInstant>& instants);

} // namespace damslip::pages
