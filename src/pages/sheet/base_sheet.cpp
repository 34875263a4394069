#include "pages/sheet/sheets.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace damslip::pages {

BaseInstant worst_instant(const ContactRun& run, const Contact& strength)
{
    const fe2d::RunHistory& h = run.fe.history;
    const fe2d::PairHistory& by_pair = h.by_pair;
    const auto pairs = static_cast<std::size_t>(by_pair.pairs);
    const double friction = FrictionOverSlip(strength).peak();
    const auto factor = [&](std::size_t row) {
        double bonded = 0.0;
        for (std::size_t i = 0; i < pairs; ++i)
            if (by_pair.pressure[row * pairs + i] > 0.0) bonded += run.fe.pair_area[static_cast<Eigen::Index>(i)];
        const double shear = std::abs(h.shear_force[row]);
        const double resisting = strength.cohesion * bonded + friction * std::max(0.0, h.normal_force[row]);
        return shear > 0.0 ? resisting / shear : std::numeric_limits<double>::infinity();
    };
    constexpr double same = 1e-6; // factors of rows while the whole base slides
    std::size_t worst = 0;
    double least = factor(0);
    for (std::size_t row = 1; row < h.time.size(); ++row) {
        const double f = factor(row);
        const bool as_bad = std::abs(f - least) <= same * least;
        if (f < least && !as_bad)
            worst = row, least = f;
        else if (as_bad && std::abs(h.shear_force[row]) > std::abs(h.shear_force[worst]))
            worst = row;
    }
    BaseInstant out{run.label(), h.time[worst], h.slip[worst], h.normal_force[worst], h.shear_force[worst], h.normal_position[worst],
                    {}, {}, {}, {}};
    for (std::size_t i = 0; i < pairs; ++i) {
        out.distance.push_back(run.fe.pair_distance[static_cast<Eigen::Index>(i)]);
        out.area.push_back(run.fe.pair_area[static_cast<Eigen::Index>(i)]);
        out.pressure.push_back(by_pair.pressure[worst * pairs + i]);
        out.shear.push_back(by_pair.shear[worst * pairs + i]);
    }
    return out;
}

void write_base_sheets(const std::filesystem::path& file, const Contact& strength, const std::vector<BaseInstant>& instants)
{
    Workbook book(file);
    for (const BaseInstant& at : instants) {
        book.begin(at.label);
        book.title(fmt::format("{}: forces on the base at {:.4g} s, where it is nearest to sliding", at.label, at.time));
        book.note("Per metre of dam; effective pressure, compression positive; shear on the dam, positive where it resists downstream slip.");
        book.title("Given");
        const Formula friction = book.put("friction", FrictionOverSlip(strength).peak(), "-"),
                      cohesion = book.put("cohesion", strength.cohesion, "Pa");
        book.put("slip so far, mean over the base", at.slip, "m");
        book.title("Contact node pairs");
        book.head({"pair", "from the heel [m]", "length [m]", "pressure [Pa]", "shear [Pa]"});
        book.head({"", "N [N/m]", "T [N/m]", "moment of N [N m/m]", "pressed length [m]"});
        std::vector<Formula> normal, shear, moment, bonded;
        for (std::size_t i = 0; i < at.distance.size(); ++i) {
            const Formula d = at.distance[i], length = at.area[i], p = at.pressure[i], t = at.shear[i];
            std::vector<Formula> cells{d, length, p, t};
            const std::vector<Formula> in = book.row(fmt::format("{}", i + 1), cells);
            const std::vector<Formula> out =
                book.row("", {in[2] * in[1], in[3] * in[1], in[0] * in[2] * in[1], if_greater(in[2], 0.0, in[1], 0.0)});
            normal.push_back(out[0]), shear.push_back(out[1]), moment.push_back(out[2]), bonded.push_back(out[3]);
        }
        book.title("Sums: by the cells above, by the program, their difference");
        const Formula n = book.put("N'", sum(normal), "N/m"), t = book.put("T", sum(shear), "N/m");
        book.put("sliding factor with the peak strength", (cohesion * sum(bonded) + friction * max(0.0, n)) / abs(t), "-",
                 "of this sheet alone: (c A' + mu N')/|T|, A' the length under pressure");
        book.head({"quantity", "this sheet", "program", "difference", "unit"});
        book.compare("N'", n, at.normal_force, "N/m");
        book.compare("T", t, at.shear_force, "N/m");
        book.compare("N' from the heel", sum(moment) / n, at.position, "m");
    }
    book.close();
}

} // namespace damslip::pages
