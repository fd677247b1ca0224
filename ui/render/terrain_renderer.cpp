// The map is drawn as square patches of kPatchCells cells over the overview grid. All patches share
// one vertex and one index buffer; heights come from a texture. Positions are relative to the eye:
// the offset of a patch is formed in double, only what is within the patch in float.
//
// Colour comes per pixel from the relief map, which is finer than the triangles, and so do holes.

#include "ui/render/terrain_renderer.h"

#include "ui/render/gl_program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <limits>
#include <vector>

namespace marsview {
namespace {

constexpr int kPatchCells = 64;
constexpr int kPatchSide = kPatchCells + 1;
static_assert(kPatchSide * kPatchSide <= 65536, "indices are 16 bits wide");

// How much of a relief map is sent per draw: about 10 ms of copying, so that the window stays
// responsive while a new map arrives.
constexpr std::size_t kUploadBytes = std::size_t{24} << 20;

// In software (Mesa llvmpipe, 2 cores) 160 000 triangles keep turning a map fluent; a GPU hardly
// notices a million. Finer relief than the triangles' comes from the relief map in any case.
constexpr std::size_t kTrianglesInSoftware = 160'000;
constexpr std::size_t kTrianglesOnGpu = 1'000'000;

constexpr const char* kTerrainVertex = R"(#version 330 core
layout(location = 0) in vec2 a_cell;
uniform sampler2D u_heights;
uniform ivec2 u_first_vertex;
uniform ivec2 u_last_vertex;
uniform vec2 u_last_sample;
uniform float u_step;
uniform vec3 u_origin_from_eye;
uniform vec4 u_frame; // east per column, east per row, north per column, north per row
uniform float u_exaggeration;
uniform mat4 u_clip_from_eye;
out vec2 v_grid;
void main()
{
    ivec2 vertex = min(u_first_vertex + ivec2(a_cell), u_last_vertex);
    v_grid = min(vec2(vertex) * u_step, u_last_sample);
    vec2 local = v_grid - vec2(u_first_vertex) * u_step;
    float height = texelFetch(u_heights, vertex, 0).r;
    vec3 offset = vec3(dot(u_frame.xy, local), dot(u_frame.zw, local), height * u_exaggeration);
    gl_Position = u_clip_from_eye * vec4(u_origin_from_eye + offset, 1.0);
}
)";

constexpr const char* kTerrainFragment = R"(#version 330 core
in vec2 v_grid;
uniform sampler2D u_relief;
uniform sampler2D u_ramp;
uniform vec2 u_relief_scale; // texture coordinate of one sample
uniform bool u_has_voids;
uniform bool u_has_every_sample;
uniform vec2 u_tint; // share of the ramp = height's share of the range × x + y
uniform vec3 u_light;
uniform float u_stretch; // exaggeration over that of the relief map
out vec4 color;

// The triangles between samples, as core/terrain/triangulation.h cuts them.
bool isInHole(vec2 grid)
{
    ivec2 cell = clamp(ivec2(floor(grid)), ivec2(0), textureSize(u_relief, 0) - 2);
    vec2 f = grid - vec2(cell);
    float third = f.x >= f.y ? texelFetch(u_relief, cell + ivec2(1, 0), 0).a
                             : texelFetch(u_relief, cell + ivec2(0, 1), 0).a;
    return min(third, min(texelFetch(u_relief, cell, 0).a,
                          texelFetch(u_relief, cell + ivec2(1, 1), 0).a)) < 0.5;
}

void main()
{
    vec2 samples_per_pixel = fwidth(v_grid);
    vec4 relief = texture(u_relief, (v_grid + 0.5) * u_relief_scale);
    if (u_has_voids) {
        bool is_exact =
            u_has_every_sample && max(samples_per_pixel.x, samples_per_pixel.y) <= 1.0;
        if (relief.a == 0.0 || (is_exact ? isInHole(v_grid) : relief.a < 0.5)) {
            discard;
        }
        relief.rgb /= relief.a;
    }
    vec2 tilt = relief.rg * 2.0 - 1.0;
    float upright = sqrt(max(1.0 - dot(tilt, tilt), 1e-5));
    vec3 normal = normalize(vec3(tilt * u_stretch, upright));
    float shade = 0.28 + 0.84 * max(dot(normal, u_light), 0.0);
    // The middles of the first and the last of the ramp's 256 colours.
    float share = clamp(relief.b * u_tint.x + u_tint.y, 0.0, 1.0);
    vec3 tint = texture(u_ramp, vec2(share * (255.0 / 256.0) + 0.5 / 256.0, 0.5)).rgb;
    color = vec4(tint * shade, 1.0);
}
)";

