// Apart from contact_model.cpp, which programs without maps on bodies link (app/library).
#include "core/contact/contact_model.h"
#include "core/contact/contact_model_adapter.h"

namespace marsview {

std::unique_ptr<ContactModel> makeContactModel(ContactModelKind kind,
                                               const BodySurface& surface,
                                               const ContactModelOptions& options)
{
    return makeModel<ContactModel>(kind, surface, options);
}

} // namespace marsview
