// The project of a window at one moment, for the threads that write it.
#pragma once

#include "core/session/project.h"
#include "ui/controllers/annotation_controller.h"

#include <filesystem>
#include <vector>

namespace marsview {

/// A value that is cheap to copy, whatever the number of annotations. Any thread may read it. Only
/// the GUI thread may release it, because that thread edits unshared blocks of items in place.
struct ProjectState {
    Project project;                      // without its annotations
    std::vector<LayerId> layers;          // those of the project
    ItemList<AnnotationItem> annotations; // of these layers
    std::filesystem::path file;           // of the project; empty if it was never saved
};

/// With the annotations that have all the points they need. Takes a second for a million.
Project wholeProject(const ProjectState& state);

} // namespace marsview