constexpr const char* kSkyVertex = R"(#version 330 core
out float v_up;
void main()
{
    vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    v_up = p.y * 0.5 + 0.5;
    gl_Position = vec4(p, 0.0, 1.0);
}
)";

constexpr const char* kSkyFragment = R"(#version 330 core
in float v_up;
uniform vec3 u_top;
uniform vec3 u_bottom;
out vec4 color;
void main()
{
    color = vec4(mix(u_bottom, u_top, v_up), 1.0);
}
)";

struct Color3 {
    float red;
    float green;
    float blue;
};

Color3 asFloats(Rgb8 color)
{
    return {static_cast<float>(color.red) / 255.0F, static_cast<float>(color.green) / 255.0F,
            static_cast<float>(color.blue) / 255.0F};
}

class Texture {
public:
    Texture() { glGenTextures(1, &id_); }
    ~Texture() { glDeleteTextures(1, &id_); }
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;

    void bind(GLenum unit) const
    {
        glActiveTexture(unit);
        glBindTexture(GL_TEXTURE_2D, id_);
    }
    static void setFilters(GLint minify, GLint magnify)
    {
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minify);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, magnify);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }

private:
    GLuint id_ = 0;
};

// A square of overview cells, and the heights within, relative to the overview's base.
struct Patch {
    int first_column = 0;
    int first_row = 0;
    float minimum_m = 0.0F;
    float maximum_m = 0.0F;
};

std::vector<Patch> patchesOf(const OverviewGrid& grid)
{
    std::vector<Patch> patches;
    for (std::size_t row = 0; row + 1 < grid.rows; row += kPatchCells) {
        for (std::size_t column = 0; column + 1 < grid.columns; column += kPatchCells) {
            Patch patch{.first_column = static_cast<int>(column),
                        .first_row = static_cast<int>(row),
                        .minimum_m = std::numeric_limits<float>::infinity(),
                        .maximum_m = -std::numeric_limits<float>::infinity()};
            for (std::size_t r = row; r < std::min(row + kPatchSide, grid.rows); ++r) {
                for (std::size_t c = column; c < std::min(column + kPatchSide, grid.columns); ++c) {
                    // Written so that NaN changes nothing.
                    const float height = grid.height(c, r);
                    patch.minimum_m = height < patch.minimum_m ? height : patch.minimum_m;
                    patch.maximum_m = height > patch.maximum_m ? height : patch.maximum_m;
                }
            }
            if (patch.minimum_m <= patch.maximum_m) {
                patches.push_back(patch);
            }
        }
    }
    return patches;
}

// A map at the driver's, or on its way there.
struct Terrain {
    std::shared_ptr<const TerrainDrawData> data;
    std::vector<Patch> patches;
    Texture heights;
    Texture relief;
    std::size_t relief_rows_sent = 0;
    bool is_sent = false;

    explicit Terrain(std::shared_ptr<const TerrainDrawData> draw_data)
        : data(std::move(draw_data))
        , patches(patchesOf(data->overview))
    {}

    void sendMore()
    {
        const ReliefMap& map = data->relief;
        const auto columns = static_cast<GLsizei>(map.columns);
        const auto rows = static_cast<GLsizei>(map.rows);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        relief.bind(GL_TEXTURE0);
        if (relief_rows_sent == 0) {
            glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16, columns, rows, 0, GL_RGBA, GL_UNSIGNED_SHORT,
                         nullptr);
            Texture::setFilters(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
        }
        const std::size_t row_bytes = map.columns * 4 * sizeof(std::uint16_t);
        const std::size_t count = std::min(map.rows - relief_rows_sent,
                                           std::max<std::size_t>(1, kUploadBytes / row_bytes));
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, static_cast<GLint>(relief_rows_sent), columns,
                        static_cast<GLsizei>(count), GL_RGBA, GL_UNSIGNED_SHORT,
                        map.texels.data() + relief_rows_sent * map.columns * 4);
        relief_rows_sent += count;
        if (relief_rows_sent < map.rows) {
            return;
        }
        glGenerateMipmap(GL_TEXTURE_2D);
        sendHeights();
        is_sent = true;
    }

