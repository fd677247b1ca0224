// Annotations: points, lines and polygons that the user drew or opened, as the document holds them.
#pragma once

#include "core/base/job_monitor.h"
#include "core/base/result.h"
#include "core/geo/crs.h"
#include "core/vector/feature.h"
#include "core/vector/vector_file.h"
#include "core/view/color_ramp.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace marsview {

/// What annotations of one file have in common.
struct AnnotationSource {
    std::string name;       // of the file, as people read it; empty for those that were drawn
    std::optional<Crs> crs; // of the coordinates; empty: those of a map without a CRS
    std::vector<FeatureField> fields{};
};

struct Annotation {
    std::uint32_t id = 0; // unique in a list; greater ones were added later
    std::string name{};
    std::string note{};
    Rgb8 color{255, 221, 64};
    FeatureShape shape = FeatureShape::Point;
    std::vector<FeaturePart> parts{}; // in the CRS of the source
    std::vector<FieldValue> values{}; // of the source's fields, without name, note and color
    std::shared_ptr<const AnnotationSource> source{}; // never null in a list
    bool operator==(const Annotation&) const = default;
};

/// The annotations of a document, by id. A value: a copy costs a pointer for each thousand
/// annotations, a change copies a thousand.
class AnnotationList {
public:
    std::size_t size() const noexcept { return size_; }
    bool isEmpty() const noexcept { return size_ == 0; }
    /// For the next annotation that is added.
    std::uint32_t nextId() const noexcept { return next_id_; }

    /// Null if there is none.
    const Annotation* find(std::uint32_t id) const;
    void forEach(const std::function<void(const Annotation&)>& visit) const;

    /// With `added` at the end; they get ids in their order.
    AnnotationList withAdded(std::vector<Annotation> added) const;
    /// With another annotation of the same id; unchanged if there is none.
    AnnotationList withReplaced(Annotation annotation) const;
    AnnotationList without(const std::set<std::uint32_t>& ids) const;

    bool operator==(const AnnotationList&) const = default; // compares pointers: fast

private:
    using Chunk = std::vector<Annotation>; // by id, never empty

    std::size_t chunkOf(std::uint32_t id) const;

    std::vector<std::shared_ptr<const Chunk>> chunks_;
    std::size_t size_ = 0;
    std::uint32_t next_id_ = 1;
};

/// The features of a file as annotations. Fields called name, note (or description) and color (as
/// #RRGGBB) become those; the others stay attributes. Features without a color get `color`.
/// Coordinates without a CRS are longitude and latitude of the usual kind on the body of `map_crs`
/// if they can be, or else map coordinates.
std::vector<Annotation> annotationsOf(VectorFile file,
                                      const std::string& source_name,
                                      const std::optional<Crs>& map_crs,
                                      const Rgb8& color);

/// For writeVectorFile(): one layer with the fields name, note and color, and those of all sources.
/// In the CRS of the annotations, or, if they are in several, in longitude and latitude. Invalid if
/// a position cannot be converted.
Result<FeatureCollection> collectionOf(const AnnotationList& annotations);

} // namespace marsview
