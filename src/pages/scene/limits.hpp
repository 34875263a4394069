#pragma once

#include "pages/report/page.hpp"
#include "scene/effect_plan.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

/// What the numbers of a report hold for, and parts that several reports share.
namespace damslip::pages {

/// "Limits of validity": what each model of the method leaves out, for this scene.
/// @param method  finite elements: the rigid block's rows, too, as it stands beside them
Section limits_section(const Scene& scene, Method method);

/// "Limit equilibrium": the checks of all load combinations as one matrix, their quantities, and the loads of each, folded.
Section equilibrium_section(const std::vector<sliding::Equilibrium>& combinations);

/// The table of records with what its measures mean.
TablePart record_part(Table table);

/// The plan of effects with how it is to be read.
TablePart effect_part(const EffectPlan& plan);

} // namespace damslip::pages