private:
    void sendHeights() const
    {
        const OverviewGrid& grid = data->overview;
        // Void vertices far from any height: the relief map cuts away all that hangs on them.
        std::vector<float> finite(grid.heights_m);
        std::replace_if(
            finite.begin(), finite.end(), [](float h) { return std::isnan(h); }, 0.0F);
        heights.bind(GL_TEXTURE0);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, static_cast<GLsizei>(grid.columns),
                     static_cast<GLsizei>(grid.rows), 0, GL_RED, GL_FLOAT, finite.data());
        Texture::setFilters(GL_NEAREST, GL_NEAREST);
    }
};

// The product of view and projection, and which boxes it keeps out of the picture.
struct ClipFromEye {
    Matrix4 matrix;

    // True where all corners lie beyond the same side of the picture.
    bool isOutside(const std::array<Vec3, 8>& corners) const
    {
        std::array<int, 5> beyond{};
        for (const Vec3& p : corners) {
            const auto row = [&](std::size_t i) {
                return matrix(i, 0) * p.x + matrix(i, 1) * p.y + matrix(i, 2) * p.z + matrix(i, 3);
            };
            const double x = row(0);
            const double y = row(1);
            const double w = row(3);
            beyond[0] += x < -w ? 1 : 0;
            beyond[1] += x > w ? 1 : 0;
            beyond[2] += y < -w ? 1 : 0;
            beyond[3] += y > w ? 1 : 0;
            beyond[4] += w <= 0.0 ? 1 : 0;
        }
        return std::any_of(beyond.begin(), beyond.end(), [](int count) { return count == 8; });
    }
};

} // namespace

struct TerrainRenderer::Impl {
    GlProgram terrain_program;
    GlProgram sky_program;
    std::string driver_name;
    RenderLimits render_limits;
    Texture ramp;
    const ColorRamp* sent_ramp = nullptr;
    GLuint patch_vertices = 0;
    GLuint patch_indices = 0;
    GLuint patch_array = 0;
    GLuint empty_array = 0;
    GLsizei index_count = 0;
    std::unique_ptr<Terrain> shown;
    std::unique_ptr<Terrain> coming;

    Impl(GlProgram terrain, GlProgram sky)
        : terrain_program(std::move(terrain))
        , sky_program(std::move(sky))
    {
        makePatchMesh();
        glGenVertexArrays(1, &empty_array);
    }
    ~Impl()
    {
        glDeleteVertexArrays(1, &empty_array);
        glDeleteVertexArrays(1, &patch_array);
        glDeleteBuffers(1, &patch_indices);
        glDeleteBuffers(1, &patch_vertices);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void makePatchMesh();
    void sendRamp(const ColorRamp& wanted);
    void drawSky(const DrawStyle& style) const;
    void drawTerrain(const OrbitCamera& camera, const DrawStyle& style, const Viewport& viewport);
};

void TerrainRenderer::Impl::makePatchMesh()
{
    std::vector<std::uint8_t> cells;
    cells.reserve(std::size_t{2} * kPatchSide * kPatchSide);
    for (int row = 0; row < kPatchSide; ++row) {
        for (int column = 0; column < kPatchSide; ++column) {
            cells.push_back(static_cast<std::uint8_t>(column));
            cells.push_back(static_cast<std::uint8_t>(row));
        }
    }
    std::vector<std::uint16_t> indices;
    indices.reserve(std::size_t{6} * kPatchCells * kPatchCells);
    for (int row = 0; row < kPatchCells; ++row) {
        for (int column = 0; column < kPatchCells; ++column) {
            const int upper_left = row * kPatchSide + column;
            const int lower_left = upper_left + kPatchSide;
            for (const int index : {upper_left, lower_left + 1, upper_left + 1, // upper
                                    upper_left, lower_left, lower_left + 1}) {  // lower
                indices.push_back(static_cast<std::uint16_t>(index));
            }
        }
    }
    index_count = static_cast<GLsizei>(indices.size());
    glGenVertexArrays(1, &patch_array);
    glGenBuffers(1, &patch_vertices);
    glGenBuffers(1, &patch_indices);
    glBindVertexArray(patch_array);
    glBindBuffer(GL_ARRAY_BUFFER, patch_vertices);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(cells.size()), cells.data(),
                 GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 2, GL_UNSIGNED_BYTE, GL_FALSE, 2, nullptr);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, patch_indices);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint16_t)), indices.data(),
                 GL_STATIC_DRAW);
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

void TerrainRenderer::Impl::sendRamp(const ColorRamp& wanted)
{
    if (sent_ramp == &wanted) {
        return;
    }
    const auto colors = sampledRamp(wanted);
    static_assert(sizeof(Rgb8) == 3);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    ramp.bind(GL_TEXTURE2);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, static_cast<GLsizei>(colors.size()), 1, 0, GL_RGB,
                 GL_UNSIGNED_BYTE, colors.data());
    Texture::setFilters(GL_LINEAR, GL_LINEAR);
    sent_ramp = &wanted;
}

