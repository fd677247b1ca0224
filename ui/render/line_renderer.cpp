// Each segment is a rectangle on the screen, in which the fragment shader draws what lies within
// half a width of the segment. Ends are round, so that segments join without gaps. Where a segment
// begins at the end of another one, its rectangle begins square there: the round end of the other
// covers the rest. Software renderers spend most of the time on the pixels of the rectangles, which
// are therefore only as large as each pass needs.

#include "ui/render/line_renderer.h"

#include "core/view/matrix.h"
#include "ui/render/opengl/gl_objects.h"
#include "ui/render/opengl/gl_program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace marsview {
namespace {

constexpr double kBorderPoints = 1.25;
constexpr float kBorderAlpha = 0.6F;
constexpr float kHiddenAlpha = 0.35F;

// Lines are drawn nearer to the eye than they are, by this many times the half of their width. A
// line has one depth across its width, while the terrain below it may be as steep to the view as 1
// to this; and the mesh of the terrain is off by up to a pixel.
constexpr double kLiftPerReach = 6.0;

constexpr const char* kVertex = R"(#version 330 core
layout(location = 0) in vec4 a_ends;  // of the segment, in pixels
layout(location = 1) in vec2 a_corner; // along: 1 beyond the end, -1 before the begin, 0 at it
layout(location = 2) in float a_depth; // in normalized device coordinates
layout(location = 3) in vec3 a_color;
layout(location = 4) in float a_half_width; // in pixels
uniform float u_border;                     // in pixels
uniform vec2 u_size;                        // of the picture, in pixels
flat out vec4 v_ends;
flat out vec3 v_color;
flat out float v_half_width;
void main()
{
    v_ends = a_ends;
    v_color = a_color;
    v_half_width = a_half_width;
    vec2 along = a_ends.zw - a_ends.xy;
    float segment = length(along);
    along = segment > 0.0 ? along / segment : vec2(1.0, 0.0);
    // Half a pixel of coverage, and a little for rounding.
    vec2 reach = (a_half_width + u_border + 0.6) * a_corner;
    vec2 pixel = (a_corner.x > 0.0 ? a_ends.zw : a_ends.xy) + reach.x * along +
                 reach.y * vec2(-along.y, along.x);
    gl_Position = vec4(pixel * 2.0 / u_size - 1.0, a_depth, 1.0);
}
)";

constexpr const char* kFragment = R"(#version 330 core
flat in vec4 v_ends;
flat in vec3 v_color;
flat in float v_half_width;
uniform float u_border; // in pixels
uniform vec4 u_paint;   // a: alpha; rgb: the color where the line's is not used
uniform bool u_has_own_color;
uniform bool u_is_hard; // whole pixels only
uniform vec2 u_corner;  // of the frame buffer in the picture, in pixels
out vec4 color;
void main()
{
    vec2 along = v_ends.zw - v_ends.xy;
    vec2 from_begin = gl_FragCoord.xy + u_corner - v_ends.xy;
    float share = clamp(dot(from_begin, along) / max(dot(along, along), 1e-6), 0.0, 1.0);
    float coverage = clamp(v_half_width + u_border + 0.5 - length(from_begin - share * along),
                           0.0, 1.0);
    if (u_is_hard) {
        coverage = step(0.5, coverage);
    }
    if (coverage <= 0.0) {
        discard;
    }
    color = vec4(u_has_own_color ? v_color : u_paint.rgb, u_paint.a * coverage);
}
)";

struct Vertex {
    std::array<float, 4> ends;
    std::array<float, 2> corner;
    float depth;
    std::array<std::uint8_t, 4> color; // the last is unused
    float half_width;
};

constexpr std::size_t kCorners = 4; // of a rectangle
constexpr std::size_t kIndices = 6; // of its two triangles

// Homogeneous clip coordinates.
struct ClipPoint {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    double w = 0.0;
};

ClipPoint between(const ClipPoint& a, const ClipPoint& b, double share)
{
    const auto mix = [share](double from, double to) { return from + (to - from) * share; };
    return {mix(a.x, b.x), mix(a.y, b.y), mix(a.z, b.z), mix(a.w, b.w)};
}

struct DevicePoint {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
};

struct DeviceSegment {
    DevicePoint begin;
    DevicePoint end;
    bool is_begin_cut = false;
    bool is_end_cut = false;
};

