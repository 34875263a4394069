#include "verification/second_solver/deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <set>

namespace damslip::fe2d {

namespace {

std::string number_of(double value)
{
    return fmt::format("{:.13g}", value); // fields of ccx hold 20 characters
}

/// The deck as it grows.
class DeckWriter {
public:
    explicit DeckWriter(const CalculixModel& given);

    template <class... Args>
    void line(fmt::format_string<Args...> form, Args&&... args)
    {
        fmt::format_to(std::back_inserter(text_), form, std::forward<Args>(args)...);
        text_ += '\n';
    }

    void mesh();
    void materials(const RayleighConstants& damping);
    void water();
    void supports();
    void surface(const char* name, const std::vector<int>& nodes, bool of_dam);
    void nodal_forces(const Eigen::VectorXd& force);

    int number(int node) const { return shared_[node] + 1; }
    const std::vector<int>& masses() const { return masses_; } ///< nodes of given_.water
    std::string take() { return std::move(text_); }

private:
    void share(const std::vector<int>& kept, const std::vector<int>& other);
    int middle(int a, int b);
    void elements_of(Region region, const char* name);

    const CalculixModel& given_;
    const Mesh& mesh_;
    std::string text_;
    std::vector<int> shared_;                     ///< the node that is written in place of each
    std::map<std::pair<int, int>, int> straight_; ///< middles of linear edges, by their corners as they are written
    std::vector<int> masses_;
    std::vector<std::vector<int>> element_nodes_; ///< as written
    int next_ = 0;                                ///< number of the next node
};

DeckWriter::DeckWriter(const CalculixModel& given) : given_(given), mesh_(given.model.mesh), shared_(mesh_.nodes.size())
{
    std::iota(shared_.begin(), shared_.end(), 0);
    share(mesh_.contact.dam_nodes, mesh_.contact.rock_nodes);
    for (const LiftPlane& lift : mesh_.lifts) share(lift.lower_nodes, lift.upper_nodes);
    next_ = mesh_.node_count() + 1;
    for (const Element& element : mesh_.elements) {
        const int size = element.size();
        std::vector<int> nodes;
        for (int i = 0; i < size; ++i) nodes.push_back(number(element.nodes[i]));
        for (int i = 0; i < size; ++i)
            nodes.push_back(element.mid[i] < 0 ? middle(nodes[i], nodes[(i + 1) % size]) : number(element.mid[i]));
        element_nodes_.push_back(std::move(nodes));
    }
    line("** {}", given.title);
    line("** damslip: plane strain, 1 m of dam; N, m, kg, s; x downstream, y up, heel at the origin");
}

void DeckWriter::share(const std::vector<int>& kept, const std::vector<int>& other)
{
    const DofMap& dofs = given_.model.dofs;
    for (std::size_t i = 0; i < std::min(kept.size(), other.size()); ++i)
        if (dofs(kept[i], 0) == dofs(other[i], 0) && dofs(kept[i], 1) == dofs(other[i], 1))
            shared_[other[i]] = shared_[kept[i]];
}

int DeckWriter::middle(int a, int b)
{
    const auto [at, fresh] = straight_.try_emplace({std::min(a, b), std::max(a, b)}, next_);
    if (fresh) ++next_;
    return at->second;
}

void DeckWriter::elements_of(Region region, const char* name)
{
    for (const std::size_t corners : {4u, 3u}) {
        bool opened = false;
        for (int e = 0; e < mesh_.element_count(); ++e) {
            const std::vector<int>& nodes = element_nodes_[e];
            if (mesh_.elements[e].region != region || nodes.size() != 2 * corners) continue;
            if (!opened) line("*ELEMENT, TYPE={}, ELSET={}", corners == 4 ? "CPE8" : "CPE6", name);
            opened = true;
            line("{},{}", e + 1, fmt::join(nodes, ","));
        }
    }
}

void DeckWriter::mesh()
{
    line("*NODE, NSET=Nall");
    std::set<int> used;
    for (const auto& nodes : element_nodes_) used.insert(nodes.begin(), nodes.end());
    for (int n = 0; n < mesh_.node_count(); ++n)
        if (used.contains(n + 1)) line("{},{},{},0", n + 1, number_of(mesh_.nodes[n].x), number_of(mesh_.nodes[n].y));
    for (const auto& [edge, node] : straight_) {
        const Point a = mesh_.nodes[edge.first - 1], b = mesh_.nodes[edge.second - 1];
        line("{},{},{},0", node, number_of(0.5 * (a.x + b.x)), number_of(0.5 * (a.y + b.y)));
    }
    elements_of(Region::dam, "Edam");
    elements_of(Region::rock, "Erock");
    elements_of(Region::curtain, "Ecurtain");
    for (const auto& [edge, node] : straight_)
        for (const int c : {1, 2})
            line("*EQUATION\n3\n{0},{1},1,{2},{1},-0.5,{3},{1},-0.5", node, c, edge.first, edge.second);
}

void DeckWriter::materials(const RayleighConstants& damping)
{
    const auto material = [&](Region region, const char* name) {
        const bool there = std::any_of(mesh_.elements.begin(), mesh_.elements.end(),
                                       [&](const Element& e) { return e.region == region; });
        if (!there) return;
        const bool heavy = region == Region::dam || given_.model.rock_has_mass();
        const ElasticMaterial& m = given_.model.materials.of(region);
        line("*MATERIAL, NAME=M{0}\n*ELASTIC\n{1},{2}\n*DENSITY\n{3}", name, number_of(m.young_modulus),
             number_of(m.poisson_ratio), number_of(heavy ? m.density : 0.0));
        line("*SOLID SECTION, ELSET=E{0}, MATERIAL=M{0}\n1", name);
    };
    if (damping.mass != 0.0 || damping.stiffness != 0.0)
        line("** Rayleigh damping of the step: a_M {} 1/s, b_K {} s", damping.mass, damping.stiffness);
    material(Region::dam, "dam");
    material(Region::rock, "rock");
    material(Region::curtain, "curtain");
}

void DeckWriter::water()
{
    if (given_.water.empty()) return;
    line("** added mass of the water: at each quadrature point of the wet face a point mass, which an equation moves "
         "as the\n"
         "** face moves along its normal; its x is that motion");
    int element = mesh_.element_count();
    for (const AddedMassPoint& point : given_.water) {
        const int node = next_++;
        masses_.push_back(node);
        line("*NODE\n{},{},{},0", node, number_of(point.at.x), number_of(point.at.y));
        std::vector<std::string> terms{fmt::format("{},1,1", node)};
        for (int i = 0; i < 3; ++i)
            for (const int c : {0, 1})
                if (const double share = point.nodes[i] < 0 ? 0.0 : point.shape[i] * point.normal[c]; share != 0.0)
                    terms.push_back(fmt::format("{},{},{}", number(point.nodes[i]), c + 1, number_of(-share)));
        line("*EQUATION\n{}", terms.size());
        for (std::size_t i = 0; i < terms.size(); i += 4)
            line("{}", fmt::join(terms.begin() + static_cast<std::ptrdiff_t>(i),
                                 terms.begin() + static_cast<std::ptrdiff_t>(std::min(i + 4, terms.size())), ","));
        line("*BOUNDARY\n{},2,3", node);
        line("*ELEMENT, TYPE=MASS, ELSET=Ewater{0}\n{0},{1}\n*MASS, ELSET=Ewater{0}\n{2}", ++element, node,
             number_of(point.mass));
    }
}

void DeckWriter::supports()
{
    line("*BOUNDARY");
    std::set<int> used;
    for (const Element& element : mesh_.elements)
        for (const int node : element.all()) used.insert(node);
    for (const int node : used)
        for (const int c : {0, 1})
            if (given_.model.dofs(node, c) == no_dof && shared_[node] == node) line("{0},{1},{1}", node + 1, c + 1);
}

void DeckWriter::surface(const char* name, const std::vector<int>& nodes, bool of_dam)
{
    std::set<std::pair<int, int>> edges;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) edges.insert(std::minmax(nodes[i], nodes[i + 1]));
    line("*SURFACE, NAME={}, TYPE=ELEMENT", name);
    const int first = of_dam ? 0 : mesh_.dam_element_count;
    const int last = of_dam ? mesh_.dam_element_count : mesh_.element_count();
    for (int e = first; e < last; ++e) {
        const Element& element = mesh_.elements[e];
        for (int i = 0; i < element.size(); ++i) {
            const int a = element.nodes[i], b = element.nodes[(i + 1) % element.size()];
            if (edges.contains(std::minmax(a, b))) line("{},S{}", e + 1, i + 1);
        }
    }
}

void DeckWriter::nodal_forces(const Eigen::VectorXd& force)
{
    line("*CLOAD, OP=NEW");
    std::set<int> written; // unknowns, of which nodes may share one
    for (int node = 0; node < mesh_.node_count(); ++node)
        for (const int c : {0, 1}) {
            const int dof = given_.model.dofs(node, c);
            if (dof == no_dof || force[dof] == 0.0 || !written.insert(dof).second) continue;
            line("{},{},{}", number(node), c + 1, number_of(force[dof]));
        }
}

void write_body(DeckWriter& deck, const RayleighConstants& damping)
{
    deck.mesh();
    deck.materials(damping);
    deck.supports();
    deck.water();
}

} // namespace

