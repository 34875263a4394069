#include "sliding/planes/yield_scan.hpp"

/// A function compiled twice, the processor chooses: four numbers at a time in place of two, nothing fused, the same bits. Not with
/// checkers: the choice runs before they are set up.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define DAMSLIP_SIDE_BY_SIDE __attribute__((target_clones("avx2", "default")))
#define DAMSLIP_NO_OVERLAP _Pragma("GCC ivdep") ///< no vector of the loop overlaps one that it writes
#else
#define DAMSLIP_SIDE_BY_SIDE
#define DAMSLIP_NO_OVERLAP
#endif

namespace damslip::sliding {

void YieldScan::add(const Chain& chain, const ChainLaw& law)
{
    blocks_.resize(chain.blocks.size());
    faces_.resize(chain.interfaces.size());
    dam_ = chain.dam;
    open_.push_back(law.path_locked ? 0.0 : 1.0);
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        const ChainBlock& b = chain.blocks[i];
        const ChainLaw::BlockDirections& of = law.of_blocks[i];
        const Point on_it{b.force.x, b.force.y - b.mass * chain.gravity};
        blocks_[i].along.add(of.along);
        blocks_[i].normal.add(of.normal);
        blocks_[i].inertia.add({b.mass + b.added_mass.xx, b.added_mass.xy});
        blocks_[i].load.add({on_it.x + b.uplift * of.normal.x, on_it.y + b.uplift * of.normal.y});
        blocks_[i].length.push_back(b.length);
    }
    for (std::size_t j = 0; j < faces_.size(); ++j) {
        const ChainInterface& face = chain.interfaces[j];
        const ChainLaw::FaceDirections& of = law.of_faces[j];
        faces_[j].up.add(of.up);
        faces_[j].downstream.add(of.downstream);
        faces_[j].water.add({face.water * of.downstream.x, face.water * of.downstream.y});
        faces_[j].sense.push_back(law.senses[j]);
        faces_[j].length.push_back(face.length);
    }
}

DAMSLIP_SIDE_BY_SIDE std::vector<double> YieldScan::yields(const Chain& strengths) const
{
    const std::size_t count = open_.size();
    std::vector<double> open = open_, drive(count), constant(count), unit(count);
    std::vector<Points> weights(blocks_.size()); // not yet scaled to that of the dam's block
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const Block& block = blocks_[b];
        const double friction = strengths.blocks[b].friction;
        Points& w = weights[b];
        w.x.resize(count), w.y.resize(count);
        DAMSLIP_NO_OVERLAP
        for (std::size_t i = 0; i < count; ++i) {
            w.x[i] = block.along.x[i] + friction * block.normal.x[i];
            w.y[i] = block.along.y[i] + friction * block.normal.y[i];
        }
        if (b == 0) continue;
        const Face& face = faces_[b - 1];
        const Points& last = weights[b - 1];
        const double of_face = strengths.interfaces[b - 1].friction;
        DAMSLIP_NO_OVERLAP
        for (std::size_t i = 0; i < count; ++i) {
            const double rubs = -face.sense[i] * of_face;
            const Point z{face.downstream.x[i] + rubs * face.up.x[i], face.downstream.y[i] + rubs * face.up.y[i]};
            const double here = w.x[i] * z.x + w.y[i] * z.y, before = last.x[i] * z.x + last.y[i] * z.y, scale = before / here;
            open[i] = here > 0.0 && before > 0.0 ? open[i] : 0.0;
            w.x[i] *= scale;
            w.y[i] *= scale;
        }
    }
    const Points &of_dam = weights[dam_], &along_dam = blocks_[dam_].along;
    for (std::size_t i = 0; i < count; ++i) unit[i] = 1.0 / (of_dam.x[i] * along_dam.x[i] + of_dam.y[i] * along_dam.y[i]);
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const Block& block = blocks_[b];
        const double cohesion = strengths.blocks[b].cohesion;
        Points& w = weights[b];
        DAMSLIP_NO_OVERLAP
        for (std::size_t i = 0; i < count; ++i) {
            w.x[i] *= unit[i];
            w.y[i] *= unit[i];
            const double bond = -cohesion * block.length[i];
            drive[i] += w.x[i] * block.inertia.x[i] + w.y[i] * block.inertia.y[i];
            constant[i] += w.x[i] * (block.load.x[i] + bond * block.along.x[i]) + w.y[i] * (block.load.y[i] + bond * block.along.y[i]);
        }
    }
    for (std::size_t j = 0; j < faces_.size(); ++j) {
        const Face& face = faces_[j];
        const double cohesion = strengths.interfaces[j].cohesion;
        const Points &before = weights[j], &after = weights[j + 1];
        DAMSLIP_NO_OVERLAP
        for (std::size_t i = 0; i < count; ++i) {
            const double bond = -face.sense[i] * cohesion * face.length[i];
            constant[i] += (after.x[i] - before.x[i]) * (face.water.x[i] + bond * face.up.x[i]) +
                           (after.y[i] - before.y[i]) * (face.water.y[i] + bond * face.up.y[i]);
        }
    }
    constexpr double locked = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count; ++i) constant[i] = open[i] > 0.0 && drive[i] > 0.0 ? -constant[i] / drive[i] : locked;
    return constant;
}

} // namespace damslip::sliding
