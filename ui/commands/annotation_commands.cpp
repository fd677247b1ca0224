#include "ui/commands/annotation_commands.h"

#include "core/vector/vector_file.h"
#include "ui/canvas/terrain_view.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/file_work.h"
#include "ui/panels/annotation_list.h"
#include "ui/panels/annotation_panel.h"
#include "ui/text/body_text.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"

#include <QAction>
#include <QActionGroup>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QMainWindow>
#include <QMenu>
#include <QMessageBox>

#include <algorithm>
#include <utility>

namespace marsview {

// Of reading a file.
struct AnnotationCommands::Outcome {
    std::weak_ptr<const Map> map;
    ImportedAnnotations content;
    std::optional<Error> problem;
    std::optional<Crs> likely; // that the file may be meant in, if it is of another body
};

AnnotationCommands::AnnotationCommands(const Parts& parts)
    : parts_(parts)
    , jobs_(*this)
{
    WindowActions& actions = parts_.actions;
    AnnotationController& annotating = parts_.annotating;
    connect(actions.annotation_shapes, &QActionGroup::triggered, this, [this](QAction* action) {
        parts_.annotating.begin(static_cast<FeatureShape>(action->data().toInt()));
        showPanel(); // the tool may have been chosen before
        parts_.view.setFocus();
    });
    connect(&annotating, &AnnotationController::shapeChanged, this,
            [this](FeatureShape shape) { parts_.actions.showShape(parts_.view.tool(), shape); });
    connect(&parts_.view, &TerrainView::toolChanged, this, [this](Tool tool) {
        parts_.actions.showShape(tool, parts_.annotating.shape());
        if (tool == Tool::Annotate) {
            showPanel();
        } else if (parts_.annotating.state().items.empty()) {
            parts_.docks.hideForTool(*parts_.docks.annotations());
        }
    });
    connect(actions.finish_annotation, &QAction::triggered, &annotating,
            [&annotating] { annotating.finish(); });
    connect(actions.remove_annotations, &QAction::triggered, parts_.panel.list(),
            &DrawnList::removeSelected);
    connect(actions.import_annotations, &QAction::triggered, this, &AnnotationCommands::askImport);
    connect(actions.export_annotations, &QAction::triggered, this, &AnnotationCommands::askExport);
    connect(&annotating, &AnnotationController::changed, this, &AnnotationCommands::showState);
    actions.annotate->addAction(parts_.docks.annotations()->toggleViewAction());
    showState();
}

AnnotationCommands::~AnnotationCommands()
{
    parts_.work.cancelOf(*this);
}

void AnnotationCommands::showPanel()
{
    parts_.docks.showForTool(*parts_.docks.annotations());
}

void AnnotationCommands::showState()
{
    const AnnotationItem* item = parts_.annotating.current();
    parts_.actions.finish_annotation->setEnabled(item != nullptr && !item->is_finished);
    parts_.actions.remove_annotations->setEnabled(item != nullptr);
    const bool has_items = !parts_.annotating.state().items.empty();
    parts_.actions.export_annotations->setEnabled(has_items);
    if (has_items) {
        parts_.docks.showRestored(*parts_.docks.annotations());
    }
}

void AnnotationCommands::askImport()
{
    auto* dialog = new QFileDialog(&parts_.window, tr("Import Annotations"), folder_);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    dialog->setNameFilters(
        {tr("Vector files (*.gpkg *.geojson *.json *.kml *.shp *.csv)"), tr("All files (*)")});
    connect(dialog, &QFileDialog::fileSelected, this,
            [this](const QString& file) { importFile(file); });
    dialog->open();
}

void AnnotationCommands::importFile(const QString& file, const std::optional<Crs>& crs)
{
    folder_ = QFileInfo(file).absolutePath();
    const std::shared_ptr<const Map> map = parts_.view.map();
    if (!map) {
        return;
    }
    const auto monitor =
        //: In the status bar: %1 is a file
        parts_.work.begin(*this, tr("Reading %1").arg(QFileInfo(file).fileName()), file);
    jobs_.run([this, path = file.toStdString(), file, crs, map, monitor](const auto& outlet) {
        Outcome outcome{.map = map, .content = {}, .problem = {}, .likely = {}};
        Result<VectorFile> read = readVectorFile(path, *monitor);
        if (!read) {
            outcome.problem = read.error();
        } else {
            if (crs) {
                read->content.crs = crs;
                read->content.body = crs->body();
            }
            auto content = annotationsFrom(path, *read, map->georeference(), map->info().body);
            if (content) {
                outcome.content = std::move(*content);
            } else {
                outcome.problem = content.error();
                outcome.likely = likelyCrs(read->content, map->info().body);
            }
        }
        outlet->post([this, file, monitor, outcome = std::move(outcome)] {
            parts_.work.end(monitor);
            take(file, outcome);
        });
    });
}

void AnnotationCommands::take(const QString& file, const Outcome& outcome)
{
    if (outcome.problem) {
        if (outcome.likely && outcome.map.lock() == parts_.view.map()) {
            askBody(file, outcome);
        } else if (outcome.problem->code != ErrorCode::Canceled) {
            Q_EMIT failed(QString::fromStdString(outcome.problem->message));
        }
        return;
    }
    const std::vector<Annotation>& annotations = outcome.content.annotations;
    const QString name = QFileInfo(file).fileName();
    //: A step of undo; %1 is a file
    parts_.annotating.add(annotations, tr("Import %1").arg(name));
    showPanel();
    QString message =
        annotations.size() == 1
            //: In the status bar; %1 is a file
            ? tr("1 annotation imported from %1").arg(name)
            //: In the status bar; %1 is a number above 1, %2 a file
            : tr("%L1 annotations imported from %2").arg(annotations.size()).arg(name);
    for (const std::string& notice : outcome.content.notices) {
        message += QStringLiteral("; ") + QString::fromStdString(notice);
    }
    Q_EMIT imported(message);
}

// GeoJSON and many exports know only the Earth's longitude and latitude.
void AnnotationCommands::askBody(const QString& file, const Outcome& outcome)
{
    const auto map = outcome.map.lock();
    const QString body = bodyInSentence(*map->info().body);
    auto* question = new QMessageBox(
        QMessageBox::Question, tr("Import Annotations"),
        //: %1 is a file, %2 a body
        tr("%1 states longitude and latitude on the Earth, but the map is of %2. Read them as "
           "longitude and latitude on %2?")
            .arg(QFileInfo(file).fileName(), body),
        QMessageBox::Yes | QMessageBox::No, &parts_.window);
    question->setAttribute(Qt::WA_DeleteOnClose);
    connect(question, &QMessageBox::finished, this,
            [this, file, crs = *outcome.likely,
             problem = QString::fromStdString(outcome.problem->message)](int answer) {
                if (answer == QMessageBox::Yes) {
                    importFile(file, crs);
                } else {
                    Q_EMIT failed(problem);
                }
            });
    question->open();
}

void AnnotationCommands::askExport()
{
    auto* dialog = new QFileDialog(&parts_.window, tr("Export Annotations"), folder_);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setNameFilters({tr("GeoPackage (*.gpkg)"), tr("GeoJSON (*.geojson)"), tr("KML (*.kml)"),
                            tr("Shapefile (*.shp)"), tr("CSV table (*.csv)")});
    dialog->setDefaultSuffix(QStringLiteral("gpkg"));
    dialog->selectFile(tr("annotations") + QStringLiteral(".gpkg"));
    connect(dialog, &QFileDialog::filterSelected, dialog, [dialog](const QString& filter) {
        const qsizetype dot = filter.lastIndexOf(QLatin1Char('.'));
        const QString suffix = filter.mid(dot + 1).chopped(1);
        dialog->setDefaultSuffix(suffix);
        dialog->selectFile(tr("annotations") + QLatin1Char('.') + suffix);
    });
    connect(dialog, &QFileDialog::fileSelected, this, &AnnotationCommands::exportFile);
    dialog->open();
}

void AnnotationCommands::exportFile(const QString& file)
{
    folder_ = QFileInfo(file).absolutePath();
    const std::vector<std::uint32_t> selected = parts_.panel.list()->selectedIds();
    //: In the status bar: %1 is a file
    const auto monitor =
        parts_.work.begin(*this, tr("Writing %1").arg(QFileInfo(file).fileName()), file);
    jobs_.run([this, file,
               annotations = selected.size() > 1 ? parts_.annotating.annotations(selected)
                                                 : parts_.annotating.annotations(),
               monitor](const auto& outlet) {
        const auto written = writeAnnotations(annotations, file.toStdString(), *monitor);
        const std::optional<Error> problem =
            written ? std::nullopt : std::optional(written.error());
        // Shapefiles hold one kind of shape each.
        const bool is_one =
            QFileInfo(file).suffix().compare(QLatin1String("shp"), Qt::CaseInsensitive) != 0 ||
            std::all_of(annotations.begin(), annotations.end(),
                        [&annotations](const Annotation& annotation) {
                            return annotation.shape == annotations.front().shape;
                        });
        outlet->post([this, file, monitor, problem, is_one] {
            parts_.work.end(monitor);
            if (!problem) {
                const QFileInfo one(file);
                Q_EMIT exported(is_one ? file
                                       : one.path() + QLatin1Char('/') + one.completeBaseName() +
                                             QStringLiteral("-*.") + one.suffix());
            } else if (problem->code != ErrorCode::Canceled) {
                Q_EMIT failed(QString::fromStdString(problem->message));
            }
        });
    });
}

} // namespace marsview
