#include "core/feather/grid_ends.h"

#include "core/geo/body_layout.h"

namespace marsview {

GridEnds gridEnds(const Georeference& georeference)
{
    GridEnds ends{.columns = georeference.columns(),
                  .rows = georeference.rows(),
                  .first_row = 0,
                  .last_row = georeference.rows() - 1};
    if (!hasMeridiansAsColumns(georeference)) {
        return ends;
    }
    const Result<BodyLayout> layout = bodyLayout(georeference);
    if (!layout) {
        return ends;
    }
    ends.period = layout->wraps ? layout->columns : 0;
    ends.first_row =
        layout->closes_first ? std::nullopt : std::optional<std::size_t>(layout->first_row);
    ends.last_row = layout->closes_last
                        ? std::nullopt
                        : std::optional<std::size_t>(layout->first_row + layout->rows - 1);
    return ends;
}

} // namespace marsview
