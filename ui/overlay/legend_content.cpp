#include "ui/overlay/legend_content.h"

#include "ui/text/coordinate_text.h"

namespace marsview {

LegendContent legendContent(const ShownLayer& layer, const LegendPicture& picture)
{
    const HeightRange all = layer.map->heightfield().range().value_or(HeightRange{});
    return {.mode = picture.look.mode,
            .ramp = layer.ramp,
            .range = colorRangeOf(layer),
            .slopes = slopeRangeOf(layer),
            .contour_interval_m =
                contourInterval(picture.look, all, picture.pixel_m, picture.exaggeration),
            .unit = picture.unit,
            .all = all,
            .layer = picture.layer,
            .datum = datumText(layer.map->info())};
}

} // namespace marsview
