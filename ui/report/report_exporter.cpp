#include "ui/report/report_exporter.h"

#include "ui/canvas/terrain_view.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/pictures/picture_drawing.h"
#include "ui/report/report_pdf.h"
#include "ui/widgets/icons.h"

#include <QAction>
#include <QCheckBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QLineEdit>
#include <QLocale>
#include <QMenu>
#include <QPainter>
#include <QPushButton>
#include <QSaveFile>
#include <QStandardPaths>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

// 300 dots per inch on a page. As wide as high by 4 to 3: names stay legible.
constexpr QSize kReportPicture{2000, 1500};

QPageSize::PageSizeId paperOfLocale()
{
    return QLocale().measurementSystem() == QLocale::ImperialUSSystem ? QPageSize::Letter
                                                                      : QPageSize::A4;
}

} // namespace

ReportExporter::ReportExporter(const Parts& parts, QObject* parent)
    : QObject(parent)
    , parts_(parts)
    , action_(new QAction(lineIcon(QStringLiteral("report")), tr("E&xport Report…"), this))
{
    action_->setObjectName(QStringLiteral("exportReport"));
    action_->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_E));
    action_->setToolTip(
        tr("Save the map with legend and scale, the measurements and their diagrams as one PDF or "
           "web page"));
    action_->setEnabled(false);
    const QList<QAction*> entries = parts_.menu.actions();
    parts_.menu.insertAction(entries.value(entries.indexOf(parts_.after) + 1), action_);
    connect(action_, &QAction::triggered, this, &ReportExporter::ask);
    connect(&parts_.view, &TerrainView::layersChanged, action_,
            [this] { action_->setEnabled(parts_.view.map() != nullptr); });
}

ReportExporter::~ReportExporter()
{
    delete dialog_; // it asks this object
}