std::string not_for_calculix(const Model& model)
{
    int linear = 0, centre = 0;
    for (const Element& element : model.mesh.elements) {
        if (element.linear()) ++linear;
        if (element.centre >= 0) ++centre;
    }
    if (centre > 0) return fmt::format("{} elements with a node at their centre", centre);
    if (linear > 0) return fmt::format("{} linear elements", linear);
    return "";
}

std::string calculix_modes_deck(const CalculixModel& model, int count)
{
    DeckWriter deck(model);
    write_body(deck, {});
    deck.line("*STEP\n*FREQUENCY\n{}\n*END STEP", count);
    return deck.take();
}

std::string calculix_tied_deck(const CalculixModel& model, const CalculixEarthquake& e)
{
    const Mesh& mesh = model.model.mesh;
    DeckWriter deck(model);
    write_body(deck, e.damping);
    deck.line("*NSET, NSET=Ncrest\n{}", deck.number(mesh.crest.back()));
    const bool vertical = !e.motion.accel_v.empty();
    const auto amplitude = [&](const char* name, const std::vector<double>& samples) {
        deck.line("*AMPLITUDE, NAME={}", name);
        for (std::size_t i = 0; i < samples.size(); ++i)
            deck.line("{},{}", number_of(static_cast<double>(i) * e.motion.dt), number_of(samples[i]));
    };
    amplitude("Ah", e.motion.accel_h);
    if (vertical) amplitude("Av", e.motion.accel_v);
    const double duration = e.motion.dt * static_cast<double>(e.motion.accel_h.size() - 1) + e.free_vibration;
    deck.line("*STEP\n*FREQUENCY, STORAGE=YES\n{}\n*END STEP", e.modes);
    deck.line("*STEP, INC=1000000\n*MODAL DYNAMIC\n{},{}", number_of(e.motion.dt), number_of(duration));
    deck.line("*MODAL DAMPING, RAYLEIGH\n,,{},{}", number_of(e.damping.mass), number_of(e.damping.stiffness));
    const auto ground = [&](const char* name, int c, double sign) {
        deck.line("*DLOAD, AMPLITUDE={}", name);
        const std::string direction = c == 0 ? fmt::format("{},0,0", sign) : fmt::format("0,{},0", sign);
        deck.line("Edam,GRAV,1,{}", direction);
        const bool curtain = std::any_of(mesh.elements.begin(), mesh.elements.end(),
                                         [](const Element& el) { return el.region == Region::curtain; });
        if (model.model.rock_has_mass()) {
            deck.line("Erock,GRAV,1,{}", direction);
            if (curtain) deck.line("Ecurtain,GRAV,1,{}", direction);
        }
        if (model.water.empty()) return;
        deck.line("*CLOAD, AMPLITUDE={}", name);
        for (std::size_t i = 0; i < model.water.size(); ++i)
            if (const double force = sign * model.water[i].mass * model.water[i].normal[c]; force != 0.0)
                deck.line("{},1,{}", deck.masses()[i], number_of(force));
    };
    ground("Ah", 0, 1.0);
    if (vertical) ground("Av", 1, -1.0);
    deck.line("*NODE PRINT, NSET=Ncrest\nU\n*END STEP");
    return deck.take();
}

