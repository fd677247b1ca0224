#include "ui/panels/layer_model.h"

#include "ui/controllers/session_controller.h"
#include "ui/text/body_text.h"
#include "ui/text/sentence.h"

#include <QMimeData>

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

QString mimeType()
{
    return QStringLiteral("application/x-marsview-layer");
}

bool hasSameIds(const Session& a, const Session& b)
{
    return std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(),
                      [](const Layer& x, const Layer& y) { return x.id == y.id; });
}

} // namespace

LayerModel::LayerModel(QObject* parent)
    : QAbstractListModel(parent)
    , histograms_(new HistogramMaker(this))
{
    connect(histograms_, &HistogramMaker::made, this,
            [this](const std::shared_ptr<const Map>& map) {
                for (int row = 0; row < rowCount(); ++row) {
                    if (!isHeader(index(row)) && layerAt(index(row)).map == map) {
                        Q_EMIT dataChanged(index(row), index(row));
                    }
                }
            });
}

std::vector<LayerModel::Row> LayerModel::rowsOf(const Session& session)
{
    std::vector<Row> rows;
    const std::vector<LayerGroup> groups = layerGroups(session);
    for (const LayerGroup& group : groups) {
        if (groups.size() > 1) {
            rows.push_back({.is_header = true, .layer = group.layers.front()});
        }
        for (const std::size_t layer : group.layers) {
            rows.push_back({.is_header = false, .layer = layer});
        }
    }
    return rows;
}

void LayerModel::setSession(const Session& session)
{
    std::vector<Row> rows = rowsOf(session);
    const bool is_same_list = hasSameIds(session, session_) && rows == rows_;
    if (!is_same_list) {
        beginResetModel();
    }
    session_ = session;
    rows_ = std::move(rows);
    states_ = placement(session_);
    if (!is_same_list) {
        endResetModel();
    } else if (!rows_.empty()) {
        Q_EMIT dataChanged(index(0), index(rowCount() - 1));
    }
}

void LayerModel::setHeightUnit(HeightUnit unit)
{
    unit_ = unit;
    if (rowCount() > 0) {
        Q_EMIT dataChanged(index(0), index(rowCount() - 1));
    }
}

void LayerModel::setSceneOfBody(bool is_of_body)
{
    is_scene_of_body_ = is_of_body;
    if (rowCount() > 0) {
        Q_EMIT dataChanged(index(0), index(rowCount() - 1));
    }
}

void LayerModel::setUnplaced(std::vector<UnplacedLayer> layers)
{
    unplaced_ = std::move(layers);
    if (rowCount() > 0) {
        Q_EMIT dataChanged(index(0), index(rowCount() - 1));
    }
}

LayerId LayerModel::idAt(const QModelIndex& index) const
{
    return index.isValid() && !isHeader(index) ? layerAt(index).id : LayerId::None;
}

bool LayerModel::isHeader(const QModelIndex& index) const
{
    return index.isValid() && rows_[static_cast<std::size_t>(index.row())].is_header;
}

QModelIndex LayerModel::indexOfLayer(LayerId id) const
{
    const Row row{.is_header = false, .layer = indexOf(session_, id)};
    const auto hit = std::find(rows_.begin(), rows_.end(), row);
    return hit != rows_.end() ? index(static_cast<int>(hit - rows_.begin())) : QModelIndex();
}

std::shared_ptr<const HeightHistogram> LayerModel::histogramAt(const QModelIndex& index) const
{
    return histograms_->find(layerAt(index).map);
}

const ColorRamp& LayerModel::rampAt(const QModelIndex& index) const
{
    return rampOf(layerAt(index));
}

const Layer& LayerModel::layerAt(const QModelIndex& index) const
{
    return session_.layers[rows_[static_cast<std::size_t>(index.row())].layer];
}

LayerState LayerModel::stateAt(const QModelIndex& index) const
{
    const LayerState state = states_[rows_[static_cast<std::size_t>(index.row())].layer];
    const bool is_on_globe = is_scene_of_body_ && layerAt(index).map->info().body != nullptr;
    return is_on_globe && state == LayerState::OtherCrs ? LayerState::Shown : state;
}

