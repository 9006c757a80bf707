// Set 1: the area lights, all in one texture of words: records, then vertices, points of cubature, and textures.
// See src/area_lights/mod.rs.
#ifndef BIND_AREA_LIGHTS_GLSL
#define BIND_AREA_LIGHTS_GLSL

layout(set = SET_scene, binding = SCENE_AREA_LIGHTS) uniform utexture2DArray area_texels;

uvec4 area_words(uint index) {
    return texelFetch(area_texels, ivec3(
            int(index & ((1u << AREA_WIDTH_LOG2) - 1u)),
            int((index >> AREA_WIDTH_LOG2) & ((1u << AREA_HEIGHT_LOG2) - 1u)),
            int(index >> (AREA_WIDTH_LOG2 + AREA_HEIGHT_LOG2))), 0);
}

// Flat lights are center + s u + t v: all of [−1, 1]², the ellipse in it, or what the rings enclose. Radiance leaves on
// the side of the normal, and on both of a two-sided one.
struct AreaLight {
    uint kind;  // AREA_POLYGON (rectangles too), AREA_ELLIPSE, AREA_LINE
    bool two_sided;
    bool textured;
    vec3 center;  // of a line: one end
    vec3 u;  // of a line: from that end to the other
    vec3 v;
    vec3 normal;  // unit
    float radius;  // of a line
    float extent;  // radius of a sphere about area_middle() that holds the light
    vec3 radiance;  // without the texture
    uint ring_first, ring_count;  // vertices of all rings
    uint piece_first, piece_count;  // of convex pieces, at most 8 each
    uint whole;  // the point that stands for the light
    uint coarse_first, coarse_count;  // points of cubature
    uint fine_first, fine_count;
    uint heap, level_count, width, height;  // texture
    vec3 uv_s, uv_t;  // (s, t, 1) to texture coordinates
};

AreaLight area_light(uint index) {
    uint texel = index << AREA_RECORD_LOG2;
    uvec4 center = area_words(texel);
    uvec4 u = area_words(texel + 1u);
    uvec4 v = area_words(texel + 2u);
    uvec4 normal = area_words(texel + 3u);
    uvec4 radiance = area_words(texel + 4u);
    uvec4 ranges = area_words(texel + 5u);
    uvec4 uv_s = area_words(texel + 6u);
    uvec4 uv_t = area_words(texel + 7u);
    AreaLight light;
    light.kind = center.w & ((1u << AREA_KIND_BITS) - 1u);
    light.two_sided = (center.w & AREA_TWO_SIDED) != 0u;
    light.textured = (center.w & AREA_TEXTURED) != 0u;
    light.center = uintBitsToFloat(center.xyz);
    light.u = uintBitsToFloat(u.xyz);
    light.v = uintBitsToFloat(v.xyz);
    light.normal = uintBitsToFloat(normal.xyz);
    light.radius = uintBitsToFloat(v.w);
    light.extent = uintBitsToFloat(u.w);
    light.radiance = uintBitsToFloat(radiance.xyz);
    light.ring_first = normal.w;
    light.ring_count = radiance.w;
    light.piece_first = ranges.x;
    light.piece_count = ranges.y;
    light.whole = ranges.z;
    light.coarse_first = ranges.z + 1u;
    light.coarse_count = ranges.w & 0xffffu;
    light.fine_first = light.coarse_first + light.coarse_count;
    light.fine_count = ranges.w >> 16;
    light.heap = uv_s.w;
    light.width = uv_t.w & 0xffffu;
    light.height = uv_t.w >> 16;
    light.level_count = uint(findMSB(max(max(light.width, light.height), 1u))) + 1u;
    light.uv_s = uintBitsToFloat(uv_s.xyz);
    light.uv_t = uintBitsToFloat(uv_t.xyz);
    return light;
}

// The centre of the sphere that holds the light.
vec3 area_middle(AreaLight light) {
    return light.kind == AREA_LINE ? light.center + 0.5 * light.u : light.center;
}

// Position, and 1 at the last vertex of a ring or piece. Counter-clockwise seen from the front; holes of rings the other
// way, so that what is summed around all rings is the light's.
vec4 area_vertex(uint index) { return uintBitsToFloat(area_words(index)); }

// Weight in m²; of a line, metres along its axis, each of which is 2 radius sin γ m² as seen under the angle γ from the
// axis. Radiance is the mean over the part of the light for which the point stands.
void area_point(uint index, out vec3 position, out float weight, out vec3 radiance) {
    vec4 place = uintBitsToFloat(area_words(2u * index));
    position = place.xyz;
    weight = place.w;
    radiance = uintBitsToFloat(area_words(2u * index + 1u).xyz);
}

vec3 area_bilinear(AreaLight light, vec2 uv, uint level) {
    uvec4 place = area_words(light.heap + level);
    vec2 size = vec2(place.yz);
    // Row 0 is on top, where v = 1.
    vec2 at = vec2(uv.x, 1.0 - uv.y) * size - 0.5;
    vec2 s = at - floor(at);
    vec2 low = clamp(floor(at), vec2(0.0), size - 1.0);
    vec2 high = clamp(floor(at) + 1.0, vec2(0.0), size - 1.0);
    uint top = light.heap + place.x + uint(low.y) * place.y;
    uint bottom = light.heap + place.x + uint(high.y) * place.y;
    vec3 a = uintBitsToFloat(area_words(top + uint(low.x)).xyz);
    vec3 b = uintBitsToFloat(area_words(top + uint(high.x)).xyz);
    vec3 c = uintBitsToFloat(area_words(bottom + uint(low.x)).xyz);
    vec3 d = uintBitsToFloat(area_words(bottom + uint(high.x)).xyz);
    return (1.0 - s.y) * ((1.0 - s.x) * a + s.x * b) + s.y * ((1.0 - s.x) * c + s.x * d);
}

// The texture of a light that has one, clamped at its edges; between two levels by the fraction of lod.
vec3 area_texel(AreaLight light, vec2 uv, float lod) {
    lod = clamp(lod, 0.0, float(light.level_count - 1u));
    uint level = uint(lod);
    float s = lod - float(level);
    uint next = min(level + 1u, light.level_count - 1u);
    return (1.0 - s) * area_bilinear(light, uv, level) + s * area_bilinear(light, uv, next);
}

#endif
