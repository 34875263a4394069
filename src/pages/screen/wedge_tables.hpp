#pragma once

#include "analysis/screen/screening.hpp"
#include "core/table.hpp"
#include "pages/report/chart.hpp"

/// The rock wedge: its planes, how it stands, its yields. @pre scene.wedge
namespace damslip::pages {

/// Orientation, area, strength, water and normal force of both planes.
Table wedge_plane_table(const Scene& scene, const RigidWedge& wedge);

/// Way of sliding, its direction, factor of safety: as it is, and without cohesion where a slip takes it away.
Table wedge_stability_table(const Scene& scene, const RigidModel& model);

/// Yield accelerations for ground motion along the records, against them, most unfavourable, and vertical.
Table wedge_yield_table(const Scene& scene, const RigidWedge& wedge);

/// Yield acceleration over the azimuth the motion drives to.
Chart wedge_yield_chart(const RigidWedge& wedge, double largest_pga);

/// "plunging 31.2° towards 158°".
std::string direction_words(const Vector3& direction);

} // namespace damslip::pages