void TerrainRenderer::Impl::drawSky(const DrawStyle& style) const
{
    const Color3 top = asFloats(style.sky_top);
    const Color3 bottom = asFloats(style.sky_bottom);
    glDisable(GL_DEPTH_TEST);
    glUseProgram(sky_program.id());
    glUniform3f(sky_program.uniform("u_top"), top.red, top.green, top.blue);
    glUniform3f(sky_program.uniform("u_bottom"), bottom.red, bottom.green, bottom.blue);
    glBindVertexArray(empty_array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void TerrainRenderer::Impl::drawTerrain(const OrbitCamera& camera,
                                        const DrawStyle& style,
                                        const Viewport& viewport)
{
    const TerrainDrawData& data = *shown->data;
    const SceneFrame& frame = data.frame;
    const OverviewGrid& grid = data.overview;
    const double step = static_cast<double>(grid.step);
    const double last_column = static_cast<double>(data.columns - 1);
    const double last_row = static_cast<double>(data.rows - 1);
    const SceneBox box = sceneBox(frame, data.columns, data.rows, data.range, style.exaggeration);
    const ClipFromEye clip{projection(camera, viewport, clipRange(camera, box)) *
                           viewRotation(camera)};
    const ScenePoint eye = eyeOf(camera);

    sendRamp(*style.ramp);
    shown->heights.bind(GL_TEXTURE0);
    shown->relief.bind(GL_TEXTURE1);
    ramp.bind(GL_TEXTURE2);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_CULL_FACE); // rasters that are mirrored or rotated turn the triangles around
    glDisable(GL_BLEND);

    const GlProgram& program = terrain_program;
    glUseProgram(program.id());
    glUniform1i(program.uniform("u_heights"), 0);
    glUniform1i(program.uniform("u_relief"), 1);
    glUniform1i(program.uniform("u_ramp"), 2);
    std::array<GLfloat, 16> matrix{};
    std::transform(clip.matrix.values.begin(), clip.matrix.values.end(), matrix.begin(),
                   [](double v) { return static_cast<GLfloat>(v); });
    glUniformMatrix4fv(program.uniform("u_clip_from_eye"), 1, GL_FALSE, matrix.data());
    glUniform4f(program.uniform("u_frame"), static_cast<GLfloat>(frame.east_per_column),
                static_cast<GLfloat>(frame.east_per_row),
                static_cast<GLfloat>(frame.north_per_column),
                static_cast<GLfloat>(frame.north_per_row));
    glUniform1f(program.uniform("u_step"), static_cast<GLfloat>(step));
    glUniform1f(program.uniform("u_exaggeration"), static_cast<GLfloat>(style.exaggeration));
    glUniform2i(program.uniform("u_last_vertex"), static_cast<GLint>(grid.columns - 1),
                static_cast<GLint>(grid.rows - 1));
    glUniform2f(program.uniform("u_last_sample"), static_cast<GLfloat>(last_column),
                static_cast<GLfloat>(last_row));
    const ReliefMap& relief = data.relief;
    glUniform2f(program.uniform("u_relief_scale"),
                1.0F / static_cast<GLfloat>(relief.columns * relief.step),
                1.0F / static_cast<GLfloat>(relief.rows * relief.step));
    glUniform1f(program.uniform("u_stretch"),
                static_cast<GLfloat>(style.exaggeration / relief.exaggeration));
    glUniform1i(program.uniform("u_has_voids"), relief.has_voids ? 1 : 0);
    glUniform1i(program.uniform("u_has_every_sample"), relief.step == 1 ? 1 : 0);
    const double relief_m = data.range.maximum_m - data.range.minimum_m;
    const double tinted_m = data.tint_range.maximum_m - data.tint_range.minimum_m;
    const double low_m = data.tint_range.minimum_m - data.range.minimum_m;
    // A flat map has the middle colour.
    glUniform2f(program.uniform("u_tint"),
                tinted_m > 0.0 ? static_cast<GLfloat>(relief_m / tinted_m) : 0.0F,
                tinted_m > 0.0 ? static_cast<GLfloat>(-low_m / tinted_m) : 0.5F);
    const double level = std::cos(style.light_altitude.radians());
    glUniform3f(program.uniform("u_light"),
                static_cast<GLfloat>(level * std::sin(style.light_azimuth.radians())),
                static_cast<GLfloat>(level * std::cos(style.light_azimuth.radians())),
                static_cast<GLfloat>(std::sin(style.light_altitude.radians())));

    const GLint first_vertex = program.uniform("u_first_vertex");
    const GLint origin_from_eye = program.uniform("u_origin_from_eye");
    glBindVertexArray(patch_array);
    for (const Patch& patch : shown->patches) {
        const GridPoint first{patch.first_column * step, patch.first_row * step};
        const GridPoint last{std::min(first.column + kPatchCells * step, last_column),
                             std::min(first.row + kPatchCells * step, last_row)};
        std::array<Vec3, 8> corners{};
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const double height =
                static_cast<double>((i & 4U) != 0 ? patch.maximum_m : patch.minimum_m);
            corners[i] = frame.toScene({(i & 1U) != 0 ? last.column : first.column,
                                        (i & 2U) != 0 ? last.row : first.row},
                                       (height + grid.base_height_m) * style.exaggeration) -
                         eye;
        }
        if (clip.isOutside(corners)) {
            continue;
        }
        const Vec3 origin = frame.toScene(first, grid.base_height_m * style.exaggeration) - eye;
        glUniform2i(first_vertex, patch.first_column, patch.first_row);
        glUniform3f(origin_from_eye, static_cast<GLfloat>(origin.x), static_cast<GLfloat>(origin.y),
                    static_cast<GLfloat>(origin.z));
        glDrawElements(GL_TRIANGLES, index_count, GL_UNSIGNED_SHORT, nullptr);
    }
}

