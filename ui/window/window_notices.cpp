#include "ui/window/window_notices.h"

#include "core/raster/sample_suggestions.h"
#include "core/tiles/tile_disk_cache.h"
#include "ui/canvas/terrain_view.h"
#include "ui/controllers/haptics/haptics_controller.h"
#include "ui/controllers/session_controller.h"
#include "ui/text/body_text.h"
#include "ui/text/haptics_text.h"
#include "ui/text/number_text.h"
#include "ui/text/sentence.h"
#include "ui/widgets/notice_center.h"

#include <QAction>
#include <QFileInfo>

#include <algorithm>
#include <utility>
#include <vector>

namespace marsview {
namespace {

// A name in a sentence, cut short in its middle if it would fill a line.
QString shortName(const std::string& name)
{
    constexpr qsizetype kLengthMax = 40;
    const QString text = QString::fromStdString(name);
    return isolated(text.size() <= kLengthMax
                        ? text
                        : text.first(kLengthMax / 2) + QChar(0x2026) + text.last(kLengthMax / 2));
}

QString idOf(LayerId layer, const QString& what)
{
    return QStringLiteral("layer %1: %2").arg(static_cast<uint>(layer)).arg(what);
}

} // namespace

WindowNotices::WindowNotices(Parts parts, NoticeCommands commands, QObject* parent)
    : QObject(parent)
    , parts_(std::move(parts))
    , commands_(std::move(commands))
{
    connect(&parts_.globe, &QAction::toggled, this, &WindowNotices::update);
}

void WindowNotices::setUnplaced(std::vector<UnplacedLayer> layers)
{
    unplaced_ = std::move(layers);
    update();
}

void WindowNotices::update()
{
    const Layer* active = activeLayer(parts_.session.session());
    NoticeCenter& center = parts_.center;
    center.setNotices(NoticeSource::Device, ofDevice());
    center.setNotices(NoticeSource::Picture, active != nullptr ? ofPicture() : QList<Notice>());
    center.setNotices(NoticeSource::Sample, ofSample());
    center.setNotices(NoticeSource::Scene, ofScene());
    QList<Notice> corrections;
    QList<Notice> of_layer;
    if (active != nullptr) {
        addNotices(*active, corrections, of_layer);
    }
    center.setNotices(NoticeSource::Correction, corrections);
    center.setNotices(NoticeSource::Layer, of_layer);
    center.setNotices(NoticeSource::Storage, ofStorage());
}

QList<Notice> WindowNotices::ofDevice() const
{
    HapticsController& haptics = parts_.haptics;
    if (haptics.isStopped()) {
        return {{.id = QStringLiteral("device: stopped"),
                 .text = tr("Emergency stop: the forces of the haptic device are off"),
                 //: On a button: after an emergency stop of the haptic device
                 .actions = {{tr("Resume Forces"), [&haptics] { haptics.setStopped(false); }}},
                 .show_details = commands_.show_haptics}};
    }
    const QString problem = haptics.device().notice();
    if (problem.isEmpty()) {
        return ofReplay();
    }
    Notice notice{.id = QStringLiteral("device: ") + problem,
                  .text = problem,
                  .show_details = commands_.show_haptics};
    if (haptics.device().isLost() && haptics.device().hasTicks()) {
        //: On a button: after a haptic device was lost
        notice.actions.append({tr("Save Diagnostic Log…"), commands_.save_diagnostic_log});
    }
    return {notice};
}

// A decision: it stays until another recording is replayed or another device is connected.
QList<Notice> WindowNotices::ofReplay() const
{
    HapticsController& haptics = parts_.haptics;
    const QString file = haptics.device().replayedToItsEnd();
    if (file.isEmpty()) {
        return {};
    }
    return {{.id = QStringLiteral("replayed: ") + file,
             .text = replayEndText(file),
             //: On a button: after a recording of a touch was replayed
             .actions = {{tr("Replay Again"), [&haptics] { haptics.device().replayAgain(); }}},
             .show_details = commands_.show_haptics}};
}

QList<Notice> WindowNotices::ofPicture() const
{
    const QString problem = parts_.view.problem();
    if (problem.isEmpty()) {
        return {};
    }
    return {{.id = QStringLiteral("picture: ") + problem,
             //: %1 says which file, and why
             .text = tr("Part of the picture is coarse for now. %1").arg(problem)}};
}

QList<Notice> WindowNotices::ofSample() const
{
    SessionController& session = parts_.session;
    const Layer* sample = session.replacedSample();
    const Layer* active = activeLayer(session.session());
    if (sample == nullptr || active == nullptr) {
        return {};
    }
    const Body* body = sample->map->info().body;
    const QString name = body != nullptr ? bodyName(*body) : QString();
    return {{.id = idOf(sample->id, QStringLiteral("sample")),
             .text = name.isEmpty()
                         ? tr("The sample map was closed to show your file")
                         //: %1 is a body
                         : tr("The sample map of %1 was closed to show your file").arg(name),
             .actions = {{name.isEmpty() ? tr("Keep Sample")
                                         //: On a button: keep the sample map; %1 is a body
                                         : tr("Keep %1").arg(name),
                          [&session] { session.keepSample(); }}}}};
}

// The flat map shows layers of one CRS only, the globe all of a body.
QList<Notice> WindowNotices::ofScene() const
{
    const Session& session = parts_.session.session();
    const std::vector<LayerState> states = placement(session);
    std::size_t left_out = 0;
    while (left_out < states.size() &&
           (states[left_out] != LayerState::OtherCrs ||
            session.layers[left_out].map->info().body == nullptr)) { // on no globe
        ++left_out;
    }
    QAction& globe = parts_.globe;
    if (globe.isChecked()) {
        return ofUnplaced();
    }
    if (left_out == states.size() || !globe.isEnabled()) {
        return {};
    }
    const Layer& layer = session.layers[left_out];
    return {{.id = idOf(layer.id, QStringLiteral("other CRS")),
             //: %1 is a layer
             .text = tr("%1 is hidden: its CRS is not that of the flat map. The globe shows both")
                         .arg(shortName(layer.name)),
             //: On a button: show all layers of a body on the globe
             .actions = {{tr("Show Globe"), [&globe] { globe.trigger(); }}}}};
}

QList<Notice> WindowNotices::ofUnplaced() const
{
    QList<Notice> notices;
    for (const Layer& layer : parts_.session.session().layers) {
        const auto unplaced =
            std::find_if(unplaced_.begin(), unplaced_.end(),
                         [&](const UnplacedLayer& other) { return other.map == layer.map; });
        if (unplaced != unplaced_.end()) {
            notices.append(
                {.id = idOf(layer.id, QStringLiteral("unplaced")),
                 //: %1 is a layer, %2 a reason, such as "has samples beyond a pole"
                 .text = tr("%1 cannot be placed on the globe: it %2")
                             .arg(shortName(layer.name), translatedMessage(unplaced->problem))});
        }
    }
    return notices;
}

void WindowNotices::addNotices(const Layer& layer,
                               QList<Notice>& corrections,
                               QList<Notice>& others) const
{
    const Map& map = *layer.map;
    // The first notice of a preview says in numbers that it is one.
    const std::size_t first = map.isPreview() ? 1 : 0;
    if (map.isPreview()) {
        others.append(ofPreview(layer));
    }
    if (parts_.session.isNodataAssumed(layer)) {
        corrections.append(ofAssumedNodata(layer));
    }
    const auto& suggestion = map.info().crs_suggestion;
    const std::string of_suggestion = suggestion ? noticeOf(*suggestion) : std::string();
    const auto& nodata = map.info().nodata_suggestion;
    const std::string of_nodata = nodata ? noticeOfNodata(*nodata) : std::string();
    const auto& unit = map.info().unit_suggestion;
    const std::string of_unit = unit ? noticeOf(*unit) : std::string();
    const auto& misfit = map.info().elevation_misfit;
    const std::string of_misfit = misfit ? noticeOf(*misfit) : std::string();
    const std::string& of_unused = map.info().unused_crs_notice;
    const std::string of_archive = archiveNotice(map.info().in_archive, map.info().path);
    const std::string of_replacement = map.info().replacementNotice();
    QList<Notice> last; // the least important
    const auto& texts = map.info().notices;
    for (std::size_t i = first; i < texts.size(); ++i) {
        const QString text = QString::fromStdString(texts[i]);
        Notice notice{.id = idOf(layer.id, text),
                      .text = asSentence(text),
                      .show_details = [show = commands_.show_fact, text] { show(text); }};
        if (suggestion && texts[i] == of_suggestion) {
            addChoices(notice, *suggestion, layer);
            corrections.append(notice);
        } else if (nodata && texts[i] == of_nodata) {
            addNodata(notice, *nodata, layer);
            corrections.prepend(notice);
        } else if (unit && texts[i] == of_unit) {
            addUnit(notice, *unit, layer);
            corrections.append(notice);
        } else if (!texts[i].empty() && (texts[i] == of_misfit || texts[i] == of_unused)) {
            //: On a button: set the body, the CRS, the elevation unit and more of a map
            notice.actions.append({tr("Set Body, CRS…"), commands_.set_georeferencing});
            corrections.append(notice);
        } else if (texts[i] == of_archive) {
            addRasters(notice, map.info());
            others.prepend(notice);
        } else if (texts[i] == of_replacement) {
            last.append(notice);
        } else {
            others.append(notice);
        }
    }
    others.append(last);
}

// One click for every other raster of the archive.
void WindowNotices::addRasters(Notice& notice, const RasterInfo& info) const
{
    const auto name_of = [](const std::string& path) {
        return QFileInfo(QString::fromStdString(path)).fileName();
    };
    notice.text =
        tr("%1 is shown, one of the %2 rasters in %3")
            .arg(shortName(name_of(info.path).toStdString()), countText(info.in_archive.size()),
                 shortName(name_of(info.requested).toStdString()));
    SessionController& session = parts_.session;
    for (const ArchiveRaster& raster : info.in_archive) {
        if (raster.name == info.path) {
            continue;
        }
        const QString name = isolated(name_of(raster.name));
        const QString text =
            info.in_archive.size() == 2
                //: On a button: open another raster of an archive; %1 is its name
                ? tr("Open %1").arg(name)
                //: In a list of rasters: %1 is a name, %2 its size in columns and rows
                : tr("%1 (%2)").arg(name,
                                    //: The columns and rows of a raster
                                    leftToRight(tr("%1 × %2").arg(countText(raster.columns),
                                                                  countText(raster.rows))));
        notice.actions.append(
            {withoutMnemonics(text),
             [&session, file = QString::fromStdString(raster.name)] { session.open({file}); }});
    }
    //: On a button that lists the other rasters of an archive
    notice.menu_text = tr("Open Another…");
}

Notice WindowNotices::ofAssumedNodata(const Layer& layer) const
{
    const QString value = sampleText(*layer.map->spec().overrides.nodata);
    SessionController& session = parts_.session;
    RasterOverrides overrides = layer.map->spec().overrides;
    overrides.nodata.reset();
    return {.id = idOf(layer.id, QStringLiteral("assumed nodata")),
            //: %1 is a number
            .text = tr("Samples of %1 are shown as nodata, although the file declares no nodata "
                       "value")
                        .arg(value),
            //: On a button: show samples that were taken for nodata as elevations
            .actions = {{tr("Show as Elevations"), [&session, id = layer.id, overrides] {
                             session.overrideGeoreferencing(id, overrides);
                         }}}};
}

void WindowNotices::addNodata(Notice& notice, double raw, const Layer& layer) const
{
    const QString value = sampleText(raw);
    //: %1 is a number
    notice.text =
        tr("Samples of %1 often mark nodata, but the file declares no nodata value").arg(value);
    SessionController& session = parts_.session;
    RasterOverrides overrides = layer.map->spec().overrides;
    overrides.nodata = raw;
    //: On a button: read samples of that value as nodata; %1 is a number
    notice.actions.append({tr("Set %1 as Nodata").arg(value), [&session, id = layer.id, overrides] {
                               session.overrideGeoreferencing(id, overrides);
                           }});
}

void WindowNotices::addUnit(Notice& notice,
                            const UnitSuggestion& suggestion,
                            const Layer& layer) const
{
    const bool is_survey_foot = suggestion.unit == verticalUnitFrom("US survey ft");
    if (suggestion.implausible_m) {
        const QString elevation =
            withUnit(numberText(*suggestion.implausible_m, 0), unitSymbol(HeightUnit::Meters));
        notice.text =
            *suggestion.implausible_m > 0.0
                //: %1 is an elevation in meters
                ? tr("Looks like feet, but the file has no unit of elevation: no place on the "
                     "Earth is as high as %1")
                      .arg(elevation)
                //: %1 is an elevation in meters
                : tr("Looks like feet, but the file has no unit of elevation: no place on the "
                     "Earth is as low as %1")
                      .arg(elevation);
    } else {
        notice.text = is_survey_foot
                          ? tr("The file has no unit of elevation: elevations are read as meters, "
                               "but the unit of the CRS is the US survey foot")
                          : tr("The file has no unit of elevation: elevations are read as meters, "
                               "but the unit of the CRS is the foot");
    }
    SessionController& session = parts_.session;
    RasterOverrides overrides = layer.map->spec().overrides;
    overrides.vertical_unit = suggestion.unit.name;
    notice.actions.append(
        {is_survey_foot
             //: On a button: read the elevations of a map in US survey feet
             ? tr("Use US Survey Feet")
             //: On a button: read the elevations of a map in feet
             : tr("Use Feet"),
         [&session, id = layer.id, overrides] { session.overrideGeoreferencing(id, overrides); }});
}

// One click for each system that would fit; every one is a step that can be undone.
void WindowNotices::addChoices(Notice& notice,
                               const CrsSuggestion& suggestion,
                               const Layer& layer) const
{
    const QString reason = translatedMessage(QString::fromStdString(suggestion.reason));
    notice.text =
        suggestion.unfit_crs.empty()
            //: %1 is a reason, such as "its extent is 0° – 360°, 90° S – 90° N"
            ? tr("Looks like longitude and latitude, but the file has no CRS (%1)").arg(reason)
            //: %1 is a reason, such as "its extent is 0° – 360°, 90° S – 90° N", %2 a CRS
            : tr("Looks like longitude and latitude (%1), but the CRS of the file, %2, is a map "
                 "projection")
                  .arg(reason, shortName(suggestion.unfit_crs));
    SessionController& session = parts_.session;
    for (const CrsChoice& choice : suggestion.choices) {
        const QString name =
            choice.body == "Earth" ? tr("WGS 84 (Earth)") : QString::fromStdString(choice.body);
        RasterOverrides overrides = layer.map->spec().overrides;
        overrides.crs = choice.crs;
        notice.actions.append(
            {suggestion.choices.size() == 1
                 //: On a button: read a map in longitude and latitude on that body
                 ? tr("Use %1").arg(name)
                 : name,
             [&session, id = layer.id, overrides] {
                 session.overrideGeoreferencing(id, overrides);
             }});
    }
    //: On a button that lists bodies: read a map in longitude and latitude on one of them
    notice.menu_text = tr("Use…");
}

Notice WindowNotices::ofPreview(const Layer& layer) const
{
    SessionController& session = parts_.session;
    const Preparation preparation = session.preparationOf(layer.id);
    const QString name = shortName(layer.name);
    const auto build = [&session, id = layer.id] { session.prepare(id); };
    switch (preparation.state) {
    case PreparationState::None:
    case PreparationState::Waiting:
    case PreparationState::Running:
        break;
    case PreparationState::Stopped:
        return {.id = idOf(layer.id, QStringLiteral("stopped %1").arg(preparation.ending)),
                //: %1 is a layer
                .text = tr("%1 is shown as a preview. Build its overviews to see and touch all "
                           "of it")
                            .arg(name),
                .actions = {{tr("Build Overviews"), build}}};
    case PreparationState::Failed:
        return {.id = idOf(layer.id, QStringLiteral("failed %1").arg(preparation.ending)),
                .text = preparation.problem,
                //: On a button: build the overviews of a large map after that failed
                .actions = {{tr("Try Again"), build}}};
    }
    return {.id = idOf(layer.id, QStringLiteral("preview")),
            //: %1 is a layer
            .text = tr("%1 is shown as a preview while its overviews are being built").arg(name)};
}

// Why tiles from servers are not kept on disk.
QList<Notice> WindowNotices::ofStorage() const
{
    const auto& tiles = parts_.fetched_tiles;
    const std::optional<std::string> trouble = tiles ? tiles->trouble() : std::nullopt;
    if (!trouble) {
        return {};
    }
    const QString text = QString::fromStdString(*trouble);
    return {{.id = QStringLiteral("storage: ") + text, .text = text}};
}

} // namespace marsview
