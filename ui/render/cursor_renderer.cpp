// The meshes are small, so they are rebuilt for each frame, relative to the eye.

#include "ui/render/cursor_renderer.h"

#include "ui/render/opengl/gl_objects.h"
#include "ui/render/opengl/gl_program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace marsview {
namespace {

constexpr double kRadiusPoints = 8.0;
constexpr double kSpringPoints = 2.0; // its width

// No part of the cursor is further from its place and its shadow than this.
constexpr double kCursorReachPoints = 32.0;

// Around, and from pole to pole.
constexpr int kSectors = 24;
constexpr int kStacks = 12;

struct Color4 {
    float red;
    float green;
    float blue;
    float alpha;
};
constexpr Color4 kCursorColor{kCursorRed, kCursorGreen, kCursorBlue, 1.0F};
constexpr Color4 kGoalColor{1.0F, 0.86F, 0.42F, 0.85F};
constexpr Color4 kSpringColor{1.0F, 0.86F, 0.42F, 0.9F};
constexpr Color4 kShadowColor{0.0F, 0.0F, 0.0F, 0.38F};

constexpr const char* kVertex = R"(#version 330 core
layout(location = 0) in vec3 a_from_eye;
layout(location = 1) in vec3 a_normal; // zero: not lit
layout(location = 2) in vec4 a_color;
uniform mat4 u_clip_from_eye;
uniform float u_lift;
out vec4 v_color;
void main()
{
    const vec3 kLight = vec3(-0.45, 0.45, 0.77);
    float lit = dot(a_normal, a_normal) > 0.0 ? 0.62 + 0.5 * max(dot(a_normal, kLight), 0.0) : 1.0;
    v_color = vec4(a_color.rgb * lit, a_color.a);
    gl_Position = u_clip_from_eye * vec4(a_from_eye, 1.0);
    gl_Position.z -= u_lift * gl_Position.w;
}
)";

constexpr const char* kFragment = R"(#version 330 core
in vec4 v_color;
out vec4 color;
void main()
{
    color = v_color;
}
)";

struct Vertex {
    std::array<float, 3> from_eye;
    std::array<float, 3> normal;
    Color4 color;
};

std::array<float, 3> asFloats(const Vec3& v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

using Triangles = std::vector<Vertex>;

Vec3 onSphere(int stack, int sector)
{
    const double polar = std::numbers::pi * stack / kStacks;
    const double around = 2.0 * std::numbers::pi * sector / kSectors;
    return {std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
            std::cos(polar)};
}

Vec3 turned(const Vec3& v, const CursorAxes& axes)
{
    return axes.right * v.x + axes.ahead * v.y + axes.up * v.z;
}

// An ellipsoid with these half axes. Normals stay in the frame of the axes: so does the light.
void addEllipsoid(Triangles& triangles,
                  const Vec3& middle,
                  const Vec3& axes,
                  const CursorAxes& frame,
                  const Color4& color)
{
    const auto vertex = [&](int stack, int sector) {
        const Vec3 p = onSphere(stack, sector);
        return Vertex{asFloats(middle + turned({p.x * axes.x, p.y * axes.y, p.z * axes.z}, frame)),
                      asFloats(normalized({p.x / axes.x, p.y / axes.y, p.z / axes.z})), color};
    };
    for (int stack = 0; stack < kStacks; ++stack) {
        for (int sector = 0; sector < kSectors; ++sector) {
            triangles.insert(triangles.end(),
                             {vertex(stack, sector), vertex(stack + 1, sector),
                              vertex(stack + 1, sector + 1), vertex(stack, sector),
                              vertex(stack + 1, sector + 1), vertex(stack, sector + 1)});
        }
    }
}

// Upright, on its tip.
void addCone(Triangles& triangles,
             const Vec3& tip,
             double radius_m,
             double height_m,
             const CursorAxes& frame)
{
    const auto rim = [&](int sector) {
        const double around = 2.0 * std::numbers::pi * sector / kSectors;
        return turned({radius_m * std::cos(around), radius_m * std::sin(around), height_m}, frame);
    };
    const auto slant = [&](int sector) {
        const double around = 2.0 * std::numbers::pi * sector / kSectors;
        return asFloats(
            normalized({height_m * std::cos(around), height_m * std::sin(around), -radius_m}));
    };
    const Vec3 up{0.0, 0.0, 1.0};
    const Vec3 lid = tip + frame.up * height_m;
    for (int sector = 0; sector < kSectors; ++sector) {
        triangles.insert(triangles.end(),
                         {Vertex{asFloats(tip), slant(sector), kCursorColor},
                          Vertex{asFloats(tip + rim(sector)), slant(sector), kCursorColor},
                          Vertex{asFloats(tip + rim(sector + 1)), slant(sector + 1), kCursorColor},
                          Vertex{asFloats(lid), asFloats(up), kCursorColor},
                          Vertex{asFloats(tip + rim(sector)), asFloats(up), kCursorColor},
                          Vertex{asFloats(tip + rim(sector + 1)), asFloats(up), kCursorColor}});
    }
}

// A band of steady width that faces the eye. Ends relative to the eye.
void addBand(
    Triangles& triangles, const Vec3& from, const Vec3& to, double from_width_m, double to_width_m)
{
    Vec3 side = cross(to - from, from + to);
    const double side_length = length(side);
    if (!(side_length > 0.0)) {
        return; // seen end on
    }
    side = side * (0.5 / side_length);
    const auto vertex = [](const Vec3& p) {
        return Vertex{asFloats(p), {0.0F, 0.0F, 0.0F}, kSpringColor};
    };
    const Vertex a = vertex(from - side * from_width_m);
    const Vertex b = vertex(from + side * from_width_m);
    const Vertex c = vertex(to - side * to_width_m);
    const Vertex d = vertex(to + side * to_width_m);
    triangles.insert(triangles.end(), {a, b, c, c, b, d});
}

} // namespace

