#include "ui/commands/vector_tools.h"

#include "ui/canvas/terrain_view.h"
#include "ui/controllers/session_controller.h"
#include "ui/controllers/vector_overlays.h"
#include "ui/panels/vector_file_list.h"
#include "ui/text/number_text.h"
#include "ui/text/sentence.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/notice_center.h"

#include <QAction>
#include <QColorDialog>
#include <QFileDialog>
#include <QFileInfo>
#include <QIcon>
#include <QMainWindow>
#include <QMenu>
#include <QPixmap>

#include <algorithm>
#include <array>
#include <utility>

namespace marsview {
namespace {

// Distinct on every ramp, with the dark border of lines, and from measurements, which are yellow.
constexpr std::array<Rgb8, 5> kColors{Rgb8{64, 220, 255}, Rgb8{255, 120, 200}, Rgb8{150, 255, 100},
                                      Rgb8{255, 150, 60}, Rgb8{200, 170, 255}};
constexpr int kSwatchSide = 14;

} // namespace

VectorTools::VectorTools(const Parts& parts, QObject* parent)
    : QObject(parent)
    , parts_(parts)
    , overlays_(new VectorOverlays(parts.view, parts.work, this))
{
    connect(&parts_.open, &QAction::triggered, this, &VectorTools::askFile);
    connect(overlays_, &VectorOverlays::wasRead, this, &VectorTools::add);
    connect(overlays_, &VectorOverlays::failed, this, &VectorTools::failed);
    connect(overlays_, &VectorOverlays::isOnOtherBody, this, &VectorTools::offerBody);
    connect(overlays_, &VectorOverlays::changed, this, &VectorTools::fillList);
    connect(&parts_.session, &SessionController::loadingEnded, this, &VectorTools::openWaiting);
    // An offer is for the map on which its file was to be drawn.
    connect(&parts_.view, &TerrainView::mapShown, this, [this] {
        offers_.clear();
        parts_.notices.setNotices(NoticeSource::VectorFile, offers_);
    });
    connectList();
    setSession(parts_.session.session());
}

void VectorTools::connectList()
{
    const VectorFileList* list = &parts_.list;
    connect(list, &VectorFileList::visibilityRequested, this,
            [this](const QString& path, bool is_visible) {
                setVisible(path.toStdString(), is_visible);
            });
    connect(list, &VectorFileList::goToRequested, this,
            [this](const QString& path) { overlays_->goTo(path.toStdString()); });
    connect(list, &VectorFileList::closeRequested, this,
            [this](const QString& path) { parts_.session.removeOverlay(path.toStdString()); });
    connect(list, &VectorFileList::menuRequested, this,
            [this](const QString& path, QPoint position) {
                for (std::size_t i = 0; i < shown_.size(); ++i) {
                    if (shown_[i].path == path.toStdString()) {
                        parts_.files.actions().at(static_cast<int>(i))->menu()->popup(position);
                    }
                }
            });
}

void VectorTools::open(const QStringList& files)
{
    waiting_ += files;
    if (!parts_.session.isBusy()) {
        openWaiting();
    }
}

void VectorTools::openWaiting()
{
    for (const QString& file : std::exchange(waiting_, {})) {
        if (parts_.view.map()) {
            withdrawOffer(QFileInfo(file).absoluteFilePath());
            overlays_->open(file);
        } else {
            Q_EMIT failed(tr("%1: there is no map to draw it on; open a map first").arg(file));
        }
    }
}

const VectorOverlay* VectorTools::overlayOf(const std::string& path) const
{
    const auto& overlays = parts_.session.session().overlays;
    const auto known =
        std::find_if(overlays.begin(), overlays.end(),
                     [&path](const VectorOverlay& overlay) { return overlay.path == path; });
    return known != overlays.end() ? &*known : nullptr;
}

void VectorTools::setSession(const Session& session)
{
    overlays_->setSession(session);
    parts_.open.setEnabled(!session.layers.empty());
    parts_.files.setEnabled(!session.overlays.empty());
    if (shown_ != session.overlays) {
        shown_ = session.overlays;
        fillMenu();
        fillList();
    }
}

void VectorTools::askFile()
{
    auto* dialog = new QFileDialog(&parts_.window, tr("Open Vector File"), folder_);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    dialog->setNameFilters(
        {tr("Vector files (*.gpkg *.geojson *.json *.kml *.shp *.csv)"), tr("All files (*)")});
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& file) {
        folder_ = QFileInfo(file).absolutePath();
        open({file});
    });
    dialog->open();
}