std::string calculix_contact_deck(const CalculixModel& model, const CalculixContact& contact)
{
    const ContactPlane& plane = model.model.mesh.contact;
    DeckWriter deck(model);
    write_body(deck, {});
    deck.line("*NSET, NSET=Ndam");
    for (int node = 0; node < model.model.mesh.dam_node_count; ++node) deck.line("{}", deck.number(node));
    deck.surface("Sdam", plane.dam_nodes, true);
    deck.surface("Srock", plane.rock_line, false);
    deck.line("*SURFACE INTERACTION, NAME=base\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{}",
              number_of(contact.normal_stiffness));
    deck.line("*FRICTION\n{},{}", number_of(contact.friction), number_of(contact.stick_stiffness));
    deck.line("*CONTACT PAIR, INTERACTION=base, TYPE=SURFACE TO SURFACE\nSdam,Srock");
    bool first = true;
    for (const CalculixStage& stage : contact.stages) {
        deck.line("** stage: {}\n*STEP, INC=1000\n*STATIC\n1,1", stage.name);
        if (first) deck.line("*DLOAD\nEdam,GRAV,{},0,-1,0", number_of(contact.gravity));
        first = false;
        deck.nodal_forces(stage.load);
        deck.line("*NODE PRINT, NSET=Ndam\nU\n*CONTACT PRINT, SLAVE=Sdam, MASTER=Srock\nCF\n*END STEP");
    }
    return deck.take();
}

} // namespace damslip::fe2d
