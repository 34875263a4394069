#pragma once

#include "core/geometry.hpp"

#include <array>
#include <string>
#include <vector>

/// Pictures that the page's scripts draw on a canvas (state_map.js, mesh_view.js).
namespace damslip::pages {

/// States along a line over time, one coloured cell each: where a base sticks, slips and opens.
struct StateMap {
    struct Kind {
        char letter = ' ';
        std::string name;
        int colour = -1; ///< 0 ... 7 of the page's palette; -1: as the paper's panel
    };
    std::string title;
    std::vector<double> time;        ///< ascending [s]
    std::vector<double> distance;    ///< of the places, ascending [m]
    std::string place;               ///< "from the heel"
    std::vector<std::string> states; ///< for each time a letter for each place
    std::vector<Kind> kinds;
    std::string note;
};

/// A mesh in several states: deformed, with contours of fields on its nodes. A slider goes through the states, from the one
/// after the first whose first field is largest; beside it stands the envelope of all after the first.
struct MeshView {
    struct Field {
        std::string name, unit;
        bool least = false; ///< its smallest value is the one that matters: the envelope keeps it
    };
    struct State {
        std::string name;
        double time = 0.0;                       ///< [s]
        std::vector<double> ux, uy;              ///< of the nodes, as magnified [m]
        double shift_x = 0.0, shift_y = 0.0;     ///< of the first `front_nodes` nodes, drawn to scale [m]
        std::vector<std::vector<double>> values; ///< of each field, of the nodes
    };
    std::string title;
    std::vector<Point> nodes;                 ///< [m]
    std::vector<std::array<int, 4>> elements; ///< counter-clockwise; the fourth is -1 in a triangle
    std::size_t front_nodes = 0;              ///< the body that is looked at: colours and first view are fitted to it
    std::vector<Field> fields;
    std::vector<State> states;
    std::string note;
};

/// What the scripts read, as one JSON object.
std::string state_map_json(const StateMap& map);
std::string mesh_view_json(const MeshView& view);

} // namespace damslip::pages
