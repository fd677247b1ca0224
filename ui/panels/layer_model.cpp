#include "ui/panels/layer_model.h"

#include "ui/session_controller.h"

#include <QMimeData>

#include <algorithm>

namespace marsview {
namespace {

QString mimeType()
{
    return QStringLiteral("application/x-marsview-layer");
}

QString bodyName(const Dataset& dataset)
{
    const std::string_view name = dataset.info().body->name;
    return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
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
            [this](const std::shared_ptr<const Dataset>& dataset) {
                for (int row = 0; row < rowCount(); ++row) {
                    if (layerAt(index(row)).dataset == dataset) {
                        Q_EMIT dataChanged(index(row), index(row));
                    }
                }
            });
}

void LayerModel::setSession(const Session& session)
{
    const bool is_same_list = hasSameIds(session, session_);
    if (!is_same_list) {
        beginResetModel();
    }
    session_ = session;
    states_ = placement(session_);
    if (!is_same_list) {
        endResetModel();
    } else if (!session_.layers.empty()) {
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

LayerId LayerModel::idAt(const QModelIndex& index) const
{
    return index.isValid() ? layerAt(index).id : LayerId::None;
}

QModelIndex LayerModel::indexOfLayer(LayerId id) const
{
    const std::size_t row = indexOf(session_, id);
    return row < session_.layers.size() ? index(static_cast<int>(row)) : QModelIndex();
}

std::shared_ptr<const HeightHistogram> LayerModel::histogramAt(const QModelIndex& index) const
{
    return histograms_->find(layerAt(index).dataset);
}

const ColorRamp& LayerModel::rampAt(const QModelIndex& index) const
{
    return rampOf(layerAt(index));
}

const Layer& LayerModel::layerAt(const QModelIndex& index) const
{
    return session_.layers[static_cast<std::size_t>(index.row())];
}

int LayerModel::rowCount(const QModelIndex& parent) const
{
    return parent.isValid() ? 0 : static_cast<int>(session_.layers.size());
}

QString LayerModel::reasonAt(const QModelIndex& index) const
{
    const auto shown = std::find(states_.begin(), states_.end(), LayerState::Shown);
    if (shown == states_.end()) {
        return {};
    }
    const Layer& scene = session_.layers[static_cast<std::size_t>(shown - states_.begin())];
    const Dataset& dataset = *layerAt(index).dataset;
    switch (states_[static_cast<std::size_t>(index.row())]) {
    case LayerState::Shown:
    case LayerState::Hidden:
        break;
    case LayerState::OtherBody:
        //: Why a layer is not shown: %1 is its body, %2 the body of what is shown
        return tr("Not shown: other body, %1 beside %2")
            .arg(bodyName(dataset), bodyName(*scene.dataset));
    case LayerState::OtherCrs:
        //: Why a layer is not shown: %1 is its coordinate system
        return tr("Not shown: other CRS, %1")
            .arg(QString::fromStdString(dataset.info().crs->name()));
    case LayerState::UnknownPlace:
        return dataset.info().crs
                   //: Why a layer is not shown: %1 is the topmost layer
                   ? tr("Not shown: %1 has no CRS to place it by")
                         .arg(QString::fromStdString(scene.name))
                   : tr("Not shown: no CRS to place it by");
    }
    return {};
}

QVariant LayerModel::data(const QModelIndex& index, int role) const
{
    const Layer& layer = layerAt(index);
    const RasterInfo& info = layer.dataset->info();
    const LayerState state = states_[static_cast<std::size_t>(index.row())];
    const auto size = [&info] {
        //: Columns and rows of a map
        return tr("%1 × %2").arg(countText(info.columns), countText(info.rows));
    };
    const auto range = [this, &layer] {
        return heightRangeText(layer.dataset->heightfield().range().value_or(HeightRange{}), unit_);
    };
    switch (role) {
    case Qt::DisplayRole:
    case Qt::EditRole:
        return QString::fromStdString(layer.name);
    case Qt::CheckStateRole:
        return layer.is_visible ? Qt::Checked : Qt::Unchecked;
    case Qt::ToolTipRole: {
        const QString path = QString::fromStdString(layer.dataset->spec().path);
        const QString reason = reasonAt(index);
        //: Tool tip: %1 says why a layer is not shown, %2 is its file
        return reason.isEmpty()
                   ? path
                   : tr("%1. Move it to the top to show it instead.\n%2").arg(reason, path);
    }
    case Qt::AccessibleTextRole: {
        const QString reason = reasonAt(index);
        const QString visibility = !reason.isEmpty()             ? reason
                                   : state == LayerState::Hidden ? tr("hidden")
                                   : layer.dataset->isPreview()  ? tr("shown as a preview")
                                                                 : tr("shown");
        //: For screen readers: name, state, columns × rows and range of heights of a layer
        return tr("%1, %2, %3 samples, heights %4")
            .arg(QString::fromStdString(layer.name), visibility, size(), range());
    }
    case SizeRole:
        return size();
    case RangeRole:
        return range();
    case ReasonRole:
        return reasonAt(index);
    case NoteRole: {
        const QString reason = reasonAt(index);
        //: Of a layer: what is shown is a smaller version of the map
        return reason.isEmpty() && layer.dataset->isPreview() ? tr("Preview") : reason;
    }
    case IsShownRole:
        return state == LayerState::Shown;
    case IsActiveRole:
        return layer.id == session_.active;
    default:
        return {};
    }
}

bool LayerModel::setData(const QModelIndex& index, const QVariant& value, int role)
{
    if (!index.isValid()) {
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

bool LayerModel::dropMimeData(
    const QMimeData* data, Qt::DropAction action, int row, int, const QModelIndex&)
{
    if (action != Qt::MoveAction || !data->hasFormat(mimeType())) {
        return false;
    }
    const LayerId id{data->data(mimeType()).toUInt()};
    const std::size_t from = indexOf(session_, id);
    if (from == session_.layers.size()) {
        return false;
    }
    const std::size_t gap =
        row < 0 ? session_.layers.size() : static_cast<std::size_t>(row); // below the last
    // Queued: the view is in the middle of its drag, and the model is about to change.
    const std::size_t to = gap > from ? gap - 1 : gap;
    QMetaObject::invokeMethod(
        this, [this, id, to] { Q_EMIT moveRequested(id, to); }, Qt::QueuedConnection);
    return true;
}

} // namespace marsview