// Scene to screen for one picture.
class Screen {
public:
    Screen(const CameraPose& camera, const Viewport& viewport, const ClipRange& clip)
        : eye_(camera.eye)
        , matrix_(projection(camera, viewport, clip) * viewRotation(camera))
        , viewport_(viewport)
        , infinite_z_((clip.far_m + clip.near_m) / (clip.far_m - clip.near_m))
        , pixel_share_(2.0 * std::tan(camera.field_of_view.radians() / 2.0) / viewport.height)
    {}

    // The depth of a point that is nearer to the eye by so many pixels of its place.
    double lifted(double z, double pixels) const
    {
        // z = a - b / w, where w is the distance along the view axis and a the z at infinity.
        const double share = 1.0 - std::min(pixels * pixel_share_, 0.5);
        return std::max(infinite_z_ + (z - infinite_z_) / share, -1.0);
    }

    ClipPoint clipPoint(const ScenePoint& point) const
    {
        const Vec3 p = point - eye_;
        const auto row = [&](std::size_t r) {
            return matrix_(r, 0) * p.x + matrix_(r, 1) * p.y + matrix_(r, 2) * p.z + matrix_(r, 3);
        };
        return {row(0), row(1), row(2), row(3)};
    }

    // The part of a segment before the near plane and the far one, and within a few pictures to
    // the sides, so that positions keep their precision as floats.
    std::optional<DeviceSegment> segment(const ClipPoint& a, const ClipPoint& b) const
    {
        double begin = 0.0;
        double end = 1.0;
        constexpr double kMargin = 3.0; // half pictures
        const auto keep = [&](double at_a, double at_b) {
            if (at_a < 0.0 && at_b < 0.0) {
                begin = 2.0;
            } else if (at_a < 0.0) {
                begin = std::max(begin, at_a / (at_a - at_b));
            } else if (at_b < 0.0) {
                end = std::min(end, at_a / (at_a - at_b));
            }
        };
        keep(a.w + a.z, b.w + b.z);
        keep(a.w - a.z, b.w - b.z);
        keep(kMargin * a.w + a.x, kMargin * b.w + b.x);
        keep(kMargin * a.w - a.x, kMargin * b.w - b.x);
        keep(kMargin * a.w + a.y, kMargin * b.w + b.y);
        keep(kMargin * a.w - a.y, kMargin * b.w - b.y);
        if (begin > end) {
            return std::nullopt;
        }
        return DeviceSegment{.begin = devicePoint(between(a, b, begin)),
                             .end = devicePoint(between(a, b, end)),
                             .is_begin_cut = begin > 0.0,
                             .is_end_cut = end < 1.0};
    }

    // Whether all that is within so many pixels of a line between two is on one side of the
    // picture.
    bool isAside(const PixelPoint& a, const PixelPoint& b, double reach) const
    {
        return std::max(a.x, b.x) < -reach || std::min(a.x, b.x) > viewport_.width + reach ||
               std::max(a.y, b.y) < -reach || std::min(a.y, b.y) > viewport_.height + reach;
    }

    PixelPoint pixel(const DevicePoint& p) const
    {
        return {(p.x + 1.0) * 0.5 * viewport_.width, (p.y + 1.0) * 0.5 * viewport_.height};
    }

private:
    static DevicePoint devicePoint(const ClipPoint& p) { return {p.x / p.w, p.y / p.w, p.z / p.w}; }

    ScenePoint eye_;
    Matrix4 matrix_;
    Viewport viewport_;
    double infinite_z_;  // of device coordinates
    double pixel_share_; // of the distance along the view axis: a pixel's side
};

// Encloses pixels, each with its surroundings.
class AreaFinder {
public:
    void include(const PixelPoint& pixel, double reach)
    {
        left_ = std::min(left_, pixel.x - reach);
        right_ = std::max(right_, pixel.x + reach);
        bottom_ = std::min(bottom_, pixel.y - reach);
        top_ = std::max(top_, pixel.y + reach);
    }
    // Of a picture; empty before the first pixel.
    PixelArea within(const Viewport& viewport) const
    {
        const auto inside = [](double value, int limit) {
            return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
        };
        const int first_column = inside(std::floor(left_), viewport.width);
        const int first_row = inside(std::floor(bottom_), viewport.height);
        return {.left = first_column,
                .bottom = first_row,
                .width = std::max(0, inside(std::ceil(right_), viewport.width) - first_column),
                .height = std::max(0, inside(std::ceil(top_), viewport.height) - first_row)};
    }

private:
    static constexpr double kFar = 1e9;

