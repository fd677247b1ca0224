#include "core/contact/contact_model.h"

#include "core/base/check.h"
#include "core/contact/contact_model_adapter.h"

#include <algorithm>
#include <iterator>

namespace marsview {
namespace {

constexpr std::array<std::string_view, kContactModelKinds.size()> kNames{
    "proxy-graph",        "surface-walk",  "continuous-walk",  "god-object",
    "god-object-release", "virtual-proxy", "proxy-graph-2003",
};

} // namespace

std::string_view contactModelName(ContactModelKind kind) noexcept
{
    return kNames[static_cast<std::size_t>(kind)];
}

std::optional<ContactModelKind> contactModelKind(std::string_view name) noexcept
{
    const auto at = std::find(kNames.begin(), kNames.end(), name);
    return at == kNames.end()
               ? std::nullopt
               : std::optional(kContactModelKinds[static_cast<std::size_t>(at - kNames.begin())]);
}

std::unique_ptr<ContactModel> makeContactModel(ContactModelKind kind,
                                               const MeshSurface& surface,
                                               const ContactModelOptions& options)
{
    return makeModel<ContactModel>(kind, surface, options);
}

std::unique_ptr<MapContactModel> makeContactModel(ContactModelKind kind,
                                                  const HeightfieldSurface& surface,
                                                  const ContactModelOptions& options)
{
    if (PlainHeights<std::int16_t>::canRead(*surface.terrain())) {
        return makeMapModel<PlainHeightfieldSurface<std::int16_t>>(kind, surface, options);
    }
    if (PlainHeights<float>::canRead(*surface.terrain())) {
        return makeMapModel<PlainHeightfieldSurface<float>>(kind, surface, options);
    }
    return makeMapModel<HeightfieldSurface>(kind, surface, options);
}

} // namespace marsview
