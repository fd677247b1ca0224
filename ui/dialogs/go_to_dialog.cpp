#include "ui/dialogs/go_to_dialog.h"

#include "core/geo/coordinate_entry.h"
#include "core/geo/extent.h"
#include "ui/sentence.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

namespace marsview {
namespace {

// How often it is looked whether a height has come.
constexpr std::chrono::milliseconds kArrivalInterval{50};

QString kindName(CoordinateDisplay display, const RasterInfo& info)
{
    const QString name = displayName(display, info);
    //: How a coordinate is read: the order, then the CRS or the kind of latitude
    return display == CoordinateDisplay::Map ? GoToDialog::tr("x, y (%1)").arg(name)
                                             : GoToDialog::tr("Latitude, longitude (%1)").arg(name);
}

QString extentText(const Dataset& dataset, CoordinateDisplay display)
{
    const Georeference& georeference = dataset.georeference();
    if (display != CoordinateDisplay::Map) {
        if (const auto extent = geographicExtent(georeference)) {
            const auto corner = [&](Angle longitude, Angle latitude) {
                return geographicText({longitude, latitude}, display, dataset.info(), 2);
            };
            //: The corners of a map
            return GoToDialog::tr("%1 to %2")
                .arg(corner(extent->west, extent->south), corner(extent->east, extent->north));
        }
    }
    const MapExtent extent = mapExtent(georeference);
    //: The range of map coordinates: x from %1 to %2, y from %3 to %4
    return GoToDialog::tr("x %1 … %2, y %3 … %4")
        .arg(shortNumberText(extent.low.x, 9), shortNumberText(extent.high.x, 9),
             shortNumberText(extent.low.y, 9), shortNumberText(extent.high.y, 9));
}

// The outermost half pixel has no surface; a place there means the sample beside it.
std::optional<GridPoint> onSurface(const Heightfield& heights, GridPoint grid)
{
    const auto bounded = [](double place, std::size_t count) {
        const double last = static_cast<double>(count - 1);
        return place >= -0.5 - 1e-9 && place <= last + 0.5 + 1e-9
                   ? std::optional(std::clamp(place, 0.0, last))
                   : std::nullopt;
    };
    const auto column = bounded(grid.column, heights.columns());
    const auto row = bounded(grid.row, heights.rows());
    return column && row ? std::optional(GridPoint{*column, *row}) : std::nullopt;
}

} // namespace

Result<GridPoint> placeOnMap(const Dataset& dataset, CoordinateDisplay display, const QString& text)
{
    const Georeference& georeference = dataset.georeference();
    const std::string written = text.toStdString();
    std::optional<GridPoint> grid;
    if (display == CoordinateDisplay::Map) {
        const Result<MapPoint> point = mapPointFrom(written);
        if (!point) {
            return point.error();
        }
        grid = georeference.toGrid(*point);
    } else {
        const Result<WrittenPlace> place = placeFrom(written);
        if (!place) {
            return place.error();
        }
        const Ellipsoid& ellipsoid = *dataset.info().crs->ellipsoid();
        const Angle latitude = display == CoordinateDisplay::Planetographic
                                   ? ellipsoid.planetocentric(place->latitude)
                                   : place->latitude;
        grid = georeference.toGrid(GeographicPoint{place->longitude, latitude});
    }
    const auto on_surface = grid ? onSurface(dataset.heightfield(), *grid) : std::nullopt;
    if (!on_surface) {
        return Error{ErrorCode::OutOfRange,
                     GoToDialog::tr("This place lies outside the map, which covers %1.")
                         .arg(extentText(dataset, display))
                         .toStdString()};
    }
    return *on_surface;
}

GoToDialog::GoToDialog(std::shared_ptr<const Dataset> dataset,
                       const GoToEntry& last,
                       QWidget* parent)
    : QDialog(parent)
    , dataset_(std::move(dataset))
    , field_(new QLineEdit(last.text, this))
    , kind_(new QComboBox(this))
    , answer_(new QLabel(this))
{
    setWindowTitle(tr("Go to Coordinate"));
    kind_->setAccessibleName(tr("How the coordinate is read"));
    for (const CoordinateDisplay display : coordinateDisplays(dataset_->info())) {
        kind_->addItem(kindName(display, dataset_->info()), static_cast<int>(display));
    }
    const int wanted = last.display ? kind_->findData(static_cast<int>(*last.display)) : 0;
    kind_->setCurrentIndex(std::max(0, wanted)); // the usual one comes first
    kind_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    kind_->setMinimumContentsLength(30);
    field_->setAccessibleName(tr("Coordinate"));
    field_->setObjectName(QStringLiteral("coordinate"));
    field_->setClearButtonEnabled(true);
    field_->selectAll();
    answer_->setAccessibleName(tr("How the coordinate is understood"));
    answer_->setObjectName(QStringLiteral("answer"));
    answer_->setWordWrap(true);
    answer_->setMinimumHeight(3 * fontMetrics().lineSpacing()); // no jumps while typing
    answer_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    auto* form = new QFormLayout;
    form->addRow(tr("&Coordinate"), field_);
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
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    check();
}

GoToEntry GoToDialog::entry() const
{
    return {.display = kind_->currentIndex() > 0 ? std::optional(display()) : std::nullopt,
            .text = field_->text().trimmed()};
}

CoordinateDisplay GoToDialog::display() const
{
    return static_cast<CoordinateDisplay>(kind_->currentData().toInt());
}

void GoToDialog::check()
{
    const GoToEntry now = entry();
    const bool is_map = display() == CoordinateDisplay::Map;
    // Examples are the same in every language.
    field_->setPlaceholderText(is_map ? QStringLiteral("562345.5, 5117890")
                                      : QStringLiteral("18.65 N 226.2 E, 18°39′ N 133°48′ W"));
    if (now.text.isEmpty()) {
        answer_->setText(is_map ? tr("Two numbers, x and then y.")
                                : tr("Degrees, or degrees, minutes and seconds. Latitude comes "
                                     "first unless letters tell otherwise."));
        go_button_->setEnabled(false);
        return;
    }
    const Result<GridPoint> place = placeOnMap(*dataset_, display(), now.text);
    go_button_->setEnabled(place.has_value());
    if (!place) {
        answer_->setText(asSentence(place.error().message));
        return;
    }
    const Heightfield& heightfield = dataset_->heightfield();
    const bool is_there = heightfield.isExact(*place);  // before the height is read
    const double height_m = heightfield.height(*place); // asks for what is not there yet
    if (!is_there && (heightfield.tiles()->isLoading() || heightfield.isExact(*place))) {
        arrival_timer_.start(kArrivalInterval);
    }
    const bool is_exact = is_there && !dataset_->isPreview();
    const QString where =
        coordinateText(display(), dataset_->info(), dataset_->georeference(), *place);
    const QString height =
        heightText(dataset_->info(), heightfield.range().value_or(HeightRange{}), height_m);
    //: %1 is a position, %2 the height there
    answer_->setText(std::isfinite(height_m)
                         //: A height that is not quite sure yet
                         ? tr("%1, %2").arg(where, is_exact ? height : tr("≈ %1").arg(height))
                         //: %1 is a position
                         : tr("%1, no height there").arg(where));
}

void GoToDialog::go()
{
    const GoToEntry now = entry();
    if (const auto place = placeOnMap(*dataset_, display(), now.text)) {
        Q_EMIT placeChosen(*place);
        accept();
    }
}

} // namespace marsview
