#include "scene/key_parts.hpp"
#include "scene/keys.hpp"

namespace damslip::keys {

KeyGroup project_group()
{
    using P = Project;
    return group("project", "Title block of every report: whose work it is, and which issue of it.", &Scene::project,
                 {word("name", "none", "of the project", "\"Safety review 2026\"", at(&P::name)),
                  word("client", "none", "for whom the work is done", "\"Owner of the dam\"", at(&P::client)),
                  word("author", "none", "who made the assessment", "\"Name of the engineer\"", at(&P::author)),
                  word("checker", "none", "who has checked it", "\"Name of the checker\"", at(&P::checker)),
                  word("date", "none", "of the report, as it is to be read", "\"2026-11-23\"", at(&P::date)),
                  word("revision", "none", "issue of the report", "\"A\"", at(&P::revision)),
                  word("notes", "none", "what the reader has to know first", "\"Level by the survey of 2024.\"",
                       at(&P::notes))});
}

} // namespace damslip::keys
