#include "core/contact/contact_model.h"
#include "core/contact/contact_model_adapter.h"
#include "core/contact/resident_heights.h"

namespace marsview {

std::unique_ptr<MapContactModel> makeContactModel(ContactModelKind kind,
                                                  const TiledHeightfieldSurface& surface,
                                                  const ContactModelOptions& options)
{
    if (ResidentHeights<std::int16_t>::canRead(*surface.terrain())) {
        return makeMapModel<TypedTiledSurface<std::int16_t>>(kind, surface, options);
    }
    if (ResidentHeights<float>::canRead(*surface.terrain())) {
        return makeMapModel<TypedTiledSurface<float>>(kind, surface, options);
    }
    return makeMapModel<TiledHeightfieldSurface>(kind, surface, options);
}

} // namespace marsview
