#include "ui/commands/name_search.h"

#include "core/view/feature_view.h"
#include "ui/canvas/terrain_view.h"
#include "ui/commands/shown_maps.h"
#include "ui/globe/globe_view.h"
#include "ui/overlay/map_overlays.h"
#include "ui/text/core_text.h"
#include "ui/text/number_text.h"
#include "ui/text/place_name_text.h"

#include <QAction>
#include <QFileDialog>
#include <QFileInfo>
#include <QLineEdit>
#include <QMainWindow>
#include <QSettings>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

namespace marsview {
namespace {

// Of the shorter side of the picture, by a feature that was found.
constexpr double kFilledShare = 0.8;
constexpr double kPixelsLeast = 24.0; // of the map, across a view: fewer show nothing

QString filesKey()
{
    return QStringLiteral("names/files");
}

QString bodiesKey()
{
    return QStringLiteral("names/bodies");
}

} // namespace

NameSearch::NameSearch(const Parts& parts, QObject* parent)
    : QObject(parent)
    , parts_(parts)
    , completer_(new NameCompleter(parts.field))
{
    completer_->explainNothing([this](const QString& text) {
        const QString why = noMatchText(text, namesOnMap(), body());
        const bool has_digit =
            std::any_of(text.begin(), text.end(), [](QChar c) { return c.isDigit(); });
        return has_digit ? why + QLatin1Char('\n') +
                               tr("View › Go to Place… goes to coordinates (Ctrl+G).")
                         : why;
    });
    connect(completer_, &NameCompleter::chosen, this, [this](const PlaceName& place) {
        goTo(place);
        parts_.field.clear();
    });
    connect(&parts_.field, &QLineEdit::returnPressed, this, &NameSearch::goToText);
    connect(&parts_.view, &TerrainView::mapShown, this, &NameSearch::showMap);
    connect(&parts_.view, &TerrainView::layersChanged, this, &NameSearch::showMap);
    connect(&lists_, &NamesController::changed, this, &NameSearch::showMap);
    connect(&lists_, &NamesController::failed, this, &NameSearch::failed);
    connect(&lists_, &NamesController::opened, this,
            [this](const QString& file, const std::shared_ptr<const Gazetteer>& names) {
                if (parts_.is_remembered) {
                    remember(file, *names);
                }
                //: In the status bar: %1 is a number, %2 a file
                Q_EMIT opened(tr("%1 names in %2")
                                  .arg(countText(names->names().size()),
                                       isolated(QFileInfo(file).fileName())));
            });
    connect(&parts_.open_names, &QAction::triggered, this, &NameSearch::chooseFile);
    showMap();
    if (parts_.is_remembered) {
        reopen();
    }
}

void NameSearch::remember(const QString& file, const Gazetteer& names)
{
    QSettings settings;
    QStringList files = settings.value(filesKey()).toStringList();
    QStringList bodies = settings.value(bodiesKey()).toStringList();
    for (qsizetype i = std::min(files.size(), bodies.size()); i > 0; --i) {
        if (files[i - 1] == file) {
            files.removeAt(i - 1);
            bodies.removeAt(i - 1);
        }
    }
    const std::string_view body = names.body() != nullptr ? names.body()->name : "";
    files.append(file);
    bodies.append(textFrom(body));
    settings.setValue(filesKey(), files);
    settings.setValue(bodiesKey(), bodies);
}

// Files that are not there any more are skipped.
void NameSearch::reopen()
{
    const QSettings settings;
    const QStringList files = settings.value(filesKey()).toStringList();
    const QStringList bodies = settings.value(bodiesKey()).toStringList();
    for (qsizetype i = 0; i < std::min(files.size(), bodies.size()); ++i) {
        if (QFileInfo::exists(files[i])) {
            lists_.open(files[i], bodyNamed(bodies[i].toStdString()));
        }
    }
}

const Body* NameSearch::body() const
{
    const auto& map = parts_.view.map();
    return map ? map->info().body : nullptr;
}

std::shared_ptr<const Map> NameSearch::mapAt(const PlaceName& place) const
{
    for (const auto& map : shownMaps(parts_.view, parts_.globe)) {
        if (featureExtent(map->georeference(), place.position, 0.0)) {
            return map;
        }
    }
    return nullptr;
}

NamesOnMap NameSearch::namesOnMap()
{
    return {.names = lists_.namesOn(body()),
            .is_on_map = [this](const PlaceName& place) { return mapAt(place) != nullptr; }};
}

void NameSearch::showMap()
{
    const bool has_map = bool(parts_.view.map());
    parts_.field.setEnabled(has_map);
    parts_.open_names.setEnabled(has_map);
    completer_->setNames(namesOnMap());
    Q_EMIT changed();
}

void NameSearch::goToText()
{
    const auto places = namesOnMap().find(parts_.field.text(), 1);
    if (!places.empty()) {
        goTo(places.front());
        parts_.field.clear();
    }
}

void NameSearch::goTo(const PlaceName& place)
{
    const auto map = mapAt(place);
    const auto extent =
        map ? featureExtent(map->georeference(), place.position, place.diameter_m) : std::nullopt;
    if (!extent) {
        return;
    }
    // A feature smaller than the map's resolution is shown with its surroundings.
    const double across_m =
        std::max(extent->across_m, kPixelsLeast * parts_.view.ground().pixelMeters());
    const double distance_m = distanceShowing(
        across_m, kFilledShare, parts_.view.camera().field_of_view, parts_.view.viewport());
    if (parts_.globe.isHidden()) {
        parts_.view.setFocus(Qt::OtherFocusReason);
        if (const auto center = onTopmost(parts_.view, *map, extent->center)) {
            parts_.view.flyTo(*center, distance_m);
        }
    } else {
        parts_.globe.setFocus(Qt::OtherFocusReason);
        parts_.globe.flyTo(place.position, distance_m);
    }
    parts_.overlays.markPlace(onTopmost(parts_.view, *map, extent->center), place.position);
}

void NameSearch::open(const QString& file)
{
    lists_.open(file, body());
}

void NameSearch::chooseFile()
{
    auto* dialog = new QFileDialog(&parts_.window, tr("Open Names"), folder_);
    dialog->setFileMode(QFileDialog::ExistingFile);
    dialog->setNameFilters(
        {tr("Points with names (*.csv *.gpkg *.geojson *.json *.kml *.shp)"), tr("All files (*)")});
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& file) {
        folder_ = QFileInfo(file).absolutePath();
        open(file);
    });
    dialog->open();
}

} // namespace marsview
