#include "ui/dialogs/go_to_dialog.h"

#include "core/geo/coordinate_entry.h"
#include "core/geo/extent.h"
#include "ui/text/place_name_text.h"
#include "ui/text/sentence.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QPushButton>
#include <QRegularExpression>
#include <QVBoxLayout>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

namespace marsview {
namespace {

// The interval at which an elevation that was requested is looked for.
constexpr std::chrono::milliseconds kArrivalInterval{50};

LatitudeKind kindOf(ReadAs read_as)
{
    return read_as == ReadAs::Planetographic ? LatitudeKind::Planetographic
                                             : LatitudeKind::Planetocentric;
}

// The format with the system and the kind of latitude that a text was read in.
CoordinateFormat asRead(CoordinateFormat format, ReadAs read_as, const RasterInfo& info)
{
    format.system = read_as == ReadAs::Map ? PositionSystem::Map : PositionSystem::Geographic;
    if (read_as != ReadAs::Map) {
        format.setLatitudesOn(info.body, kindOf(read_as));
    }
    return format;
}

QString readingName(ReadAs read_as, const RasterInfo& info)
{
    const QString name = formatName(asRead({}, read_as, info), info);
    //: How a coordinate is read: the order, then the CRS or the kind of latitude
    return read_as == ReadAs::Map ? GoToDialog::tr("x, y (%1)").arg(name)
                                  : GoToDialog::tr("Latitude, longitude (%1)").arg(name);
}

QString coverText(const Map& map, const CoordinateFormat& format)
{
    const Georeference& georeference = map.georeference();
    if (format.system == PositionSystem::Geographic) {
        if (const auto extent = geographicExtent(georeference)) {
            const ExtentText text = extentText(*extent, format, map.info());
            //: The extent of a map: %1 latitudes, %2 longitudes
            return GoToDialog::tr("%1, %2").arg(text.latitudes, text.longitudes);
        }
    }
    const MapExtent extent = mapExtent(georeference);
    //: The range of map coordinates: x from %1 to %2, y from %3 to %4
    return leftToRight(GoToDialog::tr("x %1 … %2, y %3 … %4")
                           .arg(shortNumberText(extent.low.x, 9), shortNumberText(extent.high.x, 9),
                                shortNumberText(extent.low.y, 9),
                                shortNumberText(extent.high.y, 9)));
}

// Two numbers in the locale's own groups of digits, as the status bar writes them.
std::optional<MapPoint> localMapPointFrom(const QString& text)
{
    static const QRegularExpression kMarks(
        QStringLiteral("[\\x{200E}\\x{200F}\\x{2066}-\\x{2069}]"));
    static const QRegularExpression kUnit(QStringLiteral("\\s*[°\\p{L} ]+$"));
    static const QRegularExpression kSeparator(QStringLiteral("[;,،]\\s+"));
    QString plain = text;
    plain.remove(kMarks).replace(QChar(0x2212), QLatin1Char('-'));
    const QStringList parts = plain.remove(kUnit).split(kSeparator);
    if (parts.size() != 2) {
        return std::nullopt;
    }
    bool is_x = false;
    bool is_y = false;
    const double x = QLocale().toDouble(parts[0].trimmed(), &is_x);
    const double y = QLocale().toDouble(parts[1].trimmed(), &is_y);
    return is_x && is_y ? std::optional(MapPoint{x, y}) : std::nullopt;
}

// The map coordinates of its middle, as people may type them in any language.
QString exampleOn(const Map& map)
{
    const Georeference& georeference = map.georeference();
    const MapPoint middle =
        georeference.toMap({0.5 * static_cast<double>(georeference.columns() - 1),
                            0.5 * static_cast<double>(georeference.rows() - 1)});
    const MapPoint next = georeference.toMap({0.5 * static_cast<double>(georeference.columns() + 1),
                                              0.5 * static_cast<double>(georeference.rows() + 1)});
    const double step = std::max(std::abs(next.x - middle.x), std::abs(next.y - middle.y));
    const int digits =
        step > 0.0 ? std::clamp(static_cast<int>(std::ceil(-std::log10(step))), 0, 6) : 0;
    return QStringLiteral("%1, %2").arg(QString::number(middle.x, 'f', digits),
                                        QString::number(middle.y, 'f', digits));
}

// Whether the text is a pair of map coordinates that cannot be degrees.
bool isOnlyMapPoint(const QString& text)
{
    const Result<MapPoint> plain = mapPointFrom(text.toStdString());
    const auto point = plain ? std::optional(*plain) : localMapPointFrom(text);
    return point && (std::abs(point->x) > 360.0 || std::abs(point->y) > 360.0);
}

// Whether the text begins like a name: with a letter, which no coordinate does but "N 18 E 226".
bool isName(const QString& text)
{
    static const QRegularExpression kName(QStringLiteral("^\\p{L}(?![ ]*[-+0-9.,])"));
    return text.contains(kName);
}

bool isOnPixels(const Georeference& georeference, GridPoint grid)
{
    const auto is_within = [](double place, std::size_t count) {
        return place >= -0.5 - 1e-9 && place <= static_cast<double>(count) - 0.5 + 1e-9;
    };
    return is_within(grid.column, georeference.columns()) &&
           is_within(grid.row, georeference.rows());
}

} // namespace

std::vector<ReadAs> readingsOn(const RasterInfo& info, const CoordinateFormat& format)
{
    std::vector<ReadAs> readings;
    if (info.crs && info.crs->ellipsoid()) {
        readings = {ReadAs::Planetocentric};
        if (hasKindsOfLatitude(info)) {
            readings.push_back(ReadAs::Planetographic);
            if (format.latitudesOn(info.body) == LatitudeKind::Planetographic) {
                std::swap(readings.front(), readings.back());
            }
        }
    }
    const bool is_map_first = systemOn(format, info) == PositionSystem::Map;
    readings.insert(is_map_first ? readings.begin() : readings.end(), ReadAs::Map);
    return readings;
}

Result<FoundPlace> placeOnMap(const std::shared_ptr<const Map>& map,
                              const CoordinateFormat& format,
                              ReadAs read_as,
                              const QString& typed)
{
    const QString text = withPlainDirections(typed);
    const RasterInfo& info = map->info();
    const Georeference& georeference = map->georeference();
    const std::string written = text.toStdString();
    const bool has_longitudes = info.crs && info.crs->ellipsoid();
    static const QRegularExpression kAngleSigns(QStringLiteral("[°º′″NSEWnsew]"));
    const BareLongitude bare = format.longitudesOn(info.body) == LongitudeNotation::West360
                                   ? BareLongitude::West
                                   : BareLongitude::East;
    if (read_as == ReadAs::Map && has_longitudes && text.contains(kAngleSigns) &&
        !localMapPointFrom(text)) {
        read_as = format.latitudesOn(info.body) == LatitudeKind::Planetographic
                      ? ReadAs::Planetographic
                      : ReadAs::Planetocentric;
    }
    if (read_as != ReadAs::Map) {
        const auto as_angles = placeFrom(written, bare);
        if (!as_angles && info.crs->kind() != CrsKind::Geographic && isOnlyMapPoint(text)) {
            read_as = ReadAs::Map;
        }
    }
    std::optional<GridPoint> grid;
    const auto is_on_map = [&] { return grid && isOnPixels(georeference, *grid); };
    if (read_as == ReadAs::Map) {
        const Result<MapPoint> point = mapPointFrom(written);
        const auto local = localMapPointFrom(text);
        if (!point && !local) {
            return point.error();
        }
        grid = georeference.toGrid(point ? *point : *local);
        // "562.345, 117.890" has points of decimals, or groups of digits.
        if (point && local && !is_on_map()) {
            grid = georeference.toGrid(*local);
        }
    } else {
        const Result<WrittenPlace> place = placeFrom(written, bare);
        if (!place) {
            return Error{ErrorCode::Invalid, place.error().message}; // on no map a place
        }
        const Angle latitude = read_as == ReadAs::Planetographic
                                   ? info.crs->ellipsoid()->planetocentric(place->latitude)
                                   : place->latitude;
        grid = georeference.toGrid(GeographicPoint{place->longitude, latitude});
    }
    if (!is_on_map()) {
        return Error{ErrorCode::OutOfRange,
                     GoToDialog::tr("This place is outside the map, which covers %1.")
                         .arg(coverText(*map, asRead(format, read_as, info)))
                         .toStdString()};
    }
    return FoundPlace{.map = map, .grid = *grid, .read_as = read_as};
}

Result<FoundPlace> placeOnMaps(const std::vector<std::shared_ptr<const Map>>& maps,
                               const CoordinateFormat& format,
                               ReadAs read_as,
                               const QString& text)
{
    Result<FoundPlace> found = placeOnMap(maps.front(), format, read_as, text);
    if (found || maps.size() == 1) {
        return found;
    }
    const std::optional<Crs>& first = maps.front()->info().crs;
    for (std::size_t i = 1; i < maps.size(); ++i) {
        const std::optional<Crs>& crs = maps[i]->info().crs;
        const bool is_same = crs && first ? crs->wkt() == first->wkt() : !crs && !first;
        if (read_as == ReadAs::Map ? !is_same : !crs || !crs->ellipsoid()) {
            continue;
        }
        if (Result<FoundPlace> place = placeOnMap(maps[i], format, read_as, text)) {
            return place;
        }
    }
    if (found.error().code != ErrorCode::OutOfRange) {
        return found;
    }
    return Error{ErrorCode::OutOfRange,
                 GoToDialog::tr("This place is outside all maps in the view.").toStdString()};
}

GoToDialog::GoToDialog(std::vector<std::shared_ptr<const Map>> maps,
                       const Preferences& preferences,
                       const GoToEntry& last,
                       NamesOnMap names,
                       QWidget* parent)
    : QDialog(parent)
    , maps_(std::move(maps))
    , map_(maps_.front())
    , preferences_(preferences)
    , names_(std::move(names))
    , field_(new QLineEdit(last.text, this))
    , kind_(new QComboBox(this))
    , answer_(new QLabel(this))
{
    setWindowTitle(tr("Go to Place"));
    kind_->setAccessibleName(tr("How the coordinate is read"));
    for (const ReadAs read_as : readingsOn(map_->info(), preferences_.coordinates)) {
        kind_->addItem(readingName(read_as, map_->info()), static_cast<int>(read_as));
    }
    const int last_index = last.read_as ? kind_->findData(static_cast<int>(*last.read_as)) : 0;
    kind_->setCurrentIndex(std::max(0, last_index)); // the format's own is first
    kind_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    kind_->setMinimumContentsLength(30);
    field_->setAccessibleName(tr("Name or coordinate"));
    field_->setObjectName(QStringLiteral("coordinate"));
    field_->setClearButtonEnabled(true);
    field_->selectAll();
    answer_->setAccessibleName(tr("How the coordinate is understood"));
    answer_->setObjectName(QStringLiteral("answer"));
    answer_->setWordWrap(true);
    answer_->setMinimumHeight(3 * fontMetrics().lineSpacing()); // no jumps while typing
    answer_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    auto* form = new QFormLayout;
    form->addRow(tr("&Place"), field_);
    form->addRow(tr("&Read as"), kind_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    go_button_ = buttons->addButton(tr("&Go"), QDialogButtonBox::AcceptRole);
    go_button_->setDefault(true);
    auto* layout = new QVBoxLayout(this);
    layout->addLayout(form);
    layout->addWidget(answer_);
    layout->addWidget(buttons);
    resize(420, sizeHint().height());
    arrival_timer_.setSingleShot(true);
    connect(&arrival_timer_, &QTimer::timeout, this, &GoToDialog::check);
    connect(field_, &QLineEdit::textChanged, this, &GoToDialog::check);
    connect(kind_, &QComboBox::currentIndexChanged, this, &GoToDialog::check);
    connect(buttons, &QDialogButtonBox::accepted, this, &GoToDialog::go);
    // Over the list of names Return would otherwise only close the list.
    connect(field_, &QLineEdit::returnPressed, this, &GoToDialog::go);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* completer = new NameCompleter(*field_);
    completer->setNames(names_);
    connect(completer, &NameCompleter::chosen, this, [this](const PlaceName& place) {
        if (isVisible()) {
            Q_EMIT nameChosen(place);
            accept();
        }
    });
    check();
}

void GoToDialog::setTexts(const QString& title, const QString& button)
{
    setWindowTitle(title);
    go_button_->setText(button);
}

GoToEntry GoToDialog::entry() const
{
    return {.read_as = kind_->currentIndex() > 0 ? std::optional(readAs()) : std::nullopt,
            .text = field_->text().trimmed()};
}

ReadAs GoToDialog::readAs() const
{
    return static_cast<ReadAs>(kind_->currentData().toInt());
}

void GoToDialog::check()
{
    const GoToEntry now = entry();
    const bool is_map = readAs() == ReadAs::Map;
    // Examples are the same in every language.
    field_->setPlaceholderText(is_map ? exampleOn(*map_)
                                      : QStringLiteral("18.65 N 226.2 E, 18°39′ N 133°48′ W"));
    if (now.text.isEmpty()) {
        const bool is_west =
            preferences_.coordinates.longitudesOn(map_->info().body) == LongitudeNotation::West360;
        answer_->setText(
            is_map    ? tr("Two numbers, x and then y.")
            : is_west ? tr("Degrees, or degrees, minutes and seconds. Without letters, latitude "
                           "is first and longitude is positive to the west.")
                      : tr("Degrees, or degrees, minutes and seconds. Without letters, latitude "
                           "is first and longitude is positive to the east."));
        go_button_->setEnabled(false);
        return;
    }
    const Result<FoundPlace> place =
        placeOnMaps(maps_, preferences_.coordinates, readAs(), now.text);
    const auto named = place ? std::nullopt : namedPlace();
    go_button_->setEnabled(place || named);
    if (named) {
        answer_->setText(answerFor(*named));
    } else if (!place && isName(now.text)) {
        answer_->setText(noMatchText(now.text, names_, map_->info().body));
    } else {
        answer_->setText(place ? answerFor(*place) : asSentence(place.error().message));
    }
}

// What the text names unless it is a coordinate: the first of the list below the field.
std::optional<PlaceName> GoToDialog::namedPlace() const
{
    const QString text = entry().text;
    auto found = isName(text) ? names_.find(text, 1) : std::vector<PlaceName>();
    return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
}

QString GoToDialog::answerFor(const PlaceName& place) const
{
    const QString name = isolated(QString::fromStdString(place.name));
    const QString detail = placeDetailText(place);
    //: A place: its name, then its kind and size
    QStringList lines{detail.isEmpty() ? name : tr("%1: %2").arg(name, detail)};
    if (const auto grid = map_->georeference().toGrid(place.position)) {
        lines.append(positionText(preferences_.coordinates, *map_, *grid));
    }
    return lines.join(QLatin1Char('\n'));
}

// The position as it was read, then in the chosen format if that is another, then the elevation.
QString GoToDialog::answerFor(const FoundPlace& place)
{
    const Map& map = *place.map;
    const RasterInfo& info = map.info();
    const auto where = [&](const CoordinateFormat& format) {
        //: %1 is a position, %2 the CRS or the kind of latitude
        return tr("%1 (%2)").arg(positionText(format, map, place.grid), formatName(format, info));
    };
    const CoordinateFormat& format = preferences_.coordinates;
    QStringList lines{where(asRead(format, place.read_as, info))};
    if (const QString chosen = where(format); chosen != lines.front()) {
        lines.append(chosen);
    }
    const Heightfield& heightfield = map.heightfield();
    // The outermost half pixel has no surface: the elevation is that of the nearest sample.
    const GridPoint grid = clampedToSamples(map.georeference(), place.grid);
    const bool is_there = heightfield.isExact(grid);  // before the elevation is read
    const double height_m = heightfield.height(grid); // requests a tile that is not loaded
    if (!is_there && (heightfield.tiles()->isLoading() || heightfield.isExact(grid))) {
        arrival_timer_.start(kArrivalInterval);
    }
    if (!std::isfinite(height_m)) {
        lines.append(tr("No elevation there"));
        return lines.join(QLatin1Char('\n'));
    }
    const QString height = heightText(info, heightfield.range().value_or(HeightRange{}), height_m,
                                      preferences_.height_unit);
    const bool is_exact = is_there && !map.isPreview();
    //: An elevation that is not exact yet
    const QString shown = is_exact ? height : leftToRight(tr("≈ %1").arg(height));
    //: %1 is an elevation
    lines.append(tr("Elevation %1").arg(shown));
    return lines.join(QLatin1Char('\n'));
}

// Once: a key may press the button after it has already been taken by the field.
void GoToDialog::go()
{
    if (!isVisible()) {
        return;
    }
    if (const auto place = placeOnMaps(maps_, preferences_.coordinates, readAs(), entry().text)) {
        Q_EMIT placeChosen(*place);
        accept();
    } else if (const auto named = namedPlace()) {
        Q_EMIT nameChosen(*named);
        accept();
    }
}

} // namespace marsview
