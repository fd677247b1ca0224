// A dot is one point of OpenGL. The vertex shader looks up the depth of the terrain at its center,
// so that no depths are copied into the window's frame buffer and no pixel is tested.

#include "ui/render/dot_renderer.h"

#include "core/base/check.h"
#include "core/view/matrix.h"
#include "ui/render/opengl/gl_objects.h"
#include "ui/render/opengl/gl_program.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace marsview {
namespace {

// As of lines.
constexpr double kBorderPoints = 1.25;
constexpr float kHiddenAlpha = 0.35F;

// Dots are nearer to the eye than they are by so many pixels of their place: the picture of the
// terrain is off by some, and as steep to the view.
constexpr double kLiftPixels = 12.0;

constexpr std::size_t kStampsMax = 16; // u_stamp_sides

constexpr const char* kVertex = R"(#version 330 core
layout(location = 0) in vec3 a_place; // from the anchor
layout(location = 1) in vec4 a_color; // a: the symbol
uniform mat4 u_matrix;
uniform vec3 u_anchor;  // from the eye
uniform vec2 u_size;    // of the picture, in pixels
uniform float u_margin; // around it; points with their center farther outside are not drawn
uniform float u_side;   // of a dot, in pixels
uniform float u_nearer; // share of the distance that remains
uniform vec2 u_depth_line; // the depth at a distance w is x - y / w
uniform bool u_is_snapped; // to whole pixels, as stamps are
uniform int u_stamp_sides[16]; // of their filled parts
uniform bool u_is_hidden;  // of discs, only hidden ones are drawn, otherwise only the others
uniform float u_hidden_alpha;
uniform sampler2D u_depths;
flat out vec3 v_color;
flat out ivec2 v_stamp; // its corner in the texture
flat out float v_side;
flat out float v_alpha;
void main()
{
    v_color = a_color.rgb;
    int symbol = int(a_color.a * 255.0 + 0.5);
    v_side = u_is_snapped ? float(u_stamp_sides[symbol]) : u_side;
    int side = int(u_side);
    int edge = (side - int(v_side)) / 2;
    v_stamp = ivec2(edge, symbol * side + edge);
    gl_PointSize = v_side;
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0); // outside
    vec4 clip = u_matrix * vec4(a_place + u_anchor, 1.0);
    if (clip.w <= 0.0 || clip.z < -clip.w) {
        return;
    }
    vec2 pixel = (clip.xy / clip.w + 1.0) * 0.5 * u_size;
    if (u_is_snapped) {
        pixel = floor(pixel - 0.5 * u_side + 0.5) + 0.5 * u_side;
    }
    float z = max(u_depth_line.x - u_depth_line.y / (clip.w * u_nearer), -1.0);
    ivec2 size = textureSize(u_depths, 0);
    ivec2 texel = clamp(ivec2(floor(pixel / u_size * vec2(size))), ivec2(0), size - 1);
    bool is_hidden = 0.5 * z + 0.5 > texelFetch(u_depths, texel, 0).r;
    v_alpha = is_hidden ? u_hidden_alpha : 1.0;
    if (u_is_snapped || is_hidden == u_is_hidden) {
        gl_Position =
            vec4((pixel + u_margin) / (u_size + 2.0 * u_margin) * 2.0 - 1.0, 0.0, 1.0);
    }
}
)";

// Colors are multiplied by their alpha.
constexpr const char* kDisc = R"(#version 330 core
flat in vec3 v_color;
uniform float u_side;
uniform float u_radius; // without the border, in pixels
uniform float u_border;
uniform bool u_is_hidden; // without a border, and whole pixels only
flat in float v_alpha;
out vec4 color;
void main()
{
    float away = length(gl_PointCoord - 0.5) * u_side;
    if (u_is_hidden) {
        if (away > u_radius) {
            discard;
        }
        color = vec4(v_color, 1.0) * v_alpha;
        return;
    }
    float inside = clamp(u_radius + 0.5 - away, 0.0, 1.0);
    float border = 0.6 * clamp(u_radius + u_border + 0.5 - away, 0.0, 1.0);
    color = vec4(v_color * inside, inside + (1.0 - inside) * border);
}
)";

