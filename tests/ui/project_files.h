// Project files that tests save and open.
#pragma once

#include "tests/ui/timeout.h"
#include "ui/project/project_controller.h"

#include <QTest>

#include <memory>

namespace marsview {

/// Waits until the project file is written; false if it cannot be.
inline bool saveProject(ProjectController& project, const QString& file)
{
    const auto is_saved = std::make_shared<bool>(false);
    project.saveAs(file, [is_saved] { *is_saved = true; });
    return QTest::qWaitFor([&] { return !project.isSaving(); }, kTimeout) && *is_saved;
}

/// Waits until the project file is read and opened; false if it cannot be.
inline bool openProject(ProjectController& project, const QString& file)
{
    const auto is_open = std::make_shared<bool>(false);
    project.read(file, [&project, is_open](const ReadProject& read) {
        project.open(read);
        *is_open = true;
    });
    return QTest::qWaitFor([&] { return !project.isReading(); }, kTimeout) && *is_open;
}

} // namespace marsview
