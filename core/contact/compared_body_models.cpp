// Apart from compared_models.cpp, which programs without maps on bodies link (app/library).
#include "core/contact/compared_models.h"

namespace marsview {

template std::unique_ptr<ContactModel>
makeComparedModel(ContactModelKind, const BodySurface&, const ContactModelOptions&);
template std::unique_ptr<ContactModel>
makeComparedModel(ContactModelKind, const LayeredSurface&, const ContactModelOptions&);

} // namespace marsview