TerrainRenderer::TerrainRenderer(std::unique_ptr<Impl> impl)
    : impl_(std::move(impl))
{}

TerrainRenderer::~TerrainRenderer() = default;

Result<std::unique_ptr<TerrainRenderer>> TerrainRenderer::create()
{
    const int version = epoxy_gl_version();
    if (!epoxy_is_desktop_gl() || version < 33) {
        return Error{
            ErrorCode::Unsupported,
            fmt::format("OpenGL 3.3 is needed, the graphics driver offers {}{}.{}; install "
                        "a newer driver or Mesa's software one",
                        epoxy_is_desktop_gl() ? "" : "OpenGL ES ", version / 10, version % 10)};
    }
    Result<GlProgram> terrain = GlProgram::create(kTerrainVertex, kTerrainFragment);
    if (!terrain) {
        return std::move(terrain).error();
    }
    Result<GlProgram> sky = GlProgram::create(kSkyVertex, kSkyFragment);
    if (!sky) {
        return std::move(sky).error();
    }
    auto impl = std::make_unique<Impl>(std::move(terrain).value(), std::move(sky).value());
    impl->driver_name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const auto says = [&impl](const char* word) {
        return impl->driver_name.find(word) != std::string::npos;
    };
    const bool is_software = says("llvmpipe") || says("softpipe") || says("SwiftShader");
    GLint side = 1024;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &side);
    impl->render_limits = {.texture_side_max = static_cast<std::size_t>(std::max(side, 1024)),
                           .triangle_count_max =
                               is_software ? kTrianglesInSoftware : kTrianglesOnGpu};
    return std::unique_ptr<TerrainRenderer>(new TerrainRenderer(std::move(impl)));
}

RenderLimits TerrainRenderer::limits() const
{
    return impl_->render_limits;
}

const std::string& TerrainRenderer::driver() const
{
    return impl_->driver_name;
}

void TerrainRenderer::setTerrain(std::shared_ptr<const TerrainDrawData> data)
{
    impl_->coming.reset();
    if (data) {
        impl_->coming = std::make_unique<Terrain>(std::move(data));
    } else {
        impl_->shown.reset();
    }
}

bool TerrainRenderer::advance()
{
    if (impl_->coming) {
        impl_->coming->sendMore();
        if (impl_->coming->is_sent) {
            impl_->shown = std::move(impl_->coming);
        }
    }
    return isComplete();
}

void TerrainRenderer::draw(const OrbitCamera& camera,
                           const DrawStyle& style,
                           const Viewport& viewport)
{
    MARSVIEW_CHECK(style.ramp != nullptr);
    glViewport(0, 0, viewport.width, viewport.height);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    impl_->drawSky(style);
    if (impl_->shown) {
        impl_->drawTerrain(camera, style, viewport);
    }
    glBindVertexArray(0);
    glUseProgram(0);
    glActiveTexture(GL_TEXTURE0);
}

bool TerrainRenderer::isComplete() const
{
    return !impl_->coming;
}

} // namespace marsview
