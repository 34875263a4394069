#pragma once

#include "fe2d/assembly/assemble.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/model/model.hpp"
#include "records/record.hpp"

#include <string>
#include <vector>

/// The model of a scene as an input deck of CalculiX (ccx 2.20, Dhondt 2004, The finite element method for
/// three-dimensional thermomechanical applications), so that a second solver can compute it.
///
/// The elements are CPE8 and CPE6, plane strain of 1 m; units N, m, kg, s. The mesh has to be of "q8". An edge that is
/// linear here gets a node in its middle that an equation holds between its corners, which leaves the element that it is
/// here. Nodes keep their numbers, plus one; of nodes that share their unknowns the first is written.
namespace damslip::fe2d {

/// What all decks hold.
struct CalculixModel {
    const Model& model;
    std::vector<AddedMassPoint> water; ///< of model.added_mass: point masses tied to the face's normal motion
    std::string title;
};

/// Elements of this model that the deck has no counterpart for; empty: none.
std::string not_for_calculix(const Model& model);

/// Natural modes. @param model  tied
std::string calculix_modes_deck(const CalculixModel& model, int count);

/// A tied earthquake by superposition of modes, exact for ground accelerations linear between samples, printing the
/// displacement of the crest's upstream end, relative to the ground, without static loads.
struct CalculixEarthquake {
    GroundMotion motion;       ///< a_h positive upstream, a_v positive up [m/s^2]
    RayleighConstants damping; ///< C = a_M M + b_K K; the added mass is in this M
    int modes = 60;            ///< superposed
    double free_vibration = 0; ///< after the motion [s]
};
std::string calculix_tied_deck(const CalculixModel& model, const CalculixEarthquake& earthquake);

/// One static stage, all loads up to it.
struct CalculixStage {
    std::string name;
    Eigen::VectorXd load; ///< on the unknowns, without the weight of the dam [N/m]
};

/// The static stages of a dam that stands on its base by contact: surface to surface, pressure proportional to overlap.
struct CalculixContact {
    double gravity = 0.0;                                 ///< of the dam, from the first stage on [m/s^2]
    double friction = 0.0;                                ///< Coulomb mu [-]
    double normal_stiffness = 0.0, stick_stiffness = 0.0; ///< [Pa/m]
    std::vector<CalculixStage> stages;
};
/// @param model  with Base::separate, on rock
std::string calculix_contact_deck(const CalculixModel& model, const CalculixContact& contact);

} // namespace damslip::fe2d
