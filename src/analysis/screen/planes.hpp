#pragma once

#include "analysis/prepare/ready.hpp"
#include "core/status.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"
#include "sliding/planes/lifts.hpp"

#include <optional>
#include <string>
#include <vector>

/// All planes that a dam can slide on, and which one governs.
namespace damslip {

enum class PlaneKind { base, lift, seam };

/// A state that factors of safety are asked for, and what is required in it.
struct PlaneState {
    sliding::GroundState ground;
    std::optional<double> required; ///< least factor [-]; none: no criterion
    std::optional<double> of_base;  ///< factor of the base in it, the lesser of with and without crack [-]
};

/// Slip of a plane under one record with one polarity, with the vertical component where the record has one.
struct PlaneSlip {
    std::string record;
    int polarity = 1;
    sliding::SlideResult slide;
};

/// Works on the bodies of a seam in the run of its largest slip.
struct SeamWork {
    std::string plane, record;
    int polarity = 1;
    sliding::SeamSlide slide;
};

struct PlaneRow {
    PlaneKind kind = PlaneKind::base;
    std::string name;
    std::size_t place = 0;                      ///< among Planes::lifts or Planes::seams
    std::optional<double> angle = {},
                          angle_factor = {};         ///< α of the wedge: at the least a_y, at the least factor [rad]
    std::vector<std::optional<double>> factors = {}; ///< of each state [-]; none: not known, or nothing drives it
    double yield = 0.0;                         ///< a_y of the ground [m/s^2]
    double amplification = 1.0;                 ///< mean acceleration of the mass over the ground's [-]
    std::optional<double> joint_peak = {};      ///< of a lift: largest acceleration at the joint, horizontal [m/s^2]
    double slip_factor = 1.0;                   ///< acceleration of the slip over the ground's above a_y [-]
    std::vector<PlaneSlip> slips = {};          ///< record after record, both polarities
    bool stands = true;                         ///< its blocks press on each other and on the plane at the yield

    /// The slip that decides; null: no records.
    const PlaneSlip* worst() const;
};

/// Factor over the required one, the least of all states; a state without a requirement counts as required 1.
double margin(const PlaneRow& row, const std::vector<PlaneState>& states);

struct Planes {
    std::vector<PlaneState> states; ///< the static one, then the seismic one where there is any
    std::vector<PlaneRow> rows;     ///< the base, lifts from the bottom up, seams; empty: the scene has neither
    std::vector<sliding::LiftPlane> lifts;
    std::vector<sliding::SeamPlane> seams;
    std::vector<SeamWork> works; ///< of seams that slide as body and wedge
    std::size_t by_factor = 0, by_yield = 0, by_slip = 0; ///< rows that govern
    std::vector<std::string> warnings;
};

/// The row that planes.governs asks for.
const PlaneRow& governing(const Planes& planes, PlaneJudgement by);

/// Of one plane: its factors where they are asked for, and its slips. PASS only where its blocks stand.
Verdict judge(const PlaneRow& row, const Planes& planes, const Scene& scene);

/// The worst verdict of lifts and seams; none: there are none, or nothing to judge them by.
Verdict judge(const Planes& planes, const Scene& scene);

/// @param combinations  of the base, which say the states, what is required in them and the base's factors
/// @param base  the rigid model of the base @param slips  of the base
Planes find_planes(const Ready& ready, const std::vector<sliding::Equilibrium>& combinations, const RigidModel& base,
                   std::vector<PlaneSlip> slips, int jobs);

} // namespace damslip
