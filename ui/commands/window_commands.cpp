#include "ui/commands/window_commands.h"

#include "ui/canvas/terrain_view.h"
#include "ui/commands/picture_saver.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/controllers/session_controller.h"
#include "ui/globe/globe_view.h"
#include "ui/overlay/map_labels.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/measure_marks.h"
#include "ui/panels/georeferencing_panel.h"
#include "ui/panels/haptics_panel.h"
#include "ui/panels/layer_model.h"
#include "ui/panels/layers_panel.h"
#include "ui/panels/measure_panel.h"
#include "ui/text/number_text.h"
#include "ui/window/main_tool_bar.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"
#include "ui/window/window_messages.h"
#include "ui/window/window_options.h"

#include <QAction>
#include <QFileInfo>
#include <QLocale>
#include <QMainWindow>
#include <QMenu>
#include <QObject>

namespace marsview {
namespace {

NoticeCommands noticeCommandsOf(const WindowParts& parts)
{
    return {
        .show_fact =
            [&docks = parts.docks, &panel = parts.georeferencing, &view = parts.view,
             &globe = parts.globe](const QString& notice) {
                // A click does not take the focus from the map, whose keys stay in effect.
                const bool is_on_map = view.hasFocus() || globe.hasFocus();
                docks.reveal(*docks.georeferencing());
                panel.showNotice(notice, is_on_map ? GeoreferencingPanel::NoticeFocus::Leave
                                                   : GeoreferencingPanel::NoticeFocus::Take);
            },
        .set_georeferencing = [&edit = *parts.actions.override_georeferencing] { edit.trigger(); },
        .show_haptics = [&docks = parts.docks] { docks.reveal(*docks.haptics()); },
        .save_diagnostic_log = [&panel = parts.haptics_panel] { panel.chooseFlightRecord(); }};
}

} // namespace

WindowCommands::WindowCommands(const WindowParts& parts, const WindowOptions& options)
    : project(parts.session,
              parts.measuring,
              parts.annotating,
              parts.view,
              file_work,
              {.bundled = options.bundled_maps, .autosave_folder = options.autosave_folder})
    , project_menu({.window = parts.window,
                    .file_menu = *parts.actions.file,
                    .session = parts.session,
                    .project = project,
                    .notices = parts.notices,
                    .memory = options.isRemembered() ? RecentFiles::Memory::Settings
                                                     : RecentFiles::Memory::WindowOnly,
                    .has_questions = options.questions == WindowOptions::Questions::Ask,
                    .bundled_maps = QString::fromStdString(options.bundled_maps.string())})
    , contours({.window = parts.window,
                .session = parts.session,
                .scenes = parts.scenes,
                .interval = *parts.actions.contour_interval,
                .export_contours = *parts.actions.export_contours})
    , vector_files({.window = parts.window,
                    .session = parts.session,
                    .view = parts.view,
                    .notices = parts.notices,
                    .work = file_work,
                    .open = *parts.actions.open_vector,
                    .files = *parts.actions.vector_files,
                    .list = *parts.layers.vectorFiles()})
    , names({.window = parts.window,
             .view = parts.view,
             .globe = parts.globe,
             .overlays = parts.overlays,
             .field = parts.tool_bar.searchField(),
             .open_names = *parts.actions.open_names,
             .is_remembered = options.isRemembered()})
    , preferences({.window = parts.window,
                   .actions = parts.actions,
                   .session = parts.session,
                   .view = parts.view,
                   .globe = parts.globe,
                   .overlays = parts.overlays,
                   .haptics = parts.haptics,
                   .readout = parts.readout,
                   .layers = parts.layers,
                   .georeferencing = parts.georeferencing,
                   .light = parts.light,
                   .measure_panel = parts.measure_panel,
                   .measure_marks = parts.measure_marks,
                   .stretch = parts.stretch,
                   .opener = options.opener,
                   .is_remembered = options.isRemembered()})
    , files({.window = parts.window,
             .actions = parts.actions,
             .session = parts.session,
             .projects = project_menu,
             .vector_files = vector_files,
             .is_remembered = options.isRemembered(),
             .bundled_maps = QString::fromStdString(options.bundled_maps.string())})
    , view({.window = parts.window,
            .actions = parts.actions,
            .view = parts.view,
            .globe = parts.globe,
            .docks = parts.docks,
            .messages = parts.messages})
    , layers({.actions = parts.actions,
              .session = parts.session,
              .docks = parts.docks,
              .layers = parts.layers,
              .georeferencing = parts.georeferencing,
              .tool_bar = parts.tool_bar})
    , views({.session = parts.session,
             .view = parts.view,
             .scenes = parts.scenes,
             .panel = parts.views_panel,
             .menu = *parts.actions.view_menu,
             .before = parts.actions.coordinate_format->menuAction(),
             .names = [this] { return names.namesOnMap(); },
             .format = [this] { return preferences.preferences().coordinates; },
             .globe = {.camera = [this] { return scene.globeCamera(); },
                       .fly = [this](const ViewCamera& camera) { scene.flyOnGlobeTo(camera); },
                       .leave = [this] { scene.choose(SceneChoice::Flat); }},
             .reveal_panel = [&docks = parts.docks] { docks.reveal(*docks.views()); }})
    , fly_through({.window = parts.window,
                   .session = parts.session,
                   .scenes = parts.scenes,
                   .measuring = parts.measuring,
                   .open = *views.actions().fly_through})
    , reports(
          {.window = parts.window,
           .menu = *parts.actions.file,
           .after = parts.actions.save_picture,
           .view = parts.view,
           .scenes = parts.scenes,
           .measuring = parts.measuring,
           .annotating = parts.annotating,
           .project = [this] { return project.file(); },
           .session = [&session = parts.session]() -> const Session& { return session.session(); },
           .unit = [this] { return preferences.preferences().height_unit; },
           .format = [this] { return preferences.preferences().coordinates; }})
    , progress({.actions = parts.actions,
                .session = parts.session,
                .view = parts.view,
                .scenes = parts.scenes,
                .pictures = parts.pictures,
                .recordings = fly_through.recorder(),
                .reports = reports,
                .files = file_work,
                .status = parts.load_status,
                .messages = parts.messages})
    , places({.window = parts.window,
              .actions = parts.actions,
              .session = parts.session,
              .view = parts.view,
              .globe = parts.globe,
              .overlays = parts.overlays,
              .readout = parts.readout,
              .tool_bar = parts.tool_bar,
              .names = names,
              .measuring = parts.measuring,
              .annotating = parts.annotating,
              .vector_files = vector_files,
              .preferences = preferences})
    , measuring({.actions = parts.actions,
                 .measuring = parts.measuring,
                 .view = parts.view,
                 .docks = parts.docks,
                 .panel = parts.measure_panel,
                 .messages = parts.messages})
    , annotating({.window = parts.window,
                  .actions = parts.actions,
                  .annotating = parts.annotating,
                  .panel = parts.annotation_panel,
                  .view = parts.view,
                  .docks = parts.docks,
                  .work = file_work})
    , haptics({.actions = parts.actions,
               .session = parts.session,
               .haptics = parts.haptics,
               .panel = parts.haptics_panel,
               .docks = parts.docks,
               .messages = parts.messages,
               .is_remembered = options.isRemembered()})
    , notices({.center = parts.notices,
               .session = parts.session,
               .view = parts.view,
               .haptics = parts.haptics,
               .globe = *parts.actions.globe,
               .fetched_tiles = options.opener.resources.fetched_tiles},
              noticeCommandsOf(parts))
    , sound({.action = *parts.actions.contact_sound,
             .haptics = parts.haptics,
             .messages = parts.messages,
             .open_sound = options.open_sound,
             .is_remembered = options.isRemembered()})
    , spacemouse({{.widget = parts.view, .view = parts.view},
                  {.widget = parts.globe, .view = parts.globe}},
                 options.spacemouse)
    , help(parts.window, parts.view, parts.actions)
    , scene({.actions = parts.actions,
             .view = parts.view,
             .globe = parts.globe,
             .session = parts.session,
             .haptics = parts.haptics,
             .readout = parts.readout,
             .messages = parts.messages,
             .measuring = parts.measuring,
             .annotating = parts.annotating,
             .vector_files = vector_files.overlays(),
             .layer_list = parts.layers.findChild<LayerModel*>()})
    , light({.actions = parts.actions,
             .session = parts.session,
             .globe = parts.globe,
             .scene = scene,
             .tool_bar = parts.tool_bar,
             .popup = parts.light})
{
    scene.choose(options.scene);
    project.setScene({.choice = [this] { return scene.choice(); },
                      .globe_camera = [this] { return scene.globeCamera(); },
                      .show =
                          [this](SceneChoice choice, const std::optional<ViewCamera>& camera) {
                              scene.choose(choice);
                              if (camera && scene.isGlobeShown()) {
                                  scene.showGlobeFrom(*camera);
                              }
                          }});
    showMessages(parts.messages);
    showNames(parts.overlays);
    keepUsedSample(parts);
}

// The sample that the program starts with makes way for the user's maps, but not once it carries
// the user's work.
void WindowCommands::keepUsedSample(const WindowParts& parts)
{
    SessionController* const session = &parts.session;
    const auto keep_with_items = [session](const auto& drawing) {
        QObject::connect(&drawing, &DrawingBase::changed, session, [session, &drawing] {
            if (!drawing.state().items.empty()) {
                session->adoptSample();
            }
        });
    };
    keep_with_items(parts.measuring);
    keep_with_items(parts.annotating);
    QObject::connect(&project, &ProjectController::saved, session,
                     [session] { session->adoptSample(); });
}

void WindowCommands::showMessages(WindowMessages& messages)
{
    const auto report_as = [&messages](const QString& title) {
        return [&messages, title](const QString& problem) { messages.report(title, problem); };
    };
    QObject::connect(&files, &FileOpening::requested, &messages, &WindowMessages::forgetFailures);
    QObject::connect(&project_menu, &ProjectMenu::requested, &messages,
                     &WindowMessages::forgetFailures);
    QObject::connect(&project, &ProjectController::written, &messages,
                     [&messages](const QStringList& written) {
                         QStringList shown;
                         for (const QString& file : written) {
                             shown.append(isolated(QFileInfo(file).fileName()));
                         }
                         //: In the status bar, for a few seconds; %1 is a list of files
                         messages.show(tr("Saved %1").arg(QLocale().createSeparatedList(shown)));
                     });
    QObject::connect(&project, &ProjectController::failed, &messages, report_as(tr("Project")));
    QObject::connect(&contours, &ContourTools::exported, &messages, &WindowMessages::showSaved);
    QObject::connect(&contours, &ContourTools::failed, &messages,
                     report_as(tr("Cannot Export Contours")));
    QObject::connect(&vector_files, &VectorTools::opened, &messages, &WindowMessages::show);
    QObject::connect(&vector_files, &VectorTools::failed, &messages,
                     report_as(tr("Cannot Open Vector File")));
    QObject::connect(&annotating, &AnnotationCommands::imported, &messages, &WindowMessages::show);
    QObject::connect(&annotating, &AnnotationCommands::exported, &messages,
                     &WindowMessages::showSaved);
    QObject::connect(&annotating, &AnnotationCommands::failed, &messages,
                     report_as(tr("Annotations")));
    QObject::connect(&views, &SavedViews::reported, &messages, &WindowMessages::show);
    QObject::connect(&names, &NameSearch::opened, &messages, &WindowMessages::show);
    QObject::connect(&names, &NameSearch::failed, &messages, report_as(tr("Cannot Open Names")));
    QObject::connect(&spacemouse, &SpaceMouseController::connected, &messages,
                     [&messages](const QString& name) {
                         //: In the status bar, for a few seconds; %1 is a device
                         messages.show(tr("%1 moves the camera").arg(name));
                     });
    QObject::connect(&spacemouse, &SpaceMouseController::disconnected, &messages,
                     [&messages](const QString& name) {
                         //: In the status bar, for a few seconds; %1 is a device
                         messages.show(tr("%1 was unplugged").arg(name));
                     });
}

void WindowCommands::showNames(MapOverlays& overlays)
{
    const auto show = [this, &overlays] { overlays.labels()->setNames(names.namesOnMap().names); };
    QObject::connect(&names, &NameSearch::changed, &names, show);
    show();
}

} // namespace marsview