    double left_ = kFar;
    double right_ = -kFar;
    double bottom_ = kFar;
    double top_ = -kFar;
};

enum class SegmentBegin : std::uint8_t { Round, Square };

// The rectangle around a segment that its line can cover: `reach` pixels to all sides. False if
// that is outside the picture.
bool addSegment(std::vector<Vertex>& corners,
                const Screen& screen,
                const DeviceSegment& segment,
                SegmentBegin begin,
                double reach,
                const Vertex& paint,
                AreaFinder& area)
{
    const PixelPoint a = screen.pixel(segment.begin);
    const PixelPoint b = screen.pixel(segment.end);
    if (screen.isAside(a, b, reach)) {
        return false;
    }
    area.include(a, reach);
    area.include(b, reach);
    Vertex vertex = paint;
    vertex.ends = {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(b.x),
                   static_cast<float>(b.y)};
    const auto add = [&](double z, float along) {
        vertex.depth = static_cast<float>(screen.lifted(z, kLiftPerReach * reach));
        for (const float aside : {-1.0F, 1.0F}) {
            vertex.corner = {along, aside};
            corners.push_back(vertex);
        }
    };
    add(segment.begin.z, begin == SegmentBegin::Round ? -1.0F : 0.0F);
    add(segment.end.z, 1.0F);
    return true;
}

} // namespace

struct LineRenderer::Impl {
    GlProgram program;
    GlBuffer vertices;
    GlBuffer indices; // of rectangles one after the other
    std::size_t indexed = 0;
    GlVertexArray array;

    // What project() has found.
    std::optional<LinePicture> picture;
    std::vector<Vertex> corners;
    std::size_t faint_count = 0; // of rectangles

    explicit Impl(GlProgram compiled)
        : program(std::move(compiled))
    {
        glBindVertexArray(array.id());
        glBindBuffer(GL_ARRAY_BUFFER, vertices.id());
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.id());
        const auto attribute = [](GLuint location, GLint count, GLenum type, std::size_t offset) {
            glEnableVertexAttribArray(location);
            glVertexAttribPointer(location, count, type,
                                  type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE, sizeof(Vertex),
                                  reinterpret_cast<const void*>(offset)); // NOLINT: OpenGL's way
        };
        attribute(0, 4, GL_FLOAT, offsetof(Vertex, ends));
        attribute(1, 2, GL_FLOAT, offsetof(Vertex, corner));
        attribute(2, 1, GL_FLOAT, offsetof(Vertex, depth));
        attribute(3, 3, GL_UNSIGNED_BYTE, offsetof(Vertex, color));
        attribute(4, 1, GL_FLOAT, offsetof(Vertex, half_width));
        glBindVertexArray(0);
        glBindBuffer(GL_ARRAY_BUFFER, 0);
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    }

    // With the vertex array bound.
    void indexRectangles(std::size_t count)
    {
        if (count <= indexed) {
            return;
        }
        indexed = std::max(count, 2 * indexed);
        constexpr std::array<GLuint, kIndices> kTwoTriangles{0, 1, 2, 2, 1, 3};
        std::vector<GLuint> all;
        all.reserve(indexed * kIndices);
        for (std::size_t i = 0; i < indexed; ++i) {
            for (const GLuint corner : kTwoTriangles) {
                all.push_back(static_cast<GLuint>(i * kCorners) + corner);
            }
        }
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(all.size() * sizeof(GLuint)),
                     all.data(), GL_STATIC_DRAW);
    }

    struct Pass {
        double border_px = 0.0;
        float alpha = 1.0F;
        bool has_own_color = true;
        bool is_hard = false;
    };

    void draw(const Pass& pass, std::size_t rectangles) const
    {
        glUniform1f(program.uniform("u_border"), static_cast<GLfloat>(pass.border_px));
        glUniform4f(program.uniform("u_paint"), 0.0F, 0.0F, 0.0F, pass.alpha);
        glUniform1i(program.uniform("u_has_own_color"), pass.has_own_color ? 1 : 0);
        glUniform1i(program.uniform("u_is_hard"), pass.is_hard ? 1 : 0);
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(rectangles * kIndices), GL_UNSIGNED_INT,
                       nullptr);
    }

    // Every pixel once, or parts with several segments would be less faint.
    void drawHidden(std::size_t rectangles) const
    {
        glDepthFunc(GL_GREATER);
        glEnable(GL_STENCIL_TEST);
        glStencilMask(0xFF);
        glClearStencil(0);
        glClear(GL_STENCIL_BUFFER_BIT);
        glStencilFunc(GL_NOTEQUAL, 1, 0xFF);
        glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
        draw({.alpha = kHiddenAlpha, .is_hard = true}, rectangles);
        glDisable(GL_STENCIL_TEST);
    }
};

