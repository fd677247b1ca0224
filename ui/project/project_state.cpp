#include "ui/project/project_state.h"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace marsview {

Project wholeProject(const ProjectState& state)
{
    Project project = state.project;
    project.annotations.reserve(state.annotations.size());
    for (const AnnotationItem& item : state.annotations) {
        if (!item.isComplete()) {
            continue;
        }
        const auto layer = std::find(state.layers.begin(), state.layers.end(), item.layer);
        project.annotations.push_back(
            {.annotation = annotationOf(item),
             .layer = layer != state.layers.end()
                          ? std::optional(static_cast<std::size_t>(layer - state.layers.begin()))
                          : std::nullopt});
    }
    return project;
}

} // namespace marsview
