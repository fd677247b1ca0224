// Any contact model over any surface, for programs that let the user choose.
#pragma once

#include "core/contact/body_surface.h"
#include "core/contact/contact.h"
#include "core/contact/heightfield_surface.h"
#include "core/contact/layered_surface.h"
#include "core/contact/mesh_surface.h"
#include "core/contact/resident_heights.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

namespace marsview {

enum class ContactModelKind : std::uint8_t {
    ProxyGraph,       // proxy_graph.h
    SurfaceWalk,      // surface_walk.h
    ContinuousWalk,   // continuous_walk.h
    GodObject,        // god_object.h, constraints kept within an update
    GodObjectRelease, // god_object.h, constraints released
    VirtualProxy,     // virtual_proxy.h
    ProxyGraph2003,   // proxy_graph_2003.h
};

inline constexpr std::array kContactModelKinds{
    ContactModelKind::ProxyGraph,       ContactModelKind::SurfaceWalk,
    ContactModelKind::ContinuousWalk,   ContactModelKind::GodObject,
    ContactModelKind::GodObjectRelease, ContactModelKind::VirtualProxy,
    ContactModelKind::ProxyGraph2003,
};

/// The model's name on the command line and in settings files, "proxy-graph".
std::string_view contactModelName(ContactModelKind kind) noexcept;
std::optional<ContactModelKind> contactModelKind(std::string_view name) noexcept;

struct ContactModelOptions {
    double radius_m = 1.0; // > 0, of VirtualProxy's sphere
};

/// The default model of all programs. ARCHITECTURE.md explains the choice.
inline constexpr ContactModelKind kContactModelDefault = ContactModelKind::ContinuousWalk;

///     const auto model = makeContactModel(kContactModelDefault, surface);
///     ContactState contact = model->place(goal); // then, once per update:
///     contact = model->update(goal);
///     const Vec3 force_n = stiffness_n_per_m * (contact.proxy - goal);
///
/// A running contact model. For one thread at a time; `place` and `update` are for the servo
/// thread.
class ContactModel {
public:
    virtual ~ContactModel() = default;
    ContactModel(const ContactModel&) = delete;
    ContactModel& operator=(const ContactModel&) = delete;

    /// Puts the proxy at the goal if that is above the surface, else on the surface straight above
    /// it, and minimizes the distance from there. A goal that is not finite, or whose elevation
    /// before exaggeration is outside ±1e12 m, changes nothing and is counted in
    /// ContactCounters::refused.
    virtual ContactState place(const ScenePoint& goal) noexcept = 0;
    /// Moves the proxy towards the goal. The first update places it. Goals that place() refuses
    /// change nothing and are counted.
    virtual ContactState update(const ScenePoint& goal) noexcept = 0;
    /// The result that update(goal) would have, without updating: a copy of the model moves. Loads
    /// into the processor's caches what that update needs.
    virtual ContactState rehearse(const ScenePoint& goal) const noexcept = 0;
    /// Where the proxy is, with the counters of the last update.
    virtual ContactState state() const noexcept = 0;
    /// Heights of the terrain have changed (TiledTerrain). In contact, the proxy stays where it is
    /// on the map and moves with it; a free proxy keeps its position, or is put onto the surface if
    /// it would be below.
    virtual void terrainChanged() noexcept = 0;

protected:
    ContactModel() = default;
};

/// A contact model over a map in the plane.
class MapContactModel : public ContactModel {
public:
    /// The same terrain at another exaggeration. The proxy is moved as in terrainChanged().
    virtual void setExaggeration(double exaggeration) noexcept = 0;
};

/// These allocate; the model shares what the surface shares. No height is read: another thread may
/// own the terrain, the one that is going to place the model.
std::unique_ptr<ContactModel> makeContactModel(ContactModelKind kind,
                                               const MeshSurface& surface,
                                               const ContactModelOptions& options = {});
std::unique_ptr<ContactModel> makeContactModel(ContactModelKind kind,
                                               const BodySurface& surface,
                                               const ContactModelOptions& options = {});
std::unique_ptr<ContactModel> makeContactModel(ContactModelKind kind,
                                               const LayeredSurface& surface,
                                               const ContactModelOptions& options = {});
std::unique_ptr<MapContactModel> makeContactModel(ContactModelKind kind,
                                                  const HeightfieldSurface& surface,
                                                  const ContactModelOptions& options = {});
std::unique_ptr<MapContactModel> makeContactModel(ContactModelKind kind,
                                                  const TiledHeightfieldSurface& surface,
                                                  const ContactModelOptions& options = {});

} // namespace marsview
