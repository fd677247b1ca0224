#include "core/contact/compared_models.h"

namespace marsview {

template std::unique_ptr<ContactModel>
makeComparedModel(ContactModelKind, const MeshSurface&, const ContactModelOptions&);
template std::unique_ptr<MapContactModel> makeComparedModel(
    ContactModelKind, const PlainHeightfieldSurface<std::int16_t>&, const ContactModelOptions&);
template std::unique_ptr<MapContactModel> makeComparedModel(ContactModelKind,
                                                            const PlainHeightfieldSurface<float>&,
                                                            const ContactModelOptions&);
template std::unique_ptr<MapContactModel>
makeComparedModel(ContactModelKind, const HeightfieldSurface&, const ContactModelOptions&);

} // namespace marsview
