// Apart from contact_model.cpp, as body_contact_model.cpp is.
#include "core/contact/contact_model.h"
#include "core/contact/contact_model_adapter.h"

namespace marsview {

std::unique_ptr<ContactModel> makeContactModel(ContactModelKind kind,
                                               const LayeredSurface& surface,
                                               const ContactModelOptions& options)
{
    return makeModel<ContactModel>(kind, surface, options);
}

} // namespace marsview
