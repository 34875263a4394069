#include "fe2d/model/model_counts.hpp"

namespace damslip::fe2d {

void ModelCounts::add(EffectCount effect)
{
    constexpr std::int64_t entry_bytes = sizeof(double) + sizeof(int), vectors = 4;
    effect.bytes =
        entry_bytes * effect.nonzeros + vectors * static_cast<std::int64_t>(sizeof(double)) * effect.unknowns;
    elements += effect.elements;
    unknowns += effect.unknowns;
    nonzeros += effect.nonzeros;
    bytes += effect.bytes;
    effects.push_back(std::move(effect));
}

} // namespace damslip::fe2d
