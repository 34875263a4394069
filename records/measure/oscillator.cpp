#include "records/measure/oscillator.hpp"

#include <cassert>
#include <initializer_list>

namespace damslip::records {

OscillatorStep::OscillatorStep(double circular_frequency, double ratio, double step)
{
    const double w = circular_frequency, h = step;
    assert(w >= 0.0 && ratio >= 0.0 && h > 0.0 && w * h * (1.0 + 2.0 * ratio) <= 2.0);

    // In the variables (w u, u') the matrix is Z = w h [0 1; -1 -2 zeta], of norm <= w h (1 + 2 zeta). The response to
    // the constant part of the load is h phi_1(Z), to the rising part h phi_2(Z) with phi_1 = sum Z^k/(k+1)!, phi_2 =
    // sum Z^k/(k+2)!. In (u/h, u') the same powers have entries free of 1/w: power = [p0 p1; p2 p3] of Z' = [0 1;
    // -(wh)^2 -2 zeta w h].
    const double z2 = -(w * h) * (w * h), z3 = -2.0 * ratio * w * h;
    double p[4] = {1.0, 0.0, 0.0, 1.0};
    double e[4] = {}, phi1[2] = {}, phi2[2] = {}; // phi: second column, the load enters the velocity row
    double factorial = 1.0;                       // k!
    for (int k = 0; k < 28; ++k) {                // 2^28/28! = 9e-22
        const double f1 = factorial * (k + 1), f2 = f1 * (k + 2);
        for (int i = 0; i < 4; ++i) e[i] += p[i] / factorial;
        phi1[0] += p[1] / f1, phi1[1] += p[3] / f1;
        phi2[0] += p[1] / f2, phi2[1] += p[3] / f2;
        const double next[4] = {p[1] * z2, p[0] + p[1] * z3, p[3] * z2, p[2] + p[3] * z3};
        for (int i = 0; i < 4; ++i) p[i] = next[i];
        factorial = f1;
    }
    a_[0] = e[0], a_[1] = e[1] * h, a_[2] = e[2] / h, a_[3] = e[3];
    b_[0] = -h * h * (phi1[0] - phi2[0]), b_[1] = -h * h * phi2[0];
    b_[2] = -h * (phi1[1] - phi2[1]), b_[3] = -h * phi2[1];
}

OscillatorStep OscillatorStep::in_turn(const OscillatorStep& first, int p, const OscillatorStep& second, int q)
{
    const double f = static_cast<double>(p) / (p + q); // acceleration between: (1 - f) a_0 + f a_1
    OscillatorStep both;
    for (const int row : {0, 2}) {
        const double* a = second.a_ + row;
        for (const int column : {0, 1}) {
            both.a_[row + column] = a[0] * first.a_[column] + a[1] * first.a_[2 + column];
            const double through = a[0] * first.b_[1] + a[1] * first.b_[3] + second.b_[row]; // of the one between
            both.b_[row + column] = column == 0 ? a[0] * first.b_[0] + a[1] * first.b_[2] + (1.0 - f) * through
                                                : f * through + second.b_[row + 1];
        }
    }
    return both;
}

OscillatorStep OscillatorStep::repeated(int count) const
{
    assert(count >= 1);
    if (count == 1) return *this;
    const OscillatorStep half = repeated(count / 2), twice = in_turn(half, 1, half, 1);
    return count % 2 == 0 ? twice : in_turn(twice, count - 1, *this, 1);
}

} // namespace damslip::records
