#pragma once

#include "analysis/prepare/records.hpp"
#include "analysis/prepare/seepage_source.hpp"
#include "fe2d/run/earthquake_run.hpp"

namespace damslip {

/// What a contact run of this scene takes from the other modules: added mass, uplift before and after the earthquake
/// (curtain ruptured, drains ineffective), and modified Rayleigh damping by the first record's horizontal component.
fe2d::RunOptions contact_options(const Scene& scene, const std::vector<RecordPair>& records, SeepageSource& seepage);

} // namespace damslip