// GeoJSON and many exports know only the Earth's longitude and latitude.
void VectorTools::offerBody(const QString& file, const QString& body, const QString& crs)
{
    withdrawOffer(file);
    offers_.append(
        {.id = file,
         //: %1 is a file, %2 is a body
         .text = tr("%1 says that it is in longitude and latitude on Earth, but the map is on %2")
                     .arg(isolated(QFileInfo(file).fileName()), body),
         //: On a button: read a file as longitude and latitude on that body; %1 is a body
         .actions = {{tr("Use %1").arg(body), [this, file, crs] {
                          withdrawOffer(file);
                          overlays_->open(file, crs);
                      }}}});
    parts_.notices.setNotices(NoticeSource::VectorFile, offers_);
}

void VectorTools::withdrawOffer(const QString& file)
{
    if (offers_.removeIf([&file](const Notice& offer) { return offer.id == file; }) > 0) {
        parts_.notices.setNotices(NoticeSource::VectorFile, offers_);
    }
}

void VectorTools::add(const QString& file, const QString& crs, const QStringList& notices)
{
    const std::string path = file.toStdString();
    if (const VectorOverlay* known = overlayOf(path)) {
        VectorOverlay overlay = *known;
        overlay.is_visible = true;
        overlay.crs = crs.toStdString();
        parts_.session.setOverlay(overlay);
    } else {
        const std::size_t count = parts_.session.session().overlays.size();
        parts_.session.setOverlay({.path = path,
                                   .color = kColors[count % kColors.size()],
                                   .is_visible = true,
                                   .crs = crs.toStdString()});
    }
    //: In the status bar, for a few seconds; %1 is a file
    QString message = tr("Opened %1").arg(isolated(QFileInfo(file).fileName()));
    for (const QString& notice : notices) {
        message += QStringLiteral(" – ") + notice;
    }
    Q_EMIT opened(message);
}

void VectorTools::fillMenu()
{
    parts_.files.clear();
    for (const VectorOverlay& overlay : shown_) {
        const std::string path = overlay.path;
        QMenu* menu = parts_.files.addMenu(
            swatch(QColor(overlay.color.red, overlay.color.green, overlay.color.blue), kSwatchSide),
            withoutMnemonics(QFileInfo(QString::fromStdString(path)).fileName()));
        QAction* show = menu->addAction(tr("&Show"));
        show->setCheckable(true);
        show->setChecked(overlay.is_visible);
        connect(show, &QAction::triggered, this,
                [this, path](bool is_visible) { setVisible(path, is_visible); });
        connect(menu->addAction(tr("&Go There")), &QAction::triggered, this,
                [this, path] { overlays_->goTo(path); });
        connect(menu->addAction(tr("&Color…")), &QAction::triggered, this,
                [this, path] { askColor(path); });
        menu->addSeparator();
        // The menu that holds the action is cleared by this.
        connect(
            menu->addAction(tr("C&lose")), &QAction::triggered, this,
            [this, path] { parts_.session.removeOverlay(path); }, Qt::QueuedConnection);
    }
}

void VectorTools::fillList()
{
    std::vector<VectorFileList::File> files;
    for (auto overlay = shown_.rbegin(); overlay != shown_.rend(); ++overlay) {
        files.push_back(
            {.path = QString::fromStdString(overlay->path),
             .color = QColor(overlay->color.red, overlay->color.green, overlay->color.blue),
             .is_visible = overlay->is_visible,
             //: In the row of a vector file, why it is not drawn
             .reason = overlays_->isElsewhere(overlay->path) ? tr("Hidden: on another body")
                                                             : QString()});
    }
    parts_.list.setFiles(files);
}

void VectorTools::setVisible(const std::string& path, bool is_visible)
{
    if (const VectorOverlay* known = overlayOf(path)) {
        VectorOverlay changed = *known;
        changed.is_visible = is_visible;
        parts_.session.setOverlay(changed);
    }
}

void VectorTools::askColor(const std::string& path)
{
    const VectorOverlay* overlay = overlayOf(path);
    if (overlay == nullptr) {
        return;
    }
    auto* dialog = new QColorDialog(
        QColor(overlay->color.red, overlay->color.green, overlay->color.blue), &parts_.window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QColorDialog::colorSelected, this, [this, path](const QColor& color) {
        if (const VectorOverlay* known = overlayOf(path)) {
            VectorOverlay changed = *known;
            changed.color = {static_cast<std::uint8_t>(color.red()),
                             static_cast<std::uint8_t>(color.green()),
                             static_cast<std::uint8_t>(color.blue())};
            parts_.session.setOverlay(changed);
        }
    });
    dialog->open();
}

} // namespace marsview
