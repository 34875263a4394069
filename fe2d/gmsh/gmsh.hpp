#pragma once

#include "core/geometry.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// A mesh as a Gmsh file (.msh) has it, before anybody asks what it means.
namespace damslip::fe2d {

struct GmshNode {
    std::int64_t tag = 0; ///< number in the file, > 0; numbers may be left out
    Point at;             ///< in the unit of the file
    double z = 0.0;       ///< in the unit of the file
    int line = 0;         ///< of the file
};

enum class GmshShape { line, triangle, quadrilateral };

/// Nodes of one of them.
constexpr int node_count(GmshShape shape)
{
    return shape == GmshShape::line ? 2 : shape == GmshShape::triangle ? 3 : 4;
}
constexpr int dimension(GmshShape shape)
{
    return shape == GmshShape::line ? 1 : 2;
}

struct GmshElement {
    std::int64_t tag = 0;
    GmshShape shape = GmshShape::line;
    std::array<int, 4> nodes{-1, -1, -1, -1}; ///< indices in GmshFile::nodes
    std::vector<int> groups;                  ///< physical tags it belongs to; empty: none
    int line = 0;                             ///< of the file
};

/// A physical group.
struct GmshGroup {
    int dimension = 0; ///< 1: lines, 2: surfaces
    int tag = 0;
    std::string name;
    int line = 0; ///< of the file
};

struct GmshFile {
    std::filesystem::path file;
    std::string version;               ///< "2.2" or "4.1"
    std::vector<GmshNode> nodes;       ///< by increasing tag
    std::vector<GmshElement> elements; ///< lines, triangles and quadrilaterals by increasing tag
    std::vector<GmshGroup> groups;     ///< with a name, in the order of the file
};

enum class GmshVersion { v2_2, v4_1 };

/// The text of a Gmsh file, ASCII; read back it gives the same nodes, elements and groups, bit for bit.
/// @param mesh  every element in exactly one group, which has a name; tags increase
std::string gmsh_text(const GmshFile& mesh, GmshVersion version);

/// The lines of a Gmsh file one after the other; blank ones are passed over.
class GmshLines {
public:
    GmshLines(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {}

    /// Goes to the next line. @returns false at the end of the file
    bool next();
    /// Goes to the next line. @throws InputError at the end of the file, naming the section that is cut off
    void need(const std::string& section);

    std::string_view line() const { return line_; } ///< without blanks at its ends
    int number() const { return number_; }          ///< from 1
    const std::string& file() const { return file_; }

    /// @throws InputError at the current line
    [[noreturn]] void refuse(std::string problem, std::string expected, std::string fix) const;

private:
    std::string_view rest_, line_;
    std::string file_;
    int number_ = 0;
};

/// The words of the current line, taken from the left. `what` names the entry in messages: "node tag".
class GmshWords {
public:
    explicit GmshWords(const GmshLines& lines) : lines_(lines), rest_(lines.line()) {}

    std::int64_t whole(const char* what, std::int64_t low, std::int64_t high);
    double number(const char* what);      ///< finite
    std::string quoted(const char* what); ///< "text in quotes"
    void end() const;                     ///< @throws InputError where words are left

private:
    std::string_view word(const char* what);
    const GmshLines& lines_;
    std::string_view rest_;
};

/// Reads a Gmsh mesh, ASCII of version 2.2 or 4.1 (Geuzaine & Remacle 2009; sections as in the Gmsh 4.8 reference manual, "MSH file
/// format"): nodes, two-node lines, three-node triangles, four-node quadrilaterals, physical names. Tags may be sparse; points
/// (type 15) are left out; $Periodic and fields on the mesh are passed over.
/// @throws InputError with file and line for anything else: binary files, other versions and elements by name, partitions, cut
///         files, counts that do not agree, numbers that are none, tags that are unknown or given twice.
GmshFile read_gmsh(const std::filesystem::path& file);

/// The same from memory. @param file  name for messages
GmshFile parse_gmsh(std::string_view text, const std::filesystem::path& file);

} // namespace damslip::fe2d
