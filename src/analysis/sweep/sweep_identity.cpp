#include "analysis/sweep/sweep_identity.hpp"

#include "core/file.hpp"
#include "core/number.hpp"
#include "core/version.hpp"
#include "scene/write.hpp"

#include <fmt/format.h>

namespace damslip {

SweepIdentity sweep_identity(const Sweep& inputs)
{
    const Scene& scene = inputs.scene;
    SweepIdentity identity;
    identity.version = program_version();
    identity.scene = scene_hash(scene);
    std::string contents;
    for (const RecordFiles& files : scene.motion.records) {
        contents += sha256(read_file(files.horizontal)) + "\n";
        contents += (files.vertical ? sha256(read_file(*files.vertical)) : "none") + "\n";
    }
    if (scene.mesh.file) contents += sha256(read_file(*scene.mesh.file)) + "\n";
    identity.records = sha256(contents);
    identity.grid = text_of(inputs.axes);
    if (inputs.modes) identity.grid += fmt::format("; modes {}", *inputs.modes);
    if (inputs.truncation_error) identity.grid += "; truncation error";
    if (inputs.penalty_stiffness) identity.grid += "; penalty stiffness " + shortest(*inputs.penalty_stiffness);
    identity.rows = inputs.tasks.rows();
    return identity;
}

std::string hash_of(const SweepIdentity& identity)
{
    return sha256(fmt::format("{}\n{}\n{}\n{}\n{}\n", identity.version, identity.scene, identity.records, identity.grid,
                              identity.rows));
}

std::vector<std::string> csv_comments(const SweepIdentity& identity)
{
    return {"damslip " + identity.version + " sweep", "scene " + identity.scene,
            "sweep " + hash_of(identity) + fmt::format(", {} rows", identity.rows)};
}

} // namespace damslip
