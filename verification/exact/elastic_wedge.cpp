#include "verification/exact/elastic_wedge.hpp"

namespace damslip::exact {

ElasticWedge::Stress ElasticWedge::stress(double x, double y) const
{
    const double d = height - y, t = base / height;
    return {-water_weight * d,
            (unit_weight / t - 2.0 * water_weight / (t * t * t)) * x + (water_weight / (t * t) - unit_weight) * d,
            water_weight * x / (t * t)};
}

ElasticWedge::Displacement ElasticWedge::displacement(double x, double y) const
{
    const double nu = poisson_ratio, direct = (1.0 - nu * nu) / young_modulus, cross = -nu * (1.0 + nu) / young_modulus,
                 shear = 2.0 * (1.0 + nu) / young_modulus;
    // A linear field f = f_x x + f_y y + f_0 from three of its values.
    const Stress o = stress(0, 0), ex = stress(1, 0), ey = stress(0, 1);
    struct Linear {
        double x, y, c;
    };
    const Linear xx{ex.xx - o.xx, ey.xx - o.xx, o.xx}, yy{ex.yy - o.yy, ey.yy - o.yy, o.yy},
        xy{ex.xy - o.xy, ey.xy - o.xy, o.xy};
    const Linear e1{direct * xx.x + cross * yy.x, direct * xx.y + cross * yy.y, direct * xx.c + cross * yy.c};
    const Linear e2{direct * yy.x + cross * xx.x, direct * yy.y + cross * xx.y, direct * yy.c + cross * xx.c};
    const Linear g{shear * xy.x, shear * xy.y, shear * xy.c};
    return {e1.x * x * x / 2 + e1.y * x * y + e1.c * x + (g.y - e2.x) * y * y / 2 + g.c * y,
            e2.y * y * y / 2 + e2.x * x * y + e2.c * y + (g.x - e1.y) * x * x / 2};
}

} // namespace damslip::exact
