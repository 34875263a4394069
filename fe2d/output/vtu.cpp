#include "fe2d/output/vtu.hpp"

#include "core/file.hpp"
#include "core/text.hpp"

#include <bit>
#include <cassert>
#include <cstring>
#include <fmt/format.h>

namespace damslip::fe2d {

namespace {

static_assert(std::endian::native == std::endian::little, "the appended data is written as it lies in memory");

/// Collects the appended data; every block is its length as UInt64, then its bytes.
class Appended {
public:
    template <class T>
    std::size_t add(const std::vector<T>& values)
    {
        const std::size_t offset = bytes_.size();
        const std::uint64_t length = values.size() * sizeof(T);
        append(&length, sizeof length);
        append(values.data(), length);
        return offset;
    }
    const std::string& bytes() const { return bytes_; }

private:
    void append(const void* data, std::size_t length) { bytes_.append(static_cast<const char*>(data), length); }
    std::string bytes_;
};

std::string header(const char* type, const std::string& name, int components, std::size_t offset)
{
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
        xml_text(name), components, offset);
}

std::string array(const VtuArray& a, Appended& data)
{
    const Eigen::Index rows = a.values.rows(), written = rows == 2 ? 3 : rows;
    std::vector<double> values(static_cast<std::size_t>(written * a.values.cols()), 0.0);
    for (Eigen::Index j = 0; j < a.values.cols(); ++j)
        for (Eigen::Index i = 0; i < rows; ++i) values[static_cast<std::size_t>(written * j + i)] = a.values(i, j);
    return header("Float64", a.name, static_cast<int>(written), data.add(values));
}

std::string points(const Polyline& nodes, Appended& data)
{
    std::vector<double> xyz;
    xyz.reserve(3 * nodes.size());
    for (const Point& p : nodes) xyz.insert(xyz.end(), {p.x, p.y, 0.0});
    return "<Points>\n" + header("Float64", "points_m", 3, data.add(xyz)) + "</Points>\n";
}

// VTK_LINE ... VTK_BIQUADRATIC_QUAD; VTK orders the nodes of these cells as Element::all does.
constexpr std::uint8_t line = 3, triangle = 5, polygon = 7, quad = 9, quadratic_triangle = 22, quadratic_quad = 23,
                       biquadratic_quad = 28;

/// VTK has no cell with some edges linear and some quadratic: transition elements are polygons.
std::uint8_t cell_type(const Element& e)
{
    if (e.linear()) return e.size() == 3 ? triangle : quad;
    for (int i = 0; i < e.size(); ++i)
        if (e.mid[i] < 0) return polygon;
    return e.size() == 3 ? quadratic_triangle : e.centre < 0 ? quadratic_quad : biquadratic_quad;
}

/// Corners and middle nodes in the order of the outline.
ElementNodes outline(const Element& e)
{
    ElementNodes nodes;
    for (int i = 0; i < e.size(); ++i) {
        nodes.index[nodes.count++] = e.nodes[i];
        if (e.mid[i] >= 0) nodes.index[nodes.count++] = e.mid[i];
    }
    return nodes;
}

std::string cells(const std::vector<std::int64_t>& connectivity, const std::vector<std::int64_t>& offsets,
                  const std::vector<std::uint8_t>& types, Appended& data)
{
    std::string text = "<Cells>\n";
    text += header("Int64", "connectivity", 1, data.add(connectivity));
    text += header("Int64", "offsets", 1, data.add(offsets));
    text += header("UInt8", "types", 1, data.add(types));
    return text + "</Cells>\n";
}

std::string cells(const Mesh& mesh, Appended& data)
{
    std::vector<std::int64_t> connectivity, offsets;
    std::vector<std::uint8_t> types;
    for (const Element& e : mesh.elements) {
        types.push_back(cell_type(e));
        for (const int node : types.back() == polygon ? outline(e) : e.all()) connectivity.push_back(node);
        offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    }
    return cells(connectivity, offsets, types, data);
}

VtuArray regions(const Mesh& mesh)
{
    VtuArray a{"region", Eigen::MatrixXd(1, mesh.element_count())};
    for (int e = 0; e < mesh.element_count(); ++e) a.values(0, e) = static_cast<double>(mesh.elements[e].region);
    return a;
}

std::string arrays(const char* element, const std::vector<VtuArray>& list, Appended& data)
{
    std::string text = fmt::format("<{}>\n", element);
    for (const VtuArray& a : list) text += array(a, data);
    return text + fmt::format("</{}>\n", element);
}

/// The file around points, cells and arrays, which `data` holds.
void write_grid(const std::filesystem::path& path, std::size_t nodes, std::size_t elements, const std::string& inside,
                const Appended& data)
{
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
                       "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";
    text += fmt::format("<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", nodes, elements);
    text += inside + "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    text += data.bytes();
    text += "\n</AppendedData>\n</VTKFile>\n";
    write_file(path, text);
}

} // namespace

