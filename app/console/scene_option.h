// The option --scene, which several commands take.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace marsview {

/// Where maps lie.
enum class SceneKind {
    Flat,
    Body,
};

/// Adds "--scene flat|body", flat unless given; the parser fills `scene`. `remark` is appended to
/// the help text.
void addSceneOption(CLI::App& command, SceneKind& scene, const std::string& remark = {});

/// The word for it on the command line and in JSON.
std::string sceneName(SceneKind scene);

} // namespace marsview
