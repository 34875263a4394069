#pragma once

#include "analysis/fe/contact_runs.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/model/model.hpp"
#include "pages/report/answer.hpp"

#include <string>
#include <vector>

/// The effect plan of a scene and what it costs, as object and text.
namespace damslip::pages {

struct Explained {
    const Scene& given; ///< as read
    std::string method; ///< "rigid" or "fe"
    EffectPlan plan;
    std::optional<fe2d::Model> model;      ///< of an FE run
    std::optional<fe2d::FluidModel> water; ///< acoustic
    std::optional<ContactCost> cost;       ///< of an FE run
    std::vector<std::string> notes;
    std::vector<LiftJoint> lift_joints = {}; ///< of the model
};

Answer explain_answer(const Explained& in);

} // namespace damslip::pages
