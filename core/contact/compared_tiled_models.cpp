// Apart from compared_models.cpp, which programs without maps in tiles link (app/library).
#include "core/contact/compared_models.h"
#include "core/contact/resident_heights.h"

namespace marsview {

template std::unique_ptr<MapContactModel> makeComparedModel(ContactModelKind,
                                                            const TypedTiledSurface<std::int16_t>&,
                                                            const ContactModelOptions&);
template std::unique_ptr<MapContactModel>
makeComparedModel(ContactModelKind, const TypedTiledSurface<float>&, const ContactModelOptions&);
template std::unique_ptr<MapContactModel>
makeComparedModel(ContactModelKind, const TiledHeightfieldSurface&, const ContactModelOptions&);

} // namespace marsview