// Null for one that the picture shows, or that is not to be in it.
const UnplacedLayer* LayerModel::unplacedAt(const QModelIndex& index) const
{
    if (!is_scene_of_body_ || stateAt(index) != LayerState::Shown) {
        return nullptr;
    }
    const auto found =
        std::find_if(unplaced_.begin(), unplaced_.end(),
                     [&](const UnplacedLayer& layer) { return layer.map == layerAt(index).map; });
    return found != unplaced_.end() ? &*found : nullptr;
}

int LayerModel::rowCount(const QModelIndex& parent) const
{
    return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

QString LayerModel::reasonAt(const QModelIndex& index) const
{
    if (const UnplacedLayer* unplaced = unplacedAt(index)) {
        //: Why a layer is not shown: %1 is a reason, such as "has samples beyond a pole"
        return tr("Hidden: it %1").arg(translatedMessage(unplaced->problem));
    }
    const auto shown = std::find(states_.begin(), states_.end(), LayerState::Shown);
    if (shown == states_.end()) {
        return {};
    }
    const Layer& scene = session_.layers[static_cast<std::size_t>(shown - states_.begin())];
    const Map& map = *layerAt(index).map;
    const RasterInfo& info = map.info();
    switch (stateAt(index)) {
    case LayerState::Shown:
    case LayerState::Hidden:
        break;
    case LayerState::OtherBody:
        //: Why a layer is not shown: %1 is its body, %2 the body that the view shows
        return tr("Hidden: on %1; the view shows %2")
            .arg(bodyInSentence(*info.body), bodyInSentence(*scene.map->info().body));
    case LayerState::OtherCrs:
        //: Why a layer is not shown: %1 is its coordinate system
        return tr("Hidden: its CRS, %1, is not that of the view")
            .arg(QString::fromStdString(info.crs->name()));
    case LayerState::UnknownPlace:
        return info.crs
                   //: Why a layer is not shown: %1 is the topmost layer
                   ? tr("Hidden: the view shows %1, which has no CRS")
                         .arg(QString::fromStdString(scene.name))
                   : tr("Hidden: no CRS, so its position in the view is unknown");
    }
    return {};
}

QVariant LayerModel::headerRowData(const QModelIndex& index, int role) const
{
    const Body* body = layerAt(index).map->info().body;
    switch (role) {
    case Qt::DisplayRole:
    case Qt::AccessibleTextRole:
        //: Above the layers without a known body
        return body != nullptr ? bodyName(*body) : tr("Unknown body");
    case IsHeaderRole:
        return true;
    case IsShownRole:
    case IsActiveRole:
        return false;
    default:
        return {};
    }
}

QString LayerModel::toolTipAt(const QModelIndex& index) const
{
    const QString path = QString::fromStdString(layerAt(index).map->spec().path);
    const QString reason = reasonAt(index);
    if (reason.isEmpty()) {
        return path;
    }
    return unplacedAt(index) != nullptr
               //: Tool tip: %1 says why a layer is not shown, %2 is its file
               ? tr("%1.\n%2").arg(reason, path)
               //: Tool tip: %1 says why a layer is not shown, %2 is its file
               : tr("%1. Click Show to show it instead.\n%2").arg(reason, path);
}

QString LayerModel::visibilityAt(const QModelIndex& index) const
{
    const QString reason = reasonAt(index);
    if (!reason.isEmpty()) {
        return unplacedAt(index) != nullptr ? reason : tr("%1. Press Space to show it").arg(reason);
    }
    return stateAt(index) == LayerState::Hidden ? tr("hidden")
           : layerAt(index).map->isPreview()    ? tr("shown as a preview")
                                                : tr("shown");
}

QVariant LayerModel::data(const QModelIndex& index, int role) const
{
    if (isHeader(index)) {
        return headerRowData(index, role);
    }
    const Layer& layer = layerAt(index);
    const RasterInfo& info = layer.map->info();
    const LayerState state = stateAt(index);
    const bool is_shown = state == LayerState::Shown && unplacedAt(index) == nullptr;
    const auto size = [&info] {
        //: Columns and rows of a map
        return leftToRight(tr("%1 × %2").arg(countText(info.columns), countText(info.rows)));
    };
    const auto range = [this, &layer] {
        return heightRangeText(layer.map->heightfield().range().value_or(HeightRange{}), unit_);
    };
    switch (role) {
    case Qt::DisplayRole:
    case Qt::EditRole:
        return QString::fromStdString(layer.name);
    case Qt::CheckStateRole:
        return is_shown                      ? Qt::Checked
               : state == LayerState::Hidden ? Qt::Unchecked
                                             : Qt::PartiallyChecked;
    case Qt::ToolTipRole:
        return toolTipAt(index);
    case Qt::AccessibleTextRole:
        //: For screen readers: name, state, columns × rows and range of elevations of a layer
        return tr("%1, %2, %3 samples, elevations %4")
            .arg(QString::fromStdString(layer.name), visibilityAt(index), size(), range());
    case SizeRole:
        return size();
    case RangeRole:
        return range();
    case ReasonRole:
        return reasonAt(index);
    case CanShowRole:
        return state != LayerState::Shown && state != LayerState::Hidden;
    case NoteRole: {
        const QString reason = reasonAt(index);
        //: Of a layer: a smaller version of the map is shown
        return reason.isEmpty() && layer.map->isPreview() ? tr("Preview") : reason;
    }
    case IsShownRole:
        return is_shown;
    case IsActiveRole:
        return layer.id == session_.active;
    case IsHeaderRole:
        return false;
    default:
        return {};
    }
}

bool LayerModel::setData(const QModelIndex& index, const QVariant& value, int role)
{
    if (!index.isValid() || isHeader(index)) {
        return false;
    }
    if (role == Qt::CheckStateRole) {
        Q_EMIT visibilityRequested(idAt(index), value.toInt() == Qt::Checked);
        return true;
    }
    if (role == Qt::EditRole) {
        Q_EMIT nameRequested(idAt(index), value.toString());
        return true;
    }
    return false;
}

Qt::ItemFlags LayerModel::flags(const QModelIndex& index) const
{
    if (!index.isValid()) {
        return Qt::ItemIsDropEnabled; // between rows only: on a row would mean nothing
    }
    if (isHeader(index)) {
        return Qt::ItemNeverHasChildren;
    }
    return Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable | Qt::ItemIsEditable |
           Qt::ItemIsDragEnabled | Qt::ItemNeverHasChildren;
}

QStringList LayerModel::mimeTypes() const
{
    return {mimeType()};
}

QMimeData* LayerModel::mimeData(const QModelIndexList& indexes) const
{
    if (indexes.isEmpty()) {
        return nullptr;
    }
    auto* data = new QMimeData;
    data->setData(mimeType(), QByteArray::number(static_cast<uint>(idAt(indexes.constFirst()))));
    return data;
}

// Where a layer that is dropped above the row with that number goes in the session; the end of its
// group for -1.
std::optional<std::size_t> LayerModel::dropIndex(const QMimeData* data, int row) const
{
    if (!data->hasFormat(mimeType())) {
        return std::nullopt;
    }
    const LayerId id{data->data(mimeType()).toUInt()};
    const QModelIndex dragged = indexOfLayer(id);
    if (!dragged.isValid()) {
        return std::nullopt;
    }
    int first = dragged.row();
    while (first > 0 && !isHeader(index(first - 1))) {
        --first;
    }
    int end = dragged.row() + 1;
    while (end < rowCount() && !isHeader(index(end))) {
        ++end;
    }
    const int gap = row < 0 ? end : row;
    if (gap < first || gap > end) {
        return std::nullopt;
    }
    const int place = gap - first - (gap > dragged.row() ? 1 : 0);
    return indexForPlace(session_, id, static_cast<std::size_t>(place));
}

bool LayerModel::canDropMimeData(
    const QMimeData* data, Qt::DropAction action, int row, int, const QModelIndex&) const
{
    return action == Qt::MoveAction && dropIndex(data, row).has_value();
}

bool LayerModel::dropMimeData(
    const QMimeData* data, Qt::DropAction action, int row, int, const QModelIndex&)
{
    const std::optional<std::size_t> to = dropIndex(data, row);
    if (action != Qt::MoveAction || !to) {
        return false;
    }
    // Queued: the view is in the middle of its drag, and the model is about to change.
    const LayerId id{data->data(mimeType()).toUInt()};
    QMetaObject::invokeMethod(
        this, [this, id, to = *to] { Q_EMIT moveRequested(id, to); }, Qt::QueuedConnection);
    return true;
}

} // namespace marsview