void ReportExporter::ask()
{
    if (!parts_.view.map() || isExporting()) {
        return;
    }
    auto* dialog = new QDialog(&parts_.window);
    dialog_ = dialog;
    dialog->setObjectName(QStringLiteral("reportDialog"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(tr("Export Report"));
    auto* title = new QLineEdit(dialog);
    title->setObjectName(QStringLiteral("title"));
    title->setMinimumWidth(320);
    const auto shown = shownLayers(parts_.session());
    const Layer* active = activeLayer(parts_.session());
    const Layer* named = active != nullptr ? active : shown.empty() ? nullptr : shown.front();
    const QString project = QFileInfo(parts_.project()).completeBaseName();
    title->setText(!project.isEmpty() ? project
                   : named != nullptr
                       ? QFileInfo(QString::fromStdString(named->name)).completeBaseName()
                       //: Title of a report
                       : tr("Map"));
    title->selectAll();
    auto* credit = new QLineEdit(credit_, dialog);
    credit->setObjectName(QStringLiteral("credit"));
    credit->setPlaceholderText(tr("Source of the data, author"));
    auto* measurements = new QCheckBox(tr("&Measurements"), dialog);
    measurements->setObjectName(QStringLiteral("measurements"));
    auto* plots = new QCheckBox(tr("&Diagrams"), dialog);
    plots->setObjectName(QStringLiteral("plots"));
    const bool has_any = !parts_.measuring.state().items.empty();
    for (QCheckBox* box : {measurements, plots}) {
        box->setChecked(has_any);
        box->setEnabled(has_any);
        if (!has_any) {
            box->setToolTip(tr("There are no measurements yet"));
        }
    }
    auto* annotations = new QCheckBox(tr("&Annotations"), dialog);
    annotations->setObjectName(QStringLiteral("annotations"));
    const bool has_annotations = !parts_.annotating.state().items.empty();
    annotations->setChecked(has_annotations);
    annotations->setEnabled(has_annotations);
    if (!has_annotations) {
        annotations->setToolTip(tr("There are no annotations yet"));
    }
    connect(measurements, &QCheckBox::toggled, plots, &QCheckBox::setEnabled);
    auto* form = new QFormLayout;
    form->addRow(tr("&Title"), title);
    form->addRow(tr("&Credit"), credit);
    form->addRow(tr("Include"), measurements);
    form->addRow(QString(), plots);
    form->addRow(QString(), annotations);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, dialog);
    //: On a button: choose a file for the report
    auto* save = buttons->addButton(tr("&Export…"), QDialogButtonBox::AcceptRole);
    save->setDefault(true);
    save->setObjectName(QStringLiteral("export"));
    auto* layout = new QVBoxLayout(dialog);
    layout->addLayout(form);
    layout->addWidget(buttons);
    layout->setSizeConstraint(QLayout::SetFixedSize);
    connect(buttons, &QDialogButtonBox::accepted, dialog, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
    connect(dialog, &QDialog::accepted, this,
            [this, title, credit, measurements, plots, annotations] {
                credit_ = credit->text();
                chooseFile({.title = title->text().trimmed(),
                            .credit = credit_.trimmed(),
                            .has_measurements = measurements->isChecked(),
                            .has_plots = measurements->isChecked() && plots->isChecked(),
                            .has_annotations = annotations->isChecked()});
            });
    dialog->open();
}

void ReportExporter::chooseFile(const ReportChoice& choice)
{
    const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
    const QString project = parts_.project();
    auto* dialog = new QFileDialog(&parts_.window, tr("Export Report"),
                                   !folder_.isEmpty()             ? folder_
                                   : !project.isEmpty()           ? QFileInfo(project).path()
                                   : QFileInfo(documents).isDir() ? documents
                                                                  : QDir::homePath());
    dialog->setObjectName(QStringLiteral("reportFileDialog"));
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setNameFilters({tr("PDF document (*.pdf)"), tr("Web page (*.html)")});
    dialog->setDefaultSuffix(QStringLiteral("pdf"));
    //: The name of a report's file, without its extension
    const QString name = choice.title.isEmpty() ? tr("report") : choice.title;
    dialog->selectFile(QString(name).replace(QLatin1Char('/'), QLatin1Char('-')) +
                       QStringLiteral(".pdf"));
    connect(dialog, &QFileDialog::filterSelected, dialog, [dialog](const QString& filter) {
        const QString suffix = filter.contains(QStringLiteral("html")) ? QStringLiteral("html")
                                                                       : QStringLiteral("pdf");
        dialog->setDefaultSuffix(suffix);
        const QStringList files = dialog->selectedFiles();
        if (!files.isEmpty()) {
            dialog->selectFile(QFileInfo(files.constFirst()).completeBaseName() + QLatin1Char('.') +
                               suffix);
        }
    });
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this,
            [this, choice](const QString& file) { exportTo(file, choice); });
    dialog->open();
}

void ReportExporter::exportTo(const QString& file, const ReportChoice& choice)
{
    if (isExporting() || !parts_.view.map()) {
        return;
    }
    PictureScene& scene = this->scene();
    if (!scene.isReady()) {
        Q_EMIT failed(tr("The map is not ready yet; try again in a moment"));
        return;
    }
    file_ = file;
    const SceneCamera camera = scene.camera();
    report_ = reportOf({.map = scene.facts(kReportPicture),
                        .exaggeration = scene.style().exaggeration,
                        .session = parts_.session(),
                        .measuring = parts_.measuring,
                        .annotating = parts_.annotating,
                        .unit = parts_.unit(),
                        .format = parts_.format()},
                       choice, kReportPicture);
    labels_ = scene.partsFor(camera, kReportPicture, {.has_legend = false, .has_scale = false});
    drawing_ = std::make_unique<PictureDrawing>(scene, camera, kReportPicture);
    // Pixels are 0.09 mm wide on paper, and web pages show the picture at a third of its size.
    drawing_->setSmoothing(PictureSmoothing::Never);
    connect(drawing_.get(), &PictureDrawing::progressed, this,
            [this](double share) { Q_EMIT progressed(file_, share); });
    // Queued: the drawing is deleted when it ends.
    connect(drawing_.get(), &PictureDrawing::finished, this, &ReportExporter::write,
            Qt::QueuedConnection);
    connect(
        drawing_.get(), &PictureDrawing::failed, this,
        [this](const QString& problem) {
            end();
            Q_EMIT failed(problem);
        },
        Qt::QueuedConnection);
    Q_EMIT progressed(file_, 0.0);
}

void ReportExporter::write(QImage picture)
{
    if (!drawing_) {
        return; // it was canceled as it was finished
    }
    QPainter painter(&picture);
    for (const PicturePart& part : labels_) {
        painter.drawImage(part.at, part.image);
    }
    painter.end();
    report_->map.picture = std::move(picture);
    QString problem;
    if (QFileInfo(file_).suffix().compare(QLatin1String("pdf"), Qt::CaseInsensitive) == 0) {
        if (const Status written = writeReportPdf(*report_, file_, paperOfLocale()); !written) {
            problem = QString::fromStdString(written.error().message);
        }
    } else {
        const QByteArray page = reportHtml(*report_).toUtf8();
        QSaveFile out(file_);
        if (!out.open(QIODevice::WriteOnly) || out.write(page) != page.size() || !out.commit()) {
            //: %1 is a file, %2 the reason
            problem = tr("%1: cannot write the report (%2); choose another folder")
                          .arg(file_, out.errorString());
        }
    }
    const QString file = file_;
    end();
    if (!problem.isEmpty()) {
        Q_EMIT failed(problem);
        return;
    }
    folder_ = QFileInfo(file).absolutePath();
    Q_EMIT saved(file);
}

void ReportExporter::cancel()
{
    if (isExporting()) {
        end();
        Q_EMIT canceled();
    }
}

void ReportExporter::end()
{
    drawing_.reset();
    report_.reset();
    labels_.clear();
}

} // namespace marsview