struct CursorRenderer::Impl {
    GlProgram program;
    GlBuffer vertices;
    GlVertexArray array;

    explicit Impl(GlProgram compiled)
        : program(std::move(compiled))
    {
        glBindVertexArray(array.id());
        glBindBuffer(GL_ARRAY_BUFFER, vertices.id());
        const auto attribute = [](GLuint location, GLint count, std::size_t offset) {
            glEnableVertexAttribArray(location);
            glVertexAttribPointer(location, count, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                                  reinterpret_cast<const void*>(offset)); // NOLINT: OpenGL's way
        };
        attribute(0, 3, offsetof(Vertex, from_eye));
        attribute(1, 3, offsetof(Vertex, normal));
        attribute(2, 4, offsetof(Vertex, color));
        glBindVertexArray(0);
        glBindBuffer(GL_ARRAY_BUFFER, 0);
    }

    void draw(const Triangles& triangles, double lift)
    {
        if (triangles.empty()) {
            return;
        }
        glUniform1f(program.uniform("u_lift"), static_cast<GLfloat>(lift));
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.size() * sizeof(Vertex)),
                     triangles.data(), GL_STREAM_DRAW);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(triangles.size()));
    }
};

CursorRenderer::CursorRenderer(std::unique_ptr<Impl> impl)
    : impl_(std::move(impl))
{}

CursorRenderer::~CursorRenderer() = default;

Result<std::unique_ptr<CursorRenderer>> CursorRenderer::create()
{
    Result<GlProgram> program = GlProgram::create(kVertex, kFragment);
    if (!program) {
        return std::move(program).error();
    }
    return std::unique_ptr<CursorRenderer>(
        new CursorRenderer(std::make_unique<Impl>(std::move(program).value())));
}