constexpr const char* kStamp = R"(#version 330 core
flat in vec3 v_color;
flat in ivec2 v_stamp;
flat in float v_side;
flat in float v_alpha;
uniform sampler2D u_stamps;
out vec4 color;
void main()
{
    vec2 coverage = texelFetch(u_stamps, v_stamp + ivec2(gl_PointCoord * v_side), 0).rg;
    float inside = coverage.r * (1.0 - coverage.g);
    color = vec4(v_color * inside, inside + coverage.g) * v_alpha;
}
)";

struct Vertex {
    std::array<float, 3> place;
    std::array<std::uint8_t, 4> color;
};

} // namespace

struct DotRenderer::Impl {
    struct Slot {
        GlBuffer vertices;
        GlVertexArray array;
        GlTexture stamps;
        std::shared_ptr<const DotStamps> stamps_of;
        std::uint64_t revision = 0;
        ScenePoint anchor{};
        std::size_t count = 0;
    };

    GlProgram discs;
    GlProgram stamps;
    std::array<Slot, kSlots> slots;
    std::vector<Vertex> buffer; // kept, so that it need not be allocated again

    Impl(GlProgram disc_program, GlProgram stamp_program)
        : discs(std::move(disc_program))
        , stamps(std::move(stamp_program))
    {
        for (const Slot& slot : slots) {
            glBindVertexArray(slot.array.id());
            glBindBuffer(GL_ARRAY_BUFFER, slot.vertices.id());
            glEnableVertexAttribArray(0);
            glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                                  reinterpret_cast<const void*>(offsetof(Vertex, place))); // NOLINT
            glEnableVertexAttribArray(1);
            glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(Vertex),
                                  reinterpret_cast<const void*>(offsetof(Vertex, color))); // NOLINT
        }
        glBindVertexArray(0);
        glBindBuffer(GL_ARRAY_BUFFER, 0);
    }

    // Relative to the eye of the first picture, which is near the dots that are near.
    void send(Slot& slot, const DotSet& set, const ScenePoint& eye)
    {
        slot.anchor = eye;
        slot.count = set.dots.size();
        buffer.clear();
        for (const TerrainDot& dot : set.dots) {
            const Vec3 p = dot.place - eye;
            buffer.push_back(
                {.place = {static_cast<float>(p.x), static_cast<float>(p.y),
                           static_cast<float>(p.z)},
                 .color = {dot.color.red, dot.color.green, dot.color.blue, dot.symbol}});
        }
        glBindBuffer(GL_ARRAY_BUFFER, slot.vertices.id());
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(buffer.size() * sizeof(Vertex)),
                     buffer.data(), GL_DYNAMIC_DRAW);
        glBindBuffer(GL_ARRAY_BUFFER, 0);
    }

    static void sendStamps(Slot& slot, const std::shared_ptr<const DotStamps>& stamps)
    {
        slot.stamps_of = stamps;
        glBindTexture(GL_TEXTURE_2D, slot.stamps.id());
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RG8, stamps->side_px, stamps->side_px * stamps->count, 0,
                     GL_RG, GL_UNSIGNED_BYTE, stamps->coverage.data());
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
};

DotRenderer::DotRenderer(std::unique_ptr<Impl> impl)
    : impl_(std::move(impl))
{}

DotRenderer::~DotRenderer() = default;

Result<std::unique_ptr<DotRenderer>> DotRenderer::create()
{
    Result<GlProgram> discs = GlProgram::create(kVertex, kDisc);
    if (!discs) {
        return std::move(discs).error();
    }
    Result<GlProgram> stamps = GlProgram::create(kVertex, kStamp);
    if (!stamps) {
        return std::move(stamps).error();
    }
    return std::unique_ptr<DotRenderer>(new DotRenderer(
        std::make_unique<Impl>(std::move(discs).value(), std::move(stamps).value())));
}

