#pragma once

#include "scene/read.hpp"
#include "scene/scene_text.hpp"

#include <memory>
#include <vector>

namespace damslip::python {

/// A scene file, or text, that was read once, with the keys that were set since; checked.
struct OpenedScene {
    std::shared_ptr<const SceneText> text;
    std::vector<KeyChange> changes;
    Scene scene;

    /// With keys set; what is wrong names the key.
    OpenedScene(std::shared_ptr<const SceneText> read, std::vector<KeyChange> set)
        : text(std::move(read)), changes(std::move(set)), scene(text->with(changes))
    {
    }
    /// As the file is; what is wrong names its line, which a SceneText does not keep.
    explicit OpenedScene(const std::filesystem::path& file) : scene(read_scene(file))
    {
        text = std::make_shared<SceneText>(SceneText::read(file));
    }
};

} // namespace damslip::python
