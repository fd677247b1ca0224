// Everything that the menus and panels of a window do, one member a feature.
#pragma once

#include "ui/commands/annotation_commands.h"
#include "ui/commands/contour_tools.h"
#include "ui/commands/file_opening.h"
#include "ui/commands/haptics_commands.h"
#include "ui/commands/help_commands.h"
#include "ui/commands/layer_commands.h"
#include "ui/commands/light_commands.h"
#include "ui/commands/measure_commands.h"
#include "ui/commands/name_search.h"
#include "ui/commands/place_commands.h"
#include "ui/commands/preference_commands.h"
#include "ui/commands/scene_commands.h"
#include "ui/commands/sound_command.h"
#include "ui/commands/vector_tools.h"
#include "ui/commands/view_commands.h"
#include "ui/commands/work_progress.h"
#include "ui/controllers/file_work.h"
#include "ui/controllers/spacemouse_controller.h"
#include "ui/project/project_controller.h"
#include "ui/project/project_menu.h"
#include "ui/report/report_exporter.h"
#include "ui/views/fly_through_tools.h"
#include "ui/views/saved_views.h"
#include "ui/window/window_notices.h"

#include <QCoreApplication>

namespace marsview {

class AnnotationMarks;
class GlobeView;
class NoticeCenter;
class PictureSaver;
struct WindowOptions;

/// The parts of a window that its features join.
struct WindowParts {
    QMainWindow& window;
    WindowActions& actions;
    WindowMessages& messages;
    NoticeCenter& notices;
    SessionController& session;
    TerrainView& view;
    GlobeView& globe;
    MapOverlays& overlays;
    HapticsController& haptics;
    MeasureController& measuring;
    AnnotationController& annotating;
    MeasureMarks& measure_marks;
    AnnotationMarks& annotation_marks;
    PictureSaver& pictures;
    PictureScenes scenes;
    StretchControl& stretch;
    WindowDocks& docks;
    LayersPanel& layers;
    GeoreferencingPanel& georeferencing;
    HapticsPanel& haptics_panel;
    MeasurePanel& measure_panel;
    AnnotationPanel& annotation_panel;
    SavedViewsPanel& views_panel;
    MainToolBar& tool_bar;
    LightPopup& light;
    StatusReadout& readout;
    LoadStatus& load_status;
};

/// To add a feature: write its unit next to the others, with a struct of the parts it needs, and
/// add a member here. Must not outlive the parts.
struct WindowCommands {
    Q_DECLARE_TR_FUNCTIONS(WindowCommands)

public:
    WindowCommands(const WindowParts& parts, const WindowOptions& options);

    FileWork file_work;
    ProjectController project;
    ProjectMenu project_menu;
    ContourTools contours;
    VectorTools vector_files;
    NameSearch names;
    PreferenceCommands preferences;
    FileOpening files;
    ViewCommands view;
    LayerCommands layers;
    SavedViews views;
    FlyThroughTools fly_through;
    ReportExporter reports;
    WorkProgress progress;
    PlaceCommands places;
    MeasureCommands measuring;
    AnnotationCommands annotating;
    HapticsCommands haptics;
    WindowNotices notices;
    SoundCommand sound;
    SpaceMouseController spacemouse;
    HelpCommands help;
    SceneCommands scene;
    LightCommands light;

private:
    void showMessages(WindowMessages& messages);
    void showNames(MapOverlays& overlays);
    void keepUsedSample(const WindowParts& parts);
};

} // namespace marsview
