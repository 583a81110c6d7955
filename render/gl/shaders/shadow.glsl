// Shadows by maps of the depths that lights see (render/plan/shadow_maps.h).
#ifdef SHADOWED
struct ShadowLight {
    vec4 right, up, back;  // rows of lightFromEye
    vec4 facts;            // depth at distance 1, or 0; depth of a unit and at distance 0
    vec4 faces[6];         // scale, offset
    vec4 layers[2];
    vec4 depths[2];        // of cascades, two maps each: depth of a unit and at distance 0
};
layout(std140, binding = 1) uniform ShadowLights { ShadowLight shadowLights[SHADOWED]; };
layout(binding = 3) uniform sampler2DArray shadowDepths;  // reversed; beyond an edge 0: nothing
#ifdef SHADOW_CASCADE
const int kCascades = SHADOW_CASCADE;  // the first lights
#else
const int kCascades = 0;
#endif
#ifdef SHADOW_CUBE
const int kCubes = kCascades + SHADOW_CUBE;  // the next
#else
const int kCubes = kCascades;
#endif
uniform vec3 shadowOffset;  // texels, share of the distance; units, of faces turned away

// Of the pixel's surface: unit, towards its lit side; and how far drawn surfaces may be beside it.
vec3 receiverNormal;
vec3 receiverOffset = shadowOffset;

// Weighs the four texels round `corner` that are no nearer to the light than the receiver's plane,
// whose depth at texel (0, 0) is `depth`, and its change by a texel `slope`. Weights are products of
// `across` and `up`.
float litTexels(vec2 corner, vec2 size, float layer, float depth, vec2 slope, vec2 across, vec2 up) {
    vec4 stored = textureGather(shadowDepths, vec3(corner / size, layer));
    vec4 expected = depth + dot(slope, corner) -
                    vec4(slope.x, 0.0, slope.y, slope.x + slope.y);  // in the order gathered
    vec4 weights = vec4(across.x * up.y, across.y * up.y, across.y * up.x, across.x * up.x);
    return dot(weights, vec4(lessThanEqual(stored, max(expected, 0.0))));
}

// Percentage-closer filter of 3 x 3 texels (Reeves, Salesin, Cook 1987): each of 4 x 4 texels is
// compared with the depth of the receiver's tangent plane at the texel's own middle, so that no
// slope needs a bias. Of cascades it is the first, thus finest map that has the place and the texels
// round it. `index` is a constant: llvmpipe reads others for each pixel. It has no loops,
// which take llvmpipe several times as long.
#define FIND_SHARE(index) shares[index] = \
    shareOfLight(shadowLights[index], index >= kCascades && index < kCubes, index < kCascades, position)
#define TRY_MAP(i, layerOf, depthsOf)                                                        \
    if (all(lessThanEqual(abs(vec3(at.xy * light.faces[i].xy + light.faces[i].zw,            \
                                   2.0 * (depthsOf.y - depthsOf.x * at.z) - 1.0)),           \
                          vec3(inner, 1.0)))) {                                              \
        face = light.faces[i];                                                               \
        layer = layerOf;                                                                     \
        depths = depthsOf;                                                                   \
    }