void write_vtu(const std::filesystem::path& path, const Mesh& mesh, const std::vector<VtuArray>& nodal,
               const std::vector<VtuArray>& elemental)
{
    for ([[maybe_unused]] const VtuArray& a : nodal) assert(a.values.cols() == mesh.node_count());
    for ([[maybe_unused]] const VtuArray& a : elemental) assert(a.values.cols() == mesh.element_count());
    std::vector<VtuArray> of_elements{regions(mesh)};
    of_elements.insert(of_elements.end(), elemental.begin(), elemental.end());
    Appended data;
    const std::string connected = cells(mesh, data); // its data come first, whatever the order of the text
    std::string inside = points(mesh.nodes, data) + connected;
    inside += arrays("PointData", nodal, data);
    inside += arrays("CellData", of_elements, data);
    write_grid(path, mesh.nodes.size(), mesh.elements.size(), inside, data);
}

void write_lines_vtu(const std::filesystem::path& path, const std::vector<Polyline>& lines,
                     const std::vector<VtuArray>& nodal)
{
    Polyline all;
    std::vector<std::int64_t> connectivity, offsets;
    for (const Polyline& one : lines) {
        const auto first = static_cast<std::int64_t>(all.size());
        all.insert(all.end(), one.begin(), one.end());
        for (auto i = first + 1; i < static_cast<std::int64_t>(all.size()); ++i) {
            connectivity.insert(connectivity.end(), {i - 1, i});
            offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
        }
    }
    Appended data;
    std::string inside = points(all, data);
    inside += cells(connectivity, offsets, std::vector<std::uint8_t>(offsets.size(), line), data);
    inside += arrays("PointData", nodal, data);
    write_grid(path, all.size(), offsets.size(), inside, data);
}

void write_vtm(const std::filesystem::path& path, const std::vector<VtmBlock>& blocks)
{
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" "
                       "byte_order=\"LittleEndian\">\n<vtkMultiBlockDataSet>\n";
    for (std::size_t i = 0; i < blocks.size(); ++i)
        text += fmt::format("<DataSet index=\"{}\" name=\"{}\" file=\"{}\"/>\n", i, xml_text(blocks[i].name),
                            xml_text(blocks[i].file));
    write_file(path, text + "</vtkMultiBlockDataSet>\n</VTKFile>\n");
}

void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries)
{
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
                       "byte_order=\"LittleEndian\">\n<Collection>\n";
    for (const PvdEntry& e : entries)
        text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", shortest(e.time), xml_text(e.file));
    write_file(path, text + "</Collection>\n</VTKFile>\n");
}

namespace {

Eigen::MatrixXd chosen_columns(const Eigen::MatrixXd& values, const std::vector<int>& columns)
{
    Eigen::MatrixXd chosen(values.rows(), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) chosen.col(static_cast<Eigen::Index>(i)) = values.col(columns[i]);
    return chosen;
}

} // namespace

Eigen::MatrixXd MeshPart::at_nodes(const Eigen::MatrixXd& values) const
{
    return chosen_columns(values, nodes);
}

Eigen::MatrixXd MeshPart::at_elements(const Eigen::MatrixXd& values) const
{
    return chosen_columns(values, elements);
}

MeshPart part_of(const Mesh& mesh, int first, int end)
{
    MeshPart part;
    std::vector<int> place(mesh.nodes.size(), -1);
    const auto take = [&](int& node) {
        if (node < 0) return;
        int& at = place[static_cast<std::size_t>(node)];
        if (at < 0) {
            at = static_cast<int>(part.nodes.size());
            part.nodes.push_back(node);
            part.mesh.nodes.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
        }
        node = at;
    };
    for (int e = first; e < end; ++e) {
        Element element = mesh.elements[static_cast<std::size_t>(e)];
        for (int& node : element.nodes) take(node);
        for (int& node : element.mid) take(node);
        take(element.centre);
        part.mesh.elements.push_back(element);
        part.elements.push_back(e);
    }
    return part;
}

} // namespace damslip::fe2d
