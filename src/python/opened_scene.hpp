#pragma once

#include "core/file.hpp"
#include "scene/read.hpp"
#include "scene/scene_text.hpp"

#include <memory>
#include <string>
#include <vector>

namespace damslip::python {

/// A scene file, or text, that was read once, with the keys that were set since; checked.
struct OpenedScene {
    std::shared_ptr<const SceneText> text;
    std::shared_ptr<const std::string> written; ///< what the text was read from
    std::vector<KeyChange> changes;
    Scene scene;

    /// With keys set; what is wrong names the key.
    OpenedScene(std::shared_ptr<const SceneText> read, std::shared_ptr<const std::string> from,
                std::vector<KeyChange> set)
        : text(std::move(read)), written(std::move(from)), changes(std::move(set)), scene(text->with(changes))
    {
    }
    /// As the file is; what is wrong names its line, which a SceneText does not keep.
    explicit OpenedScene(const std::filesystem::path& file) : scene(read_scene(file))
    {
        written = std::make_shared<std::string>(read_file(file, 4u << 20));
        text = std::make_shared<SceneText>(*written, file);
    }
};

} // namespace damslip::python