void DotRenderer::draw(std::size_t index,
                       const DotSet& set,
                       std::uint64_t revision,
                       const LinePicture& picture,
                       const KeptDepths& depths)
{
    MARSVIEW_CHECK(index < kSlots && !picture.part);
    Impl::Slot& slot = impl_->slots[index];
    if (slot.revision != revision) {
        slot.revision = revision;
        impl_->send(slot, set, picture.camera.eye);
    }
    if (slot.count == 0) {
        return;
    }
    const GlProgram& program = set.stamps ? impl_->stamps : impl_->discs;
    const double radius_px = 0.5 * set.width_points * picture.pixels_per_point;
    const double border_px = kBorderPoints * picture.pixels_per_point;
    const double reach_px = set.stamps ? 0.5 * set.stamps->side_px : radius_px + border_px + 1.0;
    const auto side = static_cast<float>(2.0 * reach_px);
    const double pixel_share =
        2.0 * std::tan(picture.camera.field_of_view.radians() / 2.0) / picture.viewport.height;
    const double lift = std::min(kLiftPixels * pixel_share, 0.5);
    const int margin = static_cast<int>(std::ceil(reach_px));
    const ClipRange& clip = picture.clip;
    const Matrix4 matrix =
        projection(picture.camera, picture.viewport, clip) * viewRotation(picture.camera);
    std::array<GLfloat, 16> values{};
    std::transform(matrix.values.begin(), matrix.values.end(), values.begin(),
                   [](double value) { return static_cast<GLfloat>(value); });
    const Vec3 anchor = slot.anchor - picture.camera.eye;
    glUseProgram(program.id());
    glUniformMatrix4fv(program.uniform("u_matrix"), 1, GL_FALSE, values.data());
    glUniform3f(program.uniform("u_anchor"), static_cast<GLfloat>(anchor.x),
                static_cast<GLfloat>(anchor.y), static_cast<GLfloat>(anchor.z));
    glUniform2f(program.uniform("u_size"), static_cast<GLfloat>(picture.viewport.width),
                static_cast<GLfloat>(picture.viewport.height));
    glUniform1f(program.uniform("u_margin"), static_cast<GLfloat>(margin));
    glUniform1f(program.uniform("u_side"), side);
    glUniform1f(program.uniform("u_nearer"), static_cast<GLfloat>(1.0 - lift));
    const double depth_m = clip.far_m - clip.near_m;
    glUniform2f(program.uniform("u_depth_line"),
                static_cast<GLfloat>((clip.far_m + clip.near_m) / depth_m),
                static_cast<GLfloat>(2.0 * clip.far_m * clip.near_m / depth_m));
    glUniform1i(program.uniform("u_is_snapped"), set.stamps ? 1 : 0);
    glUniform1f(program.uniform("u_radius"), static_cast<GLfloat>(radius_px));
    glUniform1f(program.uniform("u_border"), static_cast<GLfloat>(border_px));
    glUniform1i(program.uniform("u_depths"), 0);
    glUniform1i(program.uniform("u_stamps"), 1);
    if (set.stamps) {
        MARSVIEW_CHECK(set.stamps->filled_sides_px.size() <= kStampsMax);
        glUniform1iv(program.uniform("u_stamp_sides"),
                     static_cast<GLsizei>(set.stamps->filled_sides_px.size()),
                     set.stamps->filled_sides_px.data());
        glActiveTexture(GL_TEXTURE1);
        if (slot.stamps_of != set.stamps) {
            Impl::sendStamps(slot, set.stamps);
        }
        glBindTexture(GL_TEXTURE_2D, slot.stamps.id());
    }
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, depths.texture);
    glBindVertexArray(slot.array.id());
    glViewport(-margin, -margin, picture.viewport.width + 2 * margin,
               picture.viewport.height + 2 * margin);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glUniform1f(program.uniform("u_hidden_alpha"), kHiddenAlpha);
    const auto pass = [&](bool is_hidden) {
        glUniform1i(program.uniform("u_is_hidden"), is_hidden ? 1 : 0);
        glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(slot.count));
    };
    if (!set.stamps) {
        // Every pixel once, or it would be less faint where hidden discs lie over each other.
        glEnable(GL_STENCIL_TEST);
        glStencilMask(0xFF);
        glClearStencil(0);
        glClear(GL_STENCIL_BUFFER_BIT);
        glStencilFunc(GL_NOTEQUAL, 1, 0xFF);
        glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
        pass(true);
        glDisable(GL_STENCIL_TEST);
    }
    pass(false);
    glDisable(GL_PROGRAM_POINT_SIZE);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glViewport(0, 0, picture.viewport.width, picture.viewport.height);
    if (set.stamps) {
        glActiveTexture(GL_TEXTURE1);
        glBindTexture(GL_TEXTURE_2D, 0);
        glActiveTexture(GL_TEXTURE0);
    }
    glBindTexture(GL_TEXTURE_2D, 0);
    glBindVertexArray(0);
    glUseProgram(0);
}

} // namespace marsview
