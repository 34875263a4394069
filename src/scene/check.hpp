#pragma once

#include "scene/findings.hpp"
#include "scene/key_table.hpp"
#include "scene/read.hpp"

namespace damslip {

/// Turns what [section] says into the polygon. Problems go to `findings`.
Section make_section(const SectionInput& input, Findings& findings);

/// Defaults that depend on other keys: levels, lengths, uplift model.
void fill_defaults(Scene& scene, const Findings& findings);

/// Checks that involve more than one key; each names all keys and values concerned.
void check_consistency(const Scene& scene, Findings& findings, FileCheck files);

/// Notes values that are allowed but unusual beside others: a level above the crest, a tailwater above the reservoir.
void note_unusual(const Scene& scene, Findings& findings);

} // namespace damslip