void CursorRenderer::draw(const CursorPicture& cursor,
                          const CameraPose& camera,
                          const Viewport& viewport,
                          const ClipRange& clip)
{
    const CursorAxes& axes = cursor.axes;
    const ScenePoint eye = camera.eye;
    const Vec3 at = cursor.position - eye;
    const double point_m =
        metersPerPixel(camera, viewport, cursor.position) * cursor.pixels_per_point;
    const double r = kRadiusPoints * point_m;
    if (!(r > 0.0)) {
        return; // behind the eye
    }

    glUseProgram(impl_->program.id());
    const Matrix4 matrix = projection(camera, viewport, clip) * viewRotation(camera);
    std::array<GLfloat, 16> values{};
    std::transform(matrix.values.begin(), matrix.values.end(), values.begin(),
                   [](double v) { return static_cast<GLfloat>(v); });
    glUniformMatrix4fv(impl_->program.uniform("u_clip_from_eye"), 1, GL_FALSE, values.data());
    glBindVertexArray(impl_->array.id());
    glBindBuffer(GL_ARRAY_BUFFER, impl_->vertices.id());
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);

    Triangles shadow;
    for (std::size_t i = 0; i < cursor.shadow.size(); ++i) {
        const ScenePoint& next = cursor.shadow[(i + 1) % cursor.shadow.size()];
        Vec3 middle{};
        for (const ScenePoint& p : cursor.shadow) {
            middle = middle + (p - eye) * (1.0 / static_cast<double>(cursor.shadow.size()));
        }
        for (const Vec3& p : {middle, cursor.shadow[i] - eye, next - eye}) {
            shadow.push_back({asFloats(p), {0.0F, 0.0F, 0.0F}, kShadowColor});
        }
    }
    // Over what the terrain's triangles make of the ground, which is a pixel off here and there.
    glDepthMask(GL_FALSE);
    impl_->draw(shadow, 2e-4);

    if (cursor.goal) {
        glDisable(GL_DEPTH_TEST);
        const Vec3 goal = *cursor.goal - eye;
        const double goal_point_m =
            metersPerPixel(camera, viewport, *cursor.goal) * cursor.pixels_per_point;
        Triangles spring;
        addBand(spring, at, goal, kSpringPoints * point_m, kSpringPoints * goal_point_m);
        const double g = 0.45 * kRadiusPoints * goal_point_m;
        addEllipsoid(spring, goal, {g, g, g}, axes, kGoalColor);
        impl_->draw(spring, 0.0);
        glEnable(GL_DEPTH_TEST);
    }

    glDepthMask(GL_TRUE);
    Triangles solid;
    switch (cursor.shape) {
    case CursorShape::Sphere:
        addEllipsoid(solid, at, {r, r, r}, axes, kCursorColor);
        break;
    case CursorShape::Cone:
        addCone(solid, at, r, 2.8 * r, axes);
        break;
    case CursorShape::FlatSphere:
        addEllipsoid(solid, at, {1.7 * r, 1.7 * r, 0.5 * r}, axes, kCursorColor);
        break;
    case CursorShape::LongSphere:
        addEllipsoid(solid, at, {0.65 * r, 0.65 * r, 2.0 * r}, axes, kCursorColor);
        break;
    }
    impl_->draw(solid, 1e-4);
    glDisable(GL_BLEND);
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glUseProgram(0);
}

PixelArea areaOfCursor(const CursorPicture& cursor, const CameraPose& camera, const Viewport& size)
{
    const double reach = kCursorReachPoints * cursor.pixels_per_point;
    std::vector<ScenePoint> points = cursor.shadow;
    points.push_back(cursor.position);
    double left = size.width;
    double right = 0.0;
    double top = size.height;
    double bottom = 0.0;
    for (const ScenePoint& point : points) {
        if (const auto pixel = project(camera, size, point)) {
            left = std::min(left, pixel->x - reach);
            right = std::max(right, pixel->x + reach);
            top = std::min(top, pixel->y - reach);
            bottom = std::max(bottom, pixel->y + reach);
        }
    }
    const auto inside = [](double value, int limit) {
        return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
    };
    const int first_column = inside(std::floor(left), size.width);
    const int first_row = inside(size.height - std::ceil(bottom), size.height);
    return {.left = first_column,
            .bottom = first_row,
            .width = std::max(0, inside(std::ceil(right), size.width) - first_column),
            .height = std::max(0, inside(size.height - std::floor(top), size.height) - first_row)};
}

} // namespace marsview
