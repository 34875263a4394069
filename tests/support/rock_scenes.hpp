#pragma once

#include "fe2d/model/model.hpp"
#include "fe2d/rock/radiating_rock.hpp"
#include "verification/exact/half_plane.hpp"
#include "verification/exact/strip_loads.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <numbers>

/// Rock of the reference dam, and small boxes of rock.
namespace damslip::rock_tests {

using namespace fe2d;

inline constexpr double base = 45.0; ///< [m]
inline const ElasticMaterial reference_rock{2650.0, 30e9, 0.2};

inline exact::HalfPlane half_plane(const ElasticMaterial& rock, double length)
{
    return {rock.young_modulus / (2.0 * (1.0 + rock.poisson_ratio)), rock.poisson_ratio, rock.density, 0.5 * length};
}

/// Even nodes from the heel at x = 0, the slope of the base positive where it dips downstream [-].
inline std::vector<Point> even_nodes(double length, int elements, double slope = 0.0)
{
    std::vector<Point> nodes;
    for (int i = 0; i <= elements; ++i) nodes.push_back({length * i / elements, -slope * length * i / elements});
    return nodes;
}

inline RadiatingRockInput rock_input(const ElasticMaterial& rock, double length, int elements, double hertz)
{
    RadiatingRockInput input;
    input.rock = rock;
    input.surface = even_nodes(length, elements);
    input.heel = input.surface.front();
    input.toe = input.surface.back();
    input.highest_frequency = 2.0 * std::numbers::pi * hertz;
    return input;
}

inline const RockStore no_store{""};

/// A box of a few hundred nodes: 6 B x 3 B, dimensionless.
inline WaveBoxInput small_box(int elements = 8, double highest = 2.0)
{
    WaveBoxInput input;
    input.rock = {1.0, 1.0, 0.2};
    input.base = 1.0;
    input.middle = 0.5;
    input.surface = even_nodes(1.0, elements);
    input.shape.width = 6.0;
    input.shape.depth = 3.0;
    input.shape.inner_width = 2.0;
    input.shape.inner_depth = 0.6;
    input.shape.per_sponge = 8.0;
    input.highest_frequency = highest * elastic_waves(input.rock).s;
    return input;
}

using exact::strip_loads;

/// Smallest eigenvalue over the largest.
inline double smallest_share(const Eigen::MatrixXd& symmetric)
{
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(symmetric, Eigen::EigenvaluesOnly);
    return eigen.eigenvalues()[0] / eigen.eigenvalues()[eigen.eigenvalues().size() - 1];
}

} // namespace damslip::rock_tests
