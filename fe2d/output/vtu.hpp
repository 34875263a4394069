#pragma once

#include "fe2d/mesh/mesh.hpp"

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace damslip::fe2d {

/// One named array of a VTU file: one row per component, one column per node or element. Two components are written as
/// three (z = 0), as ParaView expects of vectors.
struct VtuArray {
    std::string name; ///< with its unit: "displacement_m"
    Eigen::MatrixXd values;
};

/// Writes nodes, elements and arrays as a VTK unstructured grid (.vtu, VTK file format 1.0: raw appended data, 64-bit
/// block headers, little endian, float64). The region of every element is added as the cell array "region" (0 dam, 1
/// rock, 2 curtain, 3 reservoir). Quadratic elements
/// are written as such, transition elements as polygons of their outline. The file appears whole or not at all.
/// @throws InputError when the file cannot be written.
void write_vtu(const std::filesystem::path& path, const Mesh& mesh, const std::vector<VtuArray>& nodal,
               const std::vector<VtuArray>& elemental);

/// Lines along joints in the same form: each from point to point, without elements of area.
/// @param nodal  one column per point, line after line @throws InputError when the file cannot be written.
void write_lines_vtu(const std::filesystem::path& path, const std::vector<Polyline>& lines,
                     const std::vector<VtuArray>& nodal);

struct VtmBlock {
    std::string name; ///< "dam"
    std::string file; ///< of the .vtu, relative to the .vtm
};

/// Several .vtu files of one instant as one multiblock data set (.vtm).
void write_vtm(const std::filesystem::path& path, const std::vector<VtmBlock>& blocks);

struct PvdEntry {
    double time = 0.0; ///< [s]
    std::string file;  ///< of the .vtu or .vtm, relative to the .pvd
};

/// Collection of .vtu or .vtm files over time for ParaView (.pvd).
void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries);

/// Some elements of a mesh with the nodes they use, as a mesh of its own without chains and planes.
struct MeshPart {
    Mesh mesh;
    std::vector<int> nodes;    ///< of the whole mesh, by node of the part
    std::vector<int> elements; ///< the same of elements

    /// Columns of the part's nodes, or elements. @param values  one column per node (element) of the whole mesh
    Eigen::MatrixXd at_nodes(const Eigen::MatrixXd& values) const;
    Eigen::MatrixXd at_elements(const Eigen::MatrixXd& values) const;
};

/// @param first, end  elements first ... end - 1
MeshPart part_of(const Mesh& mesh, int first, int end);

} // namespace damslip::fe2d