LineRenderer::LineRenderer(std::unique_ptr<Impl> impl)
    : impl_(std::move(impl))
{}

LineRenderer::~LineRenderer() = default;

Result<std::unique_ptr<LineRenderer>> LineRenderer::create()
{
    Result<GlProgram> program = GlProgram::create(kVertex, kFragment);
    if (!program) {
        return std::move(program).error();
    }
    return std::unique_ptr<LineRenderer>(
        new LineRenderer(std::make_unique<Impl>(std::move(program).value())));
}

PixelArea LineRenderer::project(std::span<const DrapedLine> lines, const LinePicture& picture)
{
    const Screen screen(picture.camera, picture.viewport, picture.clip);
    const double pixels_per_point = picture.pixels_per_point;
    const double border_px = kBorderPoints * pixels_per_point;
    AreaFinder area;
    impl_->picture = picture;
    std::vector<Vertex>& corners = impl_->corners; // keeps its memory
    corners.clear();
    const auto add = [&](const DrapedLine& line) {
        if (line.points.empty()) {
            return;
        }
        const double half_width = 0.5 * line.width_points * pixels_per_point;
        const Vertex paint{.ends = {},
                           .corner = {},
                           .depth = 0.0F,
                           .color = {line.color.red, line.color.green, line.color.blue, 0},
                           .half_width = static_cast<float>(half_width)};
        bool is_joint = false; // the segment before ends where this one begins
        ClipPoint from = screen.clipPoint(line.points.front());
        for (std::size_t i = 1; i < line.points.size(); ++i) {
            const ClipPoint to = screen.clipPoint(line.points[i]);
            const auto segment = screen.segment(from, to);
            const bool is_seen =
                segment && addSegment(corners, screen, *segment,
                                      is_joint && !segment->is_begin_cut ? SegmentBegin::Square
                                                                         : SegmentBegin::Round,
                                      half_width + border_px + 1.0, paint, area);
            is_joint = is_seen && !segment->is_end_cut;
            from = to;
        }
    };
    // Lines with faint parts first, since only these are drawn where the terrain hides them.
    for (const HiddenParts hidden_parts : {HiddenParts::Faint, HiddenParts::Invisible}) {
        for (const DrapedLine& line : lines) {
            if (line.hidden_parts == hidden_parts) {
                add(line);
            }
        }
        if (hidden_parts == HiddenParts::Faint) {
            impl_->faint_count = corners.size() / kCorners;
        }
    }
    return area.within(picture.viewport);
}

void LineRenderer::drawProjected()
{
    const std::vector<Vertex>& corners = impl_->corners;
    if (corners.empty()) {
        return;
    }
    const LinePicture& picture = *impl_->picture;
    const double border_px = kBorderPoints * picture.pixels_per_point;
    const std::size_t count = corners.size() / kCorners;
    glUseProgram(impl_->program.id());
    glBindVertexArray(impl_->array.id());
    glBindBuffer(GL_ARRAY_BUFFER, impl_->vertices.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(Vertex)),
                 corners.data(), GL_STREAM_DRAW);
    impl_->indexRectangles(count);
    const PixelArea part = picture.part.value_or(PixelArea{.left = 0,
                                                           .bottom = 0,
                                                           .width = picture.viewport.width,
                                                           .height = picture.viewport.height});
    glUniform2f(impl_->program.uniform("u_corner"), static_cast<GLfloat>(part.left),
                static_cast<GLfloat>(part.bottom));
    glUniform2f(impl_->program.uniform("u_size"), static_cast<GLfloat>(picture.viewport.width),
                static_cast<GLfloat>(picture.viewport.height));
    glViewport(-part.left, -part.bottom, picture.viewport.width, picture.viewport.height);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    if (impl_->faint_count > 0) {
        impl_->drawHidden(impl_->faint_count);
    }
    glDepthFunc(GL_LEQUAL);
    impl_->draw({.border_px = border_px, .alpha = kBorderAlpha, .has_own_color = false}, count);
    impl_->draw({}, count);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glViewport(0, 0, part.width, part.height);
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    glUseProgram(0);
}

} // namespace marsview