float shareOfLight(ShadowLight light, bool isCube, bool isCascade, vec3 position) {
    vec2 size = vec2(textureSize(shadowDepths, 0).xy);
    float away = length(position);
    bool isPerspective = light.facts.x > 0.0;
    mat4x3 lightFromEye = transpose(mat3x4(light.right, light.up, light.back));
    vec3 place = lightFromEye * vec4(position, 1.0);
    vec3 normal = mat3(lightFromEye) * receiverNormal;
    vec4 face = light.faces[0];
    float layer = light.layers[0].x;
    vec2 depths = light.facts.yz;
#ifdef SHADOW_CASCADE
    if (isCascade) {
        vec2 inner = 1.0 - 5.0 / size;
        vec3 at = place;
#ifndef SURFACE
        if (normal.z <= 0.0) at += receiverOffset.z * normal;
#endif
        face = vec4(0.0);
        TRY_MAP(3, light.layers[0].w, light.depths[1].zw)
        TRY_MAP(2, light.layers[0].z, light.depths[1].xy)
        TRY_MAP(1, light.layers[0].y, light.depths[0].zw)
        TRY_MAP(0, light.layers[0].x, light.depths[0].xy)
    }
#endif
    if (isCube) {
        vec3 reach = abs(place);
        if (reach.x >= reach.y && reach.x >= reach.z) {
            bool isFirst = place.x > 0.0;
            face = isFirst ? light.faces[0] : light.faces[1];
            layer = isFirst ? light.layers[0].x : light.layers[0].y;
            vec3 turn = isFirst ? vec3(1.0, 1.0, -1.0) : vec3(-1.0, 1.0, 1.0);
            place = turn * place.zyx;
            normal = turn * normal.zyx;
        } else if (reach.y >= reach.z) {
            bool isFirst = place.y > 0.0;
            face = isFirst ? light.faces[2] : light.faces[3];
            layer = isFirst ? light.layers[0].z : light.layers[0].w;
            vec3 turn = isFirst ? vec3(-1.0, -1.0, -1.0) : vec3(1.0, -1.0, 1.0);
            place = turn * place.xzy;
            normal = turn * normal.xzy;
        } else {
            bool isFirst = place.z > 0.0;
            face = isFirst ? light.faces[4] : light.faces[5];
            layer = isFirst ? light.layers[1].x : light.layers[1].y;
            vec3 turn = isFirst ? vec3(-1.0, 1.0, -1.0) : vec3(1.0, 1.0, 1.0);
            place = turn * place;
            normal = turn * normal;
        }
    }
    float along = isPerspective ? max(-place.z, 1e-30) : 1.0;
    float texel = 2.0 * along / (size.x * max(min(face.x, face.y), 1e-30));
    float offset = receiverOffset.x * texel + receiverOffset.y * away;
#ifndef SURFACE
    // Light that a smooth normal lets in over the edge of its face must not end at the next face.
    bool isTurnedAway = (isPerspective ? -dot(normal, place) : normal.z) <= 0.0;
    if (isTurnedAway) offset += receiverOffset.z;
#endif
    place += offset * normal;
    if (isPerspective) along = max(-place.z, 1e-30);
    vec2 perTexel = 2.0 / (size * max(face.xy, 1e-30));  // in units of place / along
    vec2 texels = ((place.xy / along * face.xy + face.zw) * 0.5 + 0.5) * size - 0.5;
    texels = clamp(texels, vec2(-8.0), size + 8.0);  // what is farther beyond the map is as light
    // Planes are planes in the map as well: depth is linear across and up.
    float facing = isPerspective ? dot(normal, place) : normal.z;
    facing = abs(facing) < 1e-20 ? 1e-20 : facing;
    float unit = isPerspective ? light.facts.x / (along * along) : -depths.x;  // of distance
    vec2 slope = normal.xy * perTexel *
                 (isPerspective ? light.facts.x / facing : depths.x / facing);
#ifndef SURFACE
    if (isTurnedAway) slope = vec2(0.0);
#endif
    float depth = isPerspective ? light.facts.x / along : depths.y - depths.x * place.z;
    // Rounding: of places, of depths, and of the rasteriser's grid.
    depth += 4e-7 * away * unit + (isPerspective ? 2e-6 * depth : 2e-6) +
             (abs(slope.x) + abs(slope.y)) / 32.0;
    depth -= dot(slope, texels);
    vec2 base = floor(texels), part = texels - base;
    vec2 left = vec2(1.0 - part.x, 1.0), right = vec2(1.0, part.x);
    vec2 below = vec2(1.0 - part.y, 1.0), above = vec2(1.0, part.y);
    float lit = litTexels(base, size, layer, depth, slope, left, below) +
                litTexels(base + vec2(2.0, 0.0), size, layer, depth, slope, right, below) +
                litTexels(base + vec2(0.0, 2.0), size, layer, depth, slope, left, above) +
                litTexels(base + vec2(2.0, 2.0), size, layer, depth, slope, right, above);
    // Behind the light, or beyond its map, nothing casts a shadow.
    return (isPerspective && -place.z <= 0.0) || face.x == 0.0 ? 1.0 : lit / 9.0;
}

void findShares(vec3 position) {
    FIND_SHARE(0);
#if SHADOWED > 1
    FIND_SHARE(1);
#endif
#if SHADOWED > 2
    FIND_SHARE(2);
#endif
#if SHADOWED > 3
    FIND_SHARE(3);
#endif
#if SHADOWED > 4
    for (int i = 4; i < SHADOWED; ++i) FIND_SHARE(i);
#endif
}
#endif
