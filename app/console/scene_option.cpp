#include "app/console/scene_option.h"

#include "app/console/number_checks.h"

#include <CLI/CLI.hpp>

namespace marsview {

void addSceneOption(CLI::App& command, SceneKind& scene, const std::string& remark)
{
    const std::string body = sceneName(SceneKind::Body);
    command
        .add_option_function<std::string>(
            "--scene",
            [&scene, body](const std::string& name) {
                scene = name == body ? SceneKind::Body : SceneKind::Flat;
            },
            "flat: the map's CRS laid out in the plane; body: the map lies on its body" + remark)
        ->type_name("SCENE")
        ->default_str(sceneName(scene))
        ->check(oneOf({sceneName(SceneKind::Flat), body}));
}

std::string sceneName(SceneKind scene)
{
    return scene == SceneKind::Body ? "body" : "flat";
}

} // namespace marsview
