#include "ui/render/terrain_shaders.h"

#include "core/base/check.h"

#include <fmt/format.h>

namespace marsview {
namespace {

// A vertex that is computed in two places of the program, as one of a node and as one that gives
// way, has the same bits in both. Without "precise", drivers may fuse other products and sums in
// each.
constexpr const char* kVertexStart = R"(#version 330 core
#extension GL_ARB_gpu_shader5 : enable
#ifdef GL_ARB_gpu_shader5
#define SAME_BITS precise
#else
#define SAME_BITS
#endif
)";

// Positions are samples relative to an anchor near the eye, and meters over the base height: whole
// numbers, the same for a sample whichever node it is drawn with, so that nodes that meet compute
// the same bits. See core/view/detail_selection.h for ranges and morphing.
constexpr const char* kTerrainVertex = R"(
#ifdef WALL
layout(location = 0) in vec4 a_wall; // cell; elevation of the map below; off the ellipsoid
layout(location = 8) in float a_is_top;
#else
layout(location = 0) in vec2 a_cell;
#endif
layout(location = 1) in vec3 a_place;
layout(location = 2) in vec4 a_slot;
layout(location = 3) in vec4 a_relief;
layout(location = 4) in vec2 a_uncle;
layout(location = 5) in vec4 a_parent;
layout(location = 6) in vec4 a_grandparent;
layout(location = 7) in vec3 a_color_heights;
uniform vec2 u_last_sample;
uniform mat4 u_clip_from_eye;
out float v_height;
out vec2 v_relief;
out vec2 v_sample; // relative to the anchor
flat out float v_layer;
flat out vec3 v_color_heights;
flat out float v_relief_per_sample;
out float v_exact; // 1 where the mesh has every sample
invariant gl_Position;

const float kNodeCells = 32.0;
const float kMorphEnd = 1.2;

// Between corners. Exact where a share is 0 or 1.
float between(vec4 corners, vec2 share)
{
    SAME_BITS vec2 side = corners.xz * (1.0 - share.x) + corners.yw * share.x;
    SAME_BITS float value = side.x * (1.0 - share.y) + side.y * share.y;
    return value;
}

// How far a vertex has given way to the next level, 0 … 1.
float morph(vec3 from_eye, vec4 ranges, vec2 share)
{
    float range = between(ranges, share);
    SAME_BITS float given = (length(from_eye) - range) / ((kMorphEnd - 1.0) * range);
    return clamp(given, 0.0, 1.0);
}

vec3 blend(vec3 from, vec3 to, float share)
{
    SAME_BITS vec3 mixed = from + (to - from) * share;
    return share <= 0.0 ? from : share >= 1.0 ? to : mixed;
}

vec2 sampleOf(vec2 cell)
{
    return min(a_place.xy + cell * a_place.z, u_last_sample);
}

// What colors need, from the vertex's column, row and height, and from how far it has given way.
void setSurface(vec3 p, float to_next)
{
    v_height = p.z;
    v_sample = p.xy;
    v_relief = (p.xy - a_place.xy) * a_relief.x + a_relief.yz;
    v_layer = a_relief.w;
    v_color_heights = a_color_heights;
    v_relief_per_sample = a_relief.x;
    v_exact = a_place.z > 1.5 ? 0.0 : 1.0 - to_next;
}

#ifndef BODY
uniform sampler2D u_heights;
uniform vec3 u_anchor_from_eye;
uniform vec4 u_frame; // east per column, east per row, north per column, north per row
uniform float u_exaggeration;

// Column, row, height.
vec3 vertexAt(vec2 cell)
{
    return vec3(sampleOf(cell), texelFetch(u_heights, ivec2(a_slot.xy + cell), 0).r);
}

vec3 fromEye(vec3 p)
{
    SAME_BITS vec3 place =
        vec3(dot(u_frame.xy, p.xy), dot(u_frame.zw, p.xy), p.z * u_exaggeration) +
        u_anchor_from_eye;
    return place;
}

void main()
{
    vec2 next_cell = 2.0 * floor(a_cell * 0.5);
    vec2 last_cell = 4.0 * floor(a_cell * 0.25);
    vec3 own = vertexAt(a_cell);
    vec3 next = vertexAt(next_cell);
    vec3 last = vertexAt(last_cell);
    float to_last = morph(fromEye(next), a_grandparent, a_uncle + next_cell / (4.0 * kNodeCells));
    float to_next = morph(fromEye(own), a_parent, a_slot.zw + a_cell / (2.0 * kNodeCells));
    vec3 p = blend(own, blend(next, last, to_last), to_next);
    setSurface(p, to_next);
    gl_Position = u_clip_from_eye * vec4(fromEye(p), 1.0);
}
#else
uniform sampler2D u_near;  // position within a cube of the lattice; height
uniform isampler2D u_far;  // cube
uniform sampler2D u_east;  // where the east and the north of the relief's slopes point, with the
uniform sampler2D u_north; // ratio of its lengths to those on the body
uniform vec3 u_eye_near;
uniform vec3 u_eye_far;
uniform float u_lattice; // side of a cube, a power of two
uniform float u_axes_squared;
uniform mat3 u_target;   // columns: east, north and up at the camera's target
uniform float u_exaggeration;
uniform vec4 u_pole[2];  // from the eye; height over the base
#ifndef WALL
out mat2 v_turn; // of slopes
#endif
out vec3 v_ray;          // from the eye, in the directions that slopes are turned to
#ifdef SUN
uniform vec3 u_sun; // toward it; its length is the strength of its light
uniform float u_slope_unit;
out vec3 v_light; // as u_light, at the vertex
#endif

#if COVERS > 0
uniform sampler2D u_cover_place[COVERS]; // shares of a cover; 1 near it
uniform vec3 u_cover_pole[2 * COVERS];
out vec3 v_cover[COVERS];

vec3 coverAt(sampler2D places, ivec2 own, ivec2 next, ivec2 last, float to_last, float to_next)
{
    return blend(texelFetch(places, own, 0).xyz,
                 blend(texelFetch(places, next, 0).xyz, texelFetch(places, last, 0).xyz, to_last),
                 to_next);
}
#endif

struct Vertex {
    vec3 p;       // from the eye
    vec3 surface; // column, row, height
    vec3 out_of;  // the body's center
    vec3 own;     // p without morphing
    float to_next;
    float to_last;
#if COVERS > 0
    vec3 cover[COVERS];
#endif
};

// A vertex's position has the same bits whichever node it is drawn with: a difference of cubes is
// exact, and so is its product with a power of two.
vec3 fromEye(vec3 cube, vec3 within)
{
    SAME_BITS vec3 place = (cube - u_eye_far) * u_lattice + (within - u_eye_near);
    return place;
}

// A map that ends within a node has all further vertices at its last column or row. They count as
// on the node's far side, so that both ends of a map around the body have the same ranges.
vec2 shareOf(vec2 share, vec2 at_sample)
{
    return vec2(at_sample.x >= u_last_sample.x ? 1.0 : share.x,
                at_sample.y >= u_last_sample.y ? 1.0 : share.y);
}

Vertex vertexAt(vec2 own_cell)
{
    vec2 next_cell = 2.0 * floor(own_cell * 0.5);
    vec2 last_cell = 4.0 * floor(own_cell * 0.25);
    ivec2 own_texel = ivec2(a_slot.xy + own_cell);
    ivec2 next_texel = ivec2(a_slot.xy + next_cell);
    ivec2 last_texel = ivec2(a_slot.xy + last_cell);
    vec4 own_near = texelFetch(u_near, own_texel, 0);
    vec4 next_near = texelFetch(u_near, next_texel, 0);
    vec4 last_near = texelFetch(u_near, last_texel, 0);
    vec3 own_far = vec3(texelFetch(u_far, own_texel, 0).xyz);
    vec3 own = fromEye(own_far, own_near.xyz);
    vec3 next = fromEye(vec3(texelFetch(u_far, next_texel, 0).xyz), next_near.xyz);
    vec3 last = fromEye(vec3(texelFetch(u_far, last_texel, 0).xyz), last_near.xyz);
    vec2 own_sample = sampleOf(own_cell);
    vec2 next_sample = sampleOf(next_cell);
    float to_last = morph(next, a_grandparent,
                          shareOf(a_uncle + next_cell / (4.0 * kNodeCells), next_sample));
    float to_next =
        morph(own, a_parent, shareOf(a_slot.zw + own_cell / (2.0 * kNodeCells), own_sample));
    Vertex v;
    v.p = blend(own, blend(next, last, to_last), to_next);
    v.surface = blend(vec3(own_sample, own_near.w),
                      blend(vec3(next_sample, next_near.w),
                            vec3(sampleOf(last_cell), last_near.w), to_last),
                      to_next);
    v.out_of = own_far * u_lattice + own_near.xyz;
    v.own = own;
    v.to_next = to_next;
    v.to_last = to_last;
    // Samplers of an array can be chosen by constants only.
#if COVERS > 0
    v.cover[0] = coverAt(u_cover_place[0], own_texel, next_texel, last_texel, to_last, to_next);
#endif
#if COVERS > 1
    v.cover[1] = coverAt(u_cover_place[1], own_texel, next_texel, last_texel, to_last, to_next);
#endif
#if COVERS > 2
    v.cover[2] = coverAt(u_cover_place[2], own_texel, next_texel, last_texel, to_last, to_next);
#endif
    return v;
}

#ifdef WALL
uniform float u_base;
uniform float u_pixel;         // meters at a distance of one
uniform float u_wall_above_px; // beyond the map below where that is higher: its mesh is not exact
uniform float u_wall_below_px; // beyond the lower one of the two surfaces, which hides it
out float v_step_px;           // height of the wall
out float v_beyond_px;         // above both surfaces

// Within the triangle of the mesh around a point.
Vertex vertexAround(vec2 point)
{
    vec2 cell = min(floor(point), vec2(kNodeCells - 1.0));
    vec2 f = point - cell;
    Vertex a = vertexAt(cell);
    Vertex b = vertexAt(cell + (f.x >= f.y ? vec2(1.0, 0.0) : vec2(0.0, 1.0)));
    Vertex c = vertexAt(cell + vec2(1.0));
    vec3 share = vec3(1.0 - max(f.x, f.y), abs(f.x - f.y), min(f.x, f.y));
    Vertex v;
    v.p = share.x * a.p + share.y * b.p + share.z * c.p;
    v.surface = share.x * a.surface + share.y * b.surface + share.z * c.surface;
    v.out_of = share.x * a.out_of + share.y * b.out_of + share.z * c.out_of;
    v.to_next = 1.0;
#if COVERS > 0
    for (int i = 0; i < COVERS; ++i) {
        v.cover[i] = share.x * a.cover[i] + share.y * b.cover[i] + share.z * c.cover[i];
    }
#endif
    return v;
}

// Where in two cells a point lies that morphing moves to t: the vertex between them moves to 0.
float beforeMorph(float t, float to_next)
{
    float first = 1.0 - to_next;
    return t <= first ? t / max(first, 1e-6) : 1.0 + (t - first) / (1.0 + to_next);
}

vec2 beforeMorph(vec2 t, float to_next)
{
    return vec2(beforeMorph(t.x, to_next), beforeMorph(t.y, to_next));
}

// A map that ends within a node has further vertices at its last column or row. The first ones may
// morph to samples before that; the mesh ends where one does not.
float atEnd(float cell, bool is_last)
{
    return is_last ? 4.0 * ceil(cell * 0.25) : cell;
}

// On the mesh as it is drawn, above a place. Vertices that morph move sideways too: by so much the
// point is looked for elsewhere. What is left, because they do not all move alike, is made up for
// along the mesh.
Vertex vertexOver(vec2 cell)
{
    vec2 from = vec2(atEnd(cell.x, sampleOf(cell).x >= u_last_sample.x),
                     atEnd(cell.y, sampleOf(cell).y >= u_last_sample.y));
    vec2 four = 4.0 * floor(from * 0.25);
    float to_last = vertexAt(min(four + 2.0, vec2(kNodeCells))).to_last;
    vec2 found = four + 2.0 * beforeMorph((from - four) * 0.5, to_last);
    vec2 two = 2.0 * floor(found * 0.5);
    Vertex middle = vertexAt(min(two + 1.0, vec2(kNodeCells)));
    found = two + beforeMorph(found - two, middle.to_next);
    Vertex v = vertexAround(found);
    vec2 base = min(floor(cell), vec2(kNodeCells - 1.0));
    vec2 samples = sampleOf(base + 1.0) - sampleOf(base);
    vec2 target = sampleOf(base) + (cell - base) * samples;
    vec2 rest = (target - v.surface.xy) / max(samples, vec2(1.0));
    vec3 own = vertexAt(base).own;
    v.p += rest.x * (vertexAt(base + vec2(1.0, 0.0)).own - own) +
           rest.y * (vertexAt(base + vec2(0.0, 1.0)).own - own);
    return v;
}

void main()
{
    Vertex v = vertexOver(a_wall.xy);
    vec3 up = normalize(vec3(v.out_of.xy, v.out_of.z * u_axes_squared));
    float step_m = a_wall.z > -1e29 ? a_wall.z - u_base - v.surface.z : 0.0;
    float rise = a_wall.z > -1e29 ? step_m * u_exaggeration + a_wall.w : 0.0;
    float pixel = u_pixel * length(v.p);
    bool is_top = a_is_top > 0.5;
    float above = rise > 0.0 ? rise + min(rise, u_wall_above_px * pixel) : 0.1 * pixel;
    float below = a_wall.z > -1e29 ? min(rise, 0.0) - u_wall_below_px * pixel : 0.0;
    v.surface.z += is_top ? max(step_m, 0.0) : min(step_m, 0.0);
    v.p += (is_top ? above : below) * up;
    v_step_px = abs(rise) / pixel;
    v_beyond_px = ((is_top ? above : below) - max(rise, 0.0)) / pixel;
#else
void main()
{
    bool is_pole = a_cell.y > kNodeCells;
    int pole = a_cell.y > 2.0 * kNodeCells ? 1 : 0;
    vec2 cell = is_pole ? vec2(a_cell.x, pole == 1 ? kNodeCells : 0.0) : a_cell;
    Vertex v = vertexAt(cell);
    vec3 up = normalize(vec3(v.out_of.xy, v.out_of.z * u_axes_squared));
    if (is_pole) {
        v.p = u_pole[pole].xyz;
        v.surface.z = u_pole[pole].w;
    }
#if COVERS > 0
    for (int i = 0; i < COVERS; ++i) {
        v.cover[i] = is_pole ? u_cover_pole[pole * COVERS + i] : v.cover[i];
    }
#endif
#endif
    setSurface(v.surface, v.to_next);
#if COVERS > 0
    v_cover = v.cover;
#endif
    // The directions at the target, turned the shortest way to the ground here.
    vec3 middle = (u_target[2] + up) / max(1.0 + dot(u_target[2], up), 1e-3);
    vec3 to_east = u_target[0] - dot(up, u_target[0]) * middle;
    vec3 to_north = u_target[1] - dot(up, u_target[1]) * middle;
#ifndef WALL
    vec3 east = texelFetch(u_east, ivec2(a_slot.xy + cell), 0).xyz;
    vec3 north = texelFetch(u_north, ivec2(a_slot.xy + cell), 0).xyz;
    v_turn = mat2(dot(east, to_east), dot(east, to_north), dot(north, to_east),
                  dot(north, to_north));
#endif
    v_ray = vec3(dot(v.p, to_east), dot(v.p, to_north), dot(v.p, up) / u_exaggeration);
#ifdef SUN
    v_light = vec3(-u_slope_unit * dot(to_east, u_sun), -u_slope_unit * dot(to_north, u_sun),
                   dot(up, u_sun));
#endif
    gl_Position = u_clip_from_eye * vec4(v.p, 1.0);
}
#endif
)";

constexpr const char* kTerrainFragment = R"(
in float v_height;
in vec2 v_relief;
in vec2 v_sample;
flat in float v_layer;
flat in vec3 v_color_heights;
uniform sampler2DArray u_relief; // the channels of ReliefTexel
uniform sampler2D u_ramp;
uniform float u_slope_square; // of the exaggerated slope of the texture's 1
uniform float u_slope_unit_true;
uniform vec2 u_slope_tint; // share of the ramp = slope in radians × x + y
uniform vec2 u_tint; // share of the ramp = height × x + y
#ifdef SUN
in vec3 v_light;           // light = (z + slope · xy) × length of the normal
#else
uniform vec3 u_light;      // likewise
uniform vec3 u_fill_light; // likewise
#endif
uniform float u_sample_px; // the width of a sample at a depth of 1, in pixels
in float v_exact;
out vec4 color;

#ifdef SUN
const float kDusk = 0.1;

// The body itself hides the sun from slopes that face it in the night: their light ends where the
// sun is 6 degrees below the horizon of the ellipsoid.
float shadeOf(vec2 slope)
{
    float shorten = inversesqrt(u_slope_square * dot(slope, slope) + 1.0);
    float facing = (v_light.z + dot(slope, v_light.xy)) * shorten;
    return max(facing, 0.0) * clamp(1.0 + v_light.z / (kDusk * SUN_SHARE), 0.0, 1.0) + NIGHT_SHARE;
}
#else
const float kAmbient = 0.28;
const float kFillLoss = 0.028;
const float kShadow = 2.4; // it ends where the light is 1 / kShadow

// A weak light from the side of the main one shows the relief of slopes that face away from that,
// and fades out as they turn to it: ground in full light keeps its contrast. The normal is
// (-slope × unit, 1), which is divided by its length last; the unit is part of the lights.
float shadeOf(vec2 slope)
{
    float shorten = inversesqrt(u_slope_square * dot(slope, slope) + 1.0);
    float facing = (u_light.z + dot(slope, u_light.xy)) * shorten;
    float fill = (u_fill_light.z + dot(slope, u_fill_light.xy)) * shorten - kFillLoss;
    float shadow = clamp(1.0 - kShadow * facing, 0.0, 1.0);
    return max(facing, 0.0) + kAmbient + shadow * shadow * fill;
}
#endif

vec3 rampColor(float share)
{
    // The ends lie in the middles of the first and the last texel.
    return texture(u_ramp, vec2(share * (1.0 - 1.0 / RAMP_TEXELS) + 0.5 / RAMP_TEXELS, 0.5)).rgb;
}

const float kTexels = 256.0;
const float kBorder = 8.0;

#ifdef VOIDS
// The triangles between samples, as core/terrain/triangulation.h cuts them.
bool isInHole(vec2 place)
{
    ivec2 cell = ivec2(floor(place));
    vec2 f = place - vec2(cell);
    int layer = int(v_layer + 0.5);
    float third = texelFetch(u_relief, ivec3(cell + (f.x >= f.y ? ivec2(1, 0) : ivec2(0, 1)),
                                             layer), 0).a;
    return min(third, min(texelFetch(u_relief, ivec3(cell, layer), 0).a,
                          texelFetch(u_relief, ivec3(cell + ivec2(1), layer), 0).a)) < 0.5;
}
#endif

#if COVERS > 0
uniform usampler2D u_cover[COVERS];
uniform vec4 u_cover_texture[COVERS]; // shares of the cover to its texture: × xy + zw

// Texels that the cover is drawn with, in its squares, at a depth of 1 m; the texture's last level;
// the least level at which Surrounded and Bare decide, and the first place that is looked at.
uniform vec4 u_cover_level[COVERS];

// Where the cover is drawn with texels of several samples, its edge and its walls lie up to one of
// those within: so does this one, and further.
int levelOf(float relief_texel, float last_level)
{
    return min(relief_texel < 1.0 ? 0 : int(log2(relief_texel)) + 1, int(last_level));
}

// The bits of CoverTexture::CellBit around a place; the first one is that of the place's triangle.
// Software drivers take one level for a few neighboring pixels, here and for the size.
uint cellAt(usampler2D cover, vec2 texture_place, int level)
{
    ivec2 size = textureSize(cover, level);
    vec2 place = texture_place * vec2(size) - 0.5;
    vec2 cell = floor(place);
    vec2 f = place - cell;
    uint bits = texelFetch(cover, clamp(ivec2(cell) + 1, ivec2(0), size - 1), level).r;
    return f.x >= f.y ? bits : (bits & ~1u) | (bits >> 1 & 1u);
}

#ifdef BODY
in vec3 v_cover[COVERS];              // shares; 1 near the cover
uniform vec2 u_cover_overlap[COVERS]; // shares by which both maps are drawn at an edge
uniform vec4 u_cover_range[COVERS];   // least and most of the first share, and of the second
uniform float u_cover_turn[COVERS];   // of the first; 0 where the cover does not go around

// Texels of a relief's last level, in those of its first one.
const float kReliefLargest = 8.0;

// From the middle of a pixel to its samples, and a little more, in pixels.
const float kPixelReach = 0.6;

// Whether there is a surface at all corners of a square around the place. Ground that is seen at a
// low angle has larger texels, and holes as much larger in the picture. Most cells know by
// themselves; software drivers leave the loop once that is so for some neighboring pixels.
bool isUnder(usampler2D cover,
             vec3 share,
             vec4 range,
             float turn,
             vec2 overlap,
             vec4 to_texture,
             vec4 level)
{
    vec2 place = share.xy;
    place.x -= turn > 0.0 ? turn * floor(place.x / turn) : 0.0;
    // All samples of a pixel share its decision: the upper map has to cover them all.
    vec2 across = dFdx(share.xy);
    vec2 down = dFdy(share.xy);
    vec2 reach = kPixelReach * (abs(across) + abs(down));
    reach = max(overlap, mix(reach, vec2(0.0), greaterThan(reach, vec2(0.5)))); // another turn
    bool is_under = share.z > 0.999 &&
                    all(greaterThanEqual(place, range.xz + (reach - overlap))) &&
                    all(lessThanEqual(place, range.yw - (reach - overlap)));
    vec2 middle = place * to_texture.xy + to_texture.zw;
    vec2 to_corner = reach * to_texture.xy;
    float texel = level.x / gl_FragCoord.w;
    vec2 per_share = to_texture.xy * vec2(textureSize(cover, 0));
    float seen = max(length(across * per_share), length(down * per_share));
    int drawn_level = levelOf(clamp(seen, texel, kReliefLargest * texel), level.y);
    int looks = is_under ? 5 : 0;
    for (int i = int(level.w); i < looks; ++i) {
        bool is_middle = i == 0;
        vec2 corner = vec2((i & 1) == 0 ? -1.0 : 1.0, i < 3 ? -1.0 : 1.0);
        uint bits = cellAt(cover, is_middle ? middle : middle + to_corner * corner,
                           is_middle ? max(drawn_level, int(level.z)) : drawn_level);
        is_under = is_middle ? (bits & 8u) == 0u : (bits & 1u) != 0u;
        if (is_middle ? (bits & 12u) != 0u : !is_under) {
            break;
        }
    }
    return is_under;
}

#define IS_UNDER(i) \
    isUnder(u_cover[i], v_cover[i], u_cover_range[i], u_cover_turn[i], u_cover_overlap[i], u_cover_texture[i], u_cover_level[i])
#else
uniform vec4 u_cover_linear[COVERS]; // sample relative to the anchor to a share of the cover
uniform vec2 u_cover_offset[COVERS];

bool isUnder(usampler2D cover, vec4 linear, vec2 offset, vec4 to_texture, vec4 level)
{
    vec2 place = vec2(dot(linear.xy, v_sample), dot(linear.zw, v_sample)) + offset;
    return all(greaterThanEqual(place, vec2(0.0))) && all(lessThanEqual(place, vec2(1.0))) &&
           (cellAt(cover, place * to_texture.xy + to_texture.zw,
                   levelOf(level.x / gl_FragCoord.w, level.y)) & 1u) != 0u;
}

#define IS_UNDER(i) isUnder(u_cover[i], u_cover_linear[i], u_cover_offset[i], u_cover_texture[i], u_cover_level[i])
#endif

// Samplers of an array can be chosen by constants only.
bool isCovered()
{
    return IS_UNDER(0)
#if COVERS > 1
        || IS_UNDER(1)
#endif
#if COVERS > 2
        || IS_UNDER(2)
#endif
        ;
}
#endif

#ifdef CONTOURS
uniform vec2 u_contour;     // lines per metre, and the line at height 0
uniform float u_contour_px; // the width of a line, in pixels that are drawn

// The share of a line on this pixel: 1 width, every fifth 1.8. The second number is by how much the
// height differs between pixels.
float contour(float height, float across)
{
    float line = height * u_contour.x + u_contour.y;
    float per_pixel = max(across * u_contour.x, 1e-6) * u_contour_px;
    float nearest = floor(line + 0.5);
    float width = abs(nearest - 5.0 * floor(nearest / 5.0 + 0.5)) < 0.25 ? 1.8 : 1.0;
    float ink = clamp(0.5 * width + 0.5 - abs(line - nearest) / per_pixel, 0.0, 1.0);
    // Where lines run together their mean darkness is left.
    return mix(ink, 0.4, clamp(4.0 * per_pixel - 1.0, 0.0, 1.0));
}
#endif

// From 0, where samples are at most half as wide as pixels, to 1, where they are as wide.
float largeSamples()
{
    return clamp(2.0 * u_sample_px * gl_FragCoord.w - 1.0, 0.0, 1.0);
}

// Over the base. The relief's, which has a texel for a pixel whatever the mesh: a mesh that is as
// exact as the picture shows can be much coarser than what colors and lines show. Where the mesh has
// every sample and those are larger than pixels, that of the triangles between them.
float colorHeight(float relief)
{
    float own = max(v_color_heights.z, v_exact * largeSamples());
    return mix(relief * v_color_heights.x + v_color_heights.y, v_height, own);
}

// Of ground that is partly void, the mean of the rest.
vec4 withoutVoids(vec4 relief)
{
#ifdef VOIDS
    relief.rgb /= max(relief.a, 0.5);
#endif
    return relief;
}

#ifdef WALL
in vec3 v_ray;
in float v_step_px;
in float v_beyond_px;

const float kWallSlopeMax = 50.0;

// Of a wall whose side toward the eye is seen, in units of the relief. Low steps and what reaches
// beyond the surfaces are lit like level ground, so that they show no line.
vec2 slopeOfWall()
{
    vec2 across = dFdx(v_ray.xy);
    vec2 down = dFdy(v_ray.xy);
    vec2 along = dot(across, across) > dot(down, down) ? across : down;
    vec2 away = vec2(along.y, -along.x) / max(length(along), 1e-20);
    away *= dot(away, v_ray.xy) < 0.0 ? -1.0 : 1.0;
    float steep = v_beyond_px > 0.0 ? 0.0 : min(v_step_px * v_step_px, kWallSlopeMax);
    return away * (steep * inversesqrt(u_slope_square));
}
#elif defined(BODY)
in mat2 v_turn;
in vec3 v_ray;

vec2 slopeOf(vec4 relief)
{
    return v_turn * relief.rg;
}
#else
vec2 slopeOf(vec4 relief)
{
    return relief.rg;
}
#endif

#ifdef RAY_CORRECTED
flat in float v_relief_per_sample;
#ifndef BODY
uniform vec3 u_ray[3]; // east, north and true height of a ray: [0] + pixel x × [1] + pixel y × [2]
#endif
uniform vec4 u_grid;   // column per east, per north, row per east, per north

const float kFacingMin = 0.1;       // of the sine of the angle between ray and ground
const float kShiftMax = 6.0 / 272.0; // texels: fewer than a tile's border

// Where samples are wider than pixels, colors are those of the triangles between them: the relief
// is bent there. The mesh may have fewer samples; where each has a texel, its triangle, as
// core/terrain/triangulation.h cuts them, is that of three texels.
struct Triangle {
    float height;
    vec2 slope;  // per unit of v_relief
    float share; // 0: the relief's height counts, 1: this one
};

Triangle triangleAt(vec2 place)
{
    float share = largeSamples() * (1.0 - v_color_heights.z);
    if (v_exact >= 1.0 || fract(v_layer) < 0.1) {
        share = 0.0;
    }
    if (share <= 0.0) {
        return Triangle(0.0, vec2(0.0), 0.0);
    }
    float side = kTexels + 2.0 * kBorder;
    vec2 texel = place * side - 0.5;
    ivec3 cell = ivec3(floor(texel), int(v_layer + 0.5));
    vec2 f = fract(texel);
    bool is_upper = f.x >= f.y;
    vec2 first = texelFetch(u_relief, cell, 0).ba;
    vec2 third = texelFetch(u_relief, cell + (is_upper ? ivec3(1, 0, 0) : ivec3(0, 1, 0)), 0).ba;
    vec2 last = texelFetch(u_relief, cell + ivec3(1, 1, 0), 0).ba;
#ifdef VOIDS
    share = min(first.y, min(third.y, last.y)) < 0.5 ? 0.0 : share;
#endif
    vec2 rise = vec2(third.x - first.x, last.x - third.x);
    rise = is_upper ? rise : rise.yx;
    return Triangle((first.x + dot(rise, f)) * v_color_heights.x + v_color_heights.y,
                    rise * (side * v_color_heights.x), share);
}

float heightOn(Triangle triangle, float relief)
{
    return mix(colorHeight(relief), triangle.height, triangle.share);
}

// How a ray moves over the relief, per unit of `ray`, which is in meters.
#ifdef BODY
vec3 rayHere()
{
    return v_ray;
}

vec2 alongRelief(vec3 ray)
{
    ray.xy = ray.xy * v_turn; // in the directions of the relief
#else
vec3 rayHere()
{
    return u_ray[0] + gl_FragCoord.x * u_ray[1] + gl_FragCoord.y * u_ray[2];
}

vec2 alongRelief(vec3 ray)
{
#endif
    return vec2(dot(u_grid.xy, ray.xy), dot(u_grid.zw, ray.xy)) * v_relief_per_sample;
}

// The mesh may be off by a pixel: where that shows other ground, colors are off by far more than a
// pixel's worth on slopes. A Newton step along the ray from the mesh to the relief, with its slope.
// Also finds the triangle there.
vec4 reliefOnRay(vec4 relief, out Triangle triangle)
{
    vec3 ray = rayHere();
    triangle = triangleAt(v_relief);
    float facing = dot(slopeOf(relief), ray.xy) * u_slope_unit_true - ray.z;
    float way = (v_height - heightOn(triangle, relief.b)) / max(facing, kFacingMin * length(ray));
    vec2 place = v_relief + clamp(alongRelief(ray) * way, -kShiftMax, kShiftMax);
    vec4 met = textureGrad(u_relief, vec3(place, v_layer), dFdx(v_relief), dFdy(v_relief));
#ifdef VOIDS
    if (met.a < 0.5) {
        return relief;
    }
    met = withoutVoids(met);
#endif
    triangle = triangleAt(place);
    return met;
}

#ifdef CONTOURS
// By how much the height differs between pixels. On a triangle this is the slope of its plane along
// the picture, since neighboring pixels may lie on other triangles: the differences on the mesh are
// carried along the rays to that plane.
float acrossPixels(float height, Triangle triangle)
{
    float seen = fwidth(height);
    vec3 ray = rayHere();
    float rise = dot(triangle.slope, alongRelief(ray));
    float facing = max(rise - ray.z, kFacingMin * length(ray));
    vec2 along_mesh = vec2(dot(triangle.slope, dFdx(v_relief)), dot(triangle.slope, dFdy(v_relief)));
    vec2 to_plane = (vec2(dFdx(v_height), dFdy(v_height)) - along_mesh) / facing;
    vec2 across = abs(along_mesh + rise * to_plane);
    return mix(seen, across.x + across.y, triangle.share);
}
#endif
#endif

void main()
{
#ifdef WALL
    vec2 slope = slopeOfWall();
    float height = v_height;
#else
    vec4 relief = withoutVoids(texture(u_relief, vec3(v_relief, v_layer)));
#ifdef VOIDS
    float share = relief.a;
#endif
#ifdef RAY_CORRECTED
    Triangle triangle;
    relief = reliefOnRay(relief, triangle);
    float height = heightOn(triangle, relief.b);
#else
    float height = colorHeight(relief.b);
#endif
    vec2 slope = slopeOf(relief);
#endif
#ifdef CONTOURS
    // Before any pixel is given up: these are differences between them.
#ifdef RAY_CORRECTED
    float across = acrossPixels(height, triangle);
#else
    float across = fwidth(height);
#endif
    float ink = contour(height, across);
#endif
#ifdef VOIDS
    vec2 texel = v_relief * (kTexels + 2.0 * kBorder);
    vec2 texels_per_pixel = fwidth(texel);
    // A layer that holds a texel a sample is marked by a fraction.
    bool is_exact = fract(v_layer) > 0.1 && max(texels_per_pixel.x, texels_per_pixel.y) <= 1.0;
    if (is_exact ? isInHole(texel - 0.5) : share < 0.5) {
        discard;
    }
#endif
#if COVERS > 0
    if (isCovered()) {
        discard;
    }
#endif
    float shade = shadeOf(slope);
#if MODE == 0
    vec3 surface = rampColor(height * u_tint.x + u_tint.y) * shade;
#elif MODE == 1
    vec3 surface = vec3(HILLSHADE_WHITE * shade);
#else
    float steep = atan(length(slope) * u_slope_unit_true);
    vec3 surface = rampColor(steep * u_slope_tint.x + u_slope_tint.y) * shade;
#endif
#ifdef CONTOURS
    surface = mix(surface, vec3(0.08, 0.07, 0.06), 0.7 * ink);
#endif
    color = vec4(surface, 1.0);
}
)";

constexpr const char* kSkyVertex = R"(#version 330 core
out float v_up;
void main()
{
    vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    v_up = p.y * 0.5 + 0.5;
    gl_Position = vec4(p, 1.0, 1.0);
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

std::string vertexSourceFor(const TerrainShaderKey& key)
{
    return fmt::format("{}#define COVERS {}\n{}{}{}{}", kVertexStart, key.cover_count,
                       key.is_on_body ? "#define BODY\n" : "", key.is_wall ? "#define WALL\n" : "",
                       key.is_sunlit ? "#define SUN\n" : "", kTerrainVertex);
}

Result<GlProgram> compiledTerrain(const TerrainShaderKey& key)
{
    const std::string fragment = fmt::format(
        "#version 330 core\n#define RAMP_TEXELS {}.0\n#define HILLSHADE_WHITE {:.4f}\n"
        "#define SUN_SHARE {:.4f}\n#define NIGHT_SHARE {:.4f}\n"
        "#define MODE {}\n#define COVERS {}\n{}{}{}{}{}{}{}",
        kRampTexels, kHillshadeWhite, kSunShare, kNightShare, static_cast<int>(key.mode),
        key.cover_count, key.has_contours ? "#define CONTOURS\n" : "",
        key.is_ray_corrected ? "#define RAY_CORRECTED\n" : "",
        key.has_voids ? "#define VOIDS\n" : "", key.is_on_body ? "#define BODY\n" : "",
        key.is_wall ? "#define WALL\n" : "", key.is_sunlit ? "#define SUN\n" : "",
        kTerrainFragment);
    return GlProgram::create(vertexSourceFor(key).c_str(), fragment.c_str());
}

} // namespace

Result<TerrainShaders> TerrainShaders::create()
{
    Result<GlProgram> sky = GlProgram::create(kSkyVertex, kSkyFragment);
    if (!sky) {
        return std::move(sky).error();
    }
    Result<GlProgram> terrain = compiledTerrain({});
    if (!terrain) {
        return std::move(terrain).error();
    }
    TerrainShaders shaders(std::move(sky).value());
    shaders.terrain_.emplace(TerrainShaderKey{}, std::move(terrain).value());
    return shaders;
}

const GlProgram& TerrainShaders::terrain(const TerrainShaderKey& key)
{
    const auto known = terrain_.find(key);
    if (known != terrain_.end()) {
        return known->second;
    }
    Result<GlProgram> program = compiledTerrain(key);
    MARSVIEW_CHECK(program.has_value());
    return terrain_.emplace(key, std::move(program).value()).first->second;
}

std::string TerrainShaders::vertexSource(bool is_on_body)
{
    return vertexSourceFor({.is_on_body = is_on_body});
}

} // namespace marsview
