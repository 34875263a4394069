#include "sliding/equilibrium/limit_equilibrium.hpp"

namespace damslip::sliding {

const char* word(CombinationKind kind)
{
    switch (kind) {
    case CombinationKind::usual:
        return "usual";
    case CombinationKind::unusual:
        return "unusual";
    case CombinationKind::extreme:
        return "extreme";
    case CombinationKind::post_seismic:
        return "post-seismic";
    }
    return "";
}

const char* word(ResultantZone zone)
{
    switch (zone) {
    case ResultantZone::kern:
        return "kern";
    case ResultantZone::middle_half:
        return "middle-half";
    case ResultantZone::base:
        return "base";
    case ResultantZone::outside:
        return "outside";
    }
    return "";
}

const char* word(CrackRule rule)
{
    switch (rule) {
    case CrackRule::none:
        return "none";
    case CrackRule::fixed_static:
        return "static";
    case CrackRule::seismic_zero:
        return "seismic-zero";
    case CrackRule::seismic_unchanged:
        return "seismic-unchanged";
    case CrackRule::seismic_full:
        return "seismic-full";
    }
    return "";
}

const char* word(CrackStatus status)
{
    switch (status) {
    case CrackStatus::closed:
        return "closed";
    case CrackStatus::partial:
        return "partial";
    case CrackStatus::through:
        return "cracked through";
    case CrackStatus::open:
        return "open";
    }
    return "";
}

const char* word(Verdict verdict)
{
    switch (verdict) {
    case Verdict::pass:
        return "PASS";
    case Verdict::fail:
        return "FAIL";
    case Verdict::no_criterion:
        return "no criterion";
    }
    return "";
}

} // namespace damslip::sliding
