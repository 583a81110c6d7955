// Shadows by maps of the depths that lights see (render/plan/shadow_maps.h).
#ifdef SHADOWED
struct ShadowMap {
    vec4 across, up, away;                 // rows of mapFromEye
    vec4 planeAcross, planeUp, planeAway;  // rows of its inverse transpose
    vec4 facts;  // x: depth at distance 1 of a perspective, or 0; y: a texel; z: depth of a unit
};
const int kMaxShadowMaps = 64;
layout(std140, binding = 1) uniform ShadowMaps { ShadowMap shadowMaps[kMaxShadowMaps]; };
layout(binding = 3) uniform sampler2DArray shadowDepths;  // reversed; beyond an edge 0: nothing
uniform vec2 shadowOffset;  // texels, and share of the distance

// Of the pixel's surface: unit, towards its lit side; and how far drawn surfaces may be beside it.
vec3 receiverNormal;
vec2 receiverOffset = shadowOffset;

// Percentage-closer filter of 3 x 3 texels (Reeves, Salesin, Cook 1987): each of 4 x 4 texels is
// compared with the depth of the receiver's tangent plane at the texel's own middle, so that no
// slope needs a bias.
float shareOfLight(int first, int count, vec3 position) {
    vec2 size = vec2(textureSize(shadowDepths, 0).xy);
    float away = length(position);
    int map = -1;
    vec3 place = vec3(0.0, 0.0, 1.0);
    vec2 at = vec2(0.0);
    for (int i = first; i < first + count; ++i) {
        float near = shadowMaps[i].facts.x;
        vec4 eye = vec4(position, 1.0);
        float texel = shadowMaps[i].facts.y * (near > 0.0 ? dot(shadowMaps[i].away, eye) : 1.0);
        eye.xyz += (receiverOffset.x * texel + receiverOffset.y * away) * receiverNormal;
        vec3 p = vec3(dot(shadowMaps[i].across, eye), dot(shadowMaps[i].up, eye),
                      dot(shadowMaps[i].away, eye));
        vec2 q = near > 0.0 ? p.xy / max(p.z, 1e-30) : p.xy;
        // Within the margin of a map nothing casts a shadow, or the next face of its cube has it.
        bool isInside = max(abs(q.x), abs(q.y)) < 1.0 - 3.0 / size.x;
        if (isInside && (near == 0.0 || p.z > 0.0)) {
            map = i;
            place = p;
            at = q;
        }
    }
    int known = max(map, 0);
    vec4 facts = shadowMaps[known].facts;
    bool isPerspective = facts.x > 0.0;
    vec3 plane = vec3(dot(shadowMaps[known].planeAcross.xyz, receiverNormal),
                      dot(shadowMaps[known].planeUp.xyz, receiverNormal),
                      dot(shadowMaps[known].planeAway.xyz, receiverNormal));
    // Planes are planes in the map as well: depth is linear across and up.
    float facing = isPerspective ? dot(plane, place) : 2.0 * plane.z;
    facing = abs(facing) < 1e-12 ? 1e-12 : facing;
    vec2 slope = plane.xy * ((isPerspective ? facts.x : 1.0) / facing) * 2.0 / size;
    float depth = isPerspective ? facts.x / place.z : 0.5 - 0.5 * place.z;
    // Rounding: of places, of depths, and of the rasteriser's grid.
    float unit = isPerspective ? depth / place.z : facts.z;
    depth += 4e-7 * away * unit + (isPerspective ? 2e-6 * depth : 2e-6) +
             (abs(slope.x) + abs(slope.y)) / 32.0;
    vec2 texels = (at * 0.5 + 0.5) * size - 0.5;
    vec2 base = floor(texels), part = texels - base;
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 corner = base + vec2(i & 1, i >> 1) * 2.0;  // of four texels
        vec4 stored = textureGather(shadowDepths, vec3(corner / size, float(known)));
        float lowest = depth + dot(slope, corner - 1.0 - texels);
        vec4 expected =
            lowest + vec4(slope.y, slope.x + slope.y, slope.x, 0.0);  // in textureGather's order
        vec2 across = (i & 1) == 0 ? vec2(1.0 - part.x, 1.0) : vec2(1.0, part.x);
        vec2 up = (i >> 1) == 0 ? vec2(1.0 - part.y, 1.0) : vec2(1.0, part.y);
        vec4 weights = vec4(across.x * up.y, across.y * up.y, across.y * up.x, across.x * up.x);
        sum += dot(weights, vec4(lessThanEqual(stored, max(expected, 0.0))));
    }
    return map < 0 ? 1.0 : sum / 9.0;
}
#endif
