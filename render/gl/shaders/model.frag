#ifdef SURFACE
#if defined(TEXGEN_OBJECT) || defined(TEXGEN_EYE)
uniform vec4 planeS;
uniform vec4 planeT;
#endif
#elif defined(MAPPING_SPHERE)
in vec3 positionMapped;
#endif
#ifdef GOURAUD
COVERED in vec3 modulated;
#ifdef SEPARATE_SPECULAR
COVERED in vec3 added;
#endif
#endif
#ifdef FLAT
flat in vec3 modulated;
#ifdef SEPARATE_SPECULAR
flat in vec3 added;
#endif
#endif
#if (defined(PHONG) || defined(LAYER_NORMAL)) && !defined(SURFACE)
COVERED in vec3 normalView;
#endif
#if defined(PHONG) || defined(LAYER_DEPTH) || (defined(SURFACE) && defined(TEXGEN_EYE))
COVERED in vec3 positionView;
#endif
#if defined(SHADOWED) && (!defined(SURFACE) || defined(SURFACE_PROFILE))
in vec3 facePosition;  // at the pixel's middle, so that differences are those of the face
#endif
#ifdef VERTEX_COLOR
COVERED in vec3 vertexColor;
#endif
#ifdef LAYER_NORMAL
uniform mat3 worldFromView;
#endif
#ifdef LAYER_DEPTH
uniform float nearest;
#endif
#if defined(UNLIT) || defined(LAYER_ID)
uniform vec3 plainColor;
#endif

#ifdef EXACT_DEPTH
uniform mat4 clipFromView;
#endif

#if defined(ALPHA_TEST) || defined(BLENDED)
uniform float opacity;
#endif
#ifdef PEELED
// Reversed: the larger is the nearer.
#ifdef EACH_SAMPLE
layout(binding = 1) uniform sampler2DMS opaqueDepth;
layout(binding = 2) uniform sampler2DMS layerDepth;
#define FETCH_DEPTH(depths) texelFetch(depths, ivec2(gl_FragCoord.xy), gl_SampleID).r
#else
layout(binding = 1) uniform sampler2D opaqueDepth;
layout(binding = 2) uniform sampler2D layerDepth;
#define FETCH_DEPTH(depths) texelFetch(depths, ivec2(gl_FragCoord.xy), 0).r
#endif
#endif

out vec4 result;

void main() {
#ifdef SURFACE
    rayStart = unitPosition;
    rayStep = unitRay;
#if defined(SHADOWED) && defined(EXACT_DEPTH)
    // llvmpipe takes attributes at a sample over the w of the pixel's middle; depth is the sample's.
    float w = clipFromView[3].z / (gl_FragCoord.z + clipFromView[2].z);
    float atSample = w / max(-positionView.z, 1e-30);
    rayStart *= atSample;
    rayStep *= atSample;
#endif
    float along = toSurface();
    vec3 unit = rayStart + along * rayStep;
    vec3 normal = normalFromObject * surfaceGradient(unit);
#ifdef EXACT_DEPTH
    float step = along;
#ifdef SURFACE_CAPS
    // Nearer than the mesh and past an end the ray has met that end's plane: not in front of it.
    if (along < 0.0 && abs(unit.y - 0.5) > 0.500001) step = 0.0;
#endif
    // Depth is linear in 1 / distance along the view. Where the mesh is the surface, it is the mesh's to the bit.
    gl_FragDepth = gl_FragCoord.z - clipFromView[3].z * gl_FragCoord.w * step / (1.0 + step);
#endif
#if defined(PHONG) || defined(LAYER_DEPTH) || defined(TEXGEN_EYE)
    vec3 position = positionView * (1.0 + along);
#endif
#else
#if defined(PHONG) || defined(LAYER_NORMAL)
    vec3 normal = normalView;
#endif
#if defined(PHONG) || defined(LAYER_DEPTH)
    vec3 position = positionView;
#endif
#endif
#if defined(TEXTURED) && defined(SURFACE)
    vec3 gradient = surfaceGradient(unit), reach = (1.0 + along) * rayStep;
    vec3 right = tangentChange((1.0 + along) * CHANGE_RIGHT(unitRay), reach, gradient);
    vec3 up = tangentChange((1.0 + along) * CHANGE_UP(unitRay), reach, gradient);
#if defined(MAPPING_SPHERE)
#define TEXEL sampleSphere(unit * surfaceLengths, right * surfaceLengths, up * surfaceLengths)
#elif defined(TEXGEN_OBJECT)
    mat3x2 plane = transpose(mat2x3(planeS.xyz * surfaceLengths, planeT.xyz * surfaceLengths));
#define TEXEL filtered(plane * unit + vec2(planeS.w, planeT.w), plane * right, plane * up)
#elif defined(TEXGEN_EYE)
    mat3x2 plane = transpose(mat2x3(planeS.xyz, planeT.xyz));
    vec3 eyeRight = tangentChange((1.0 + along) * CHANGE_RIGHT(positionView), position, normal);
    vec3 eyeUp = tangentChange((1.0 + along) * CHANGE_UP(positionView), position, normal);
#define TEXEL \
    filtered(plane * position + vec2(planeS.w, planeT.w), plane * eyeRight, plane * eyeUp)
#else
#define TEXEL sampleSurface(unit, uv, right, up)
#endif
#elif defined(TEXTURED) && defined(MAPPING_SPHERE)
#define TEXEL \
    sampleSphere(positionMapped, CHANGE_RIGHT(positionMapped), CHANGE_UP(positionMapped))
#elif defined(TEXTURED)
#define TEXEL sampleMesh()
#endif
#ifdef PEELED
#ifdef EXACT_DEPTH
    float depth = gl_FragDepth;
#else
    float depth = gl_FragCoord.z;
#endif
    if (depth <= FETCH_DEPTH(opaqueDepth) || depth >= FETCH_DEPTH(layerDepth)) discard;
#endif
#if defined(ALPHA_TEST) && defined(EACH_SAMPLE)
    // A pixel's colour is the mean of its samples that are there.
    vec4 texel = vec4(0.0);
    int there = 0;
    for (int i = 0; i < EACH_SAMPLE; ++i) {
        sampleShift = samplePlaces[i];
        vec4 one = TEXEL;
        there |= one.a < 0.5 ? 0 : 1 << i;
        texel += one.a < 0.5 ? vec4(0.0) : one;
    }
    if (there == 0) discard;
    gl_SampleMask[0] = there;
#elif defined(TEXTURED)
    vec4 texel = TEXEL;
#ifdef ALPHA_TEST
    if (texel.a * opacity < 0.5) discard;
#endif
#endif
#ifdef ALPHA_TEST
    texel.rgb /= max(texel.a, 0.25);
#endif
#if defined(LAYER_ID)
    result = vec4(plainColor, 1.0);
#elif defined(LAYER_NORMAL)
    result = vec4(worldFromView * unitOr(normal, vec3(0.0, 0.0, 1.0)) * 0.5 + 0.5, 1.0);
#elif defined(LAYER_DEPTH)
    result = vec4(vec3(nearest / max(-position.z, nearest)), 1.0);
#else
#ifdef UNLIT
    vec3 modulated = plainColor;
#endif
#ifdef CHESS
    if ((gl_PrimitiveID & 1) == 1) modulated *= 0.25;
#endif
#ifdef PHONG
    vec3 primary, secondary, modulated, extra;
    vec3 shadingNormal = unitOr(normal, vec3(0.0, 0.0, 1.0));
#ifdef SHADOWED
    receiverNormal = shadingNormal;
#ifdef EXACT_DEPTH
    position *= atSample;
#endif
#if !defined(SURFACE) || defined(SURFACE_PROFILE)
    vec3 face = unitOr(cross(dFdx(facePosition), dFdy(facePosition)), shadingNormal);
    // An attribute at a covered sample likewise: back to the face.
    float facing = dot(face, position);
    position *= abs(facing) > 1e-30 ? clamp(dot(face, facePosition) / facing, 0.5, 2.0) : 1.0;
#endif
#ifndef SURFACE
    receiverNormal = dot(face, shadingNormal) < 0.0 ? -face : face;
#elif defined(SURFACE_CAPS)
    if (cap != 0.0) receiverOffset = vec3(0.0);
#endif
#endif
#ifdef SHADOWED
    findShares(position);
#endif
    shade(position, shadingNormal, primary, secondary);
    finish(primary, secondary, modulated, extra);
#endif
    result = vec4(modulated, 1.0);
#ifdef VERTEX_COLOR
    result.rgb *= vertexColor;
#endif
#ifdef TEXTURED
    result.rgb *= texel.rgb;
#endif
#ifdef SEPARATE_SPECULAR
#ifdef PHONG
    result.rgb += extra;
#elif !defined(UNLIT)
    result.rgb += added;
#endif
#endif
#ifdef BLENDED
    // Colours of textures are multiplied by their alpha already.
#ifdef TEXTURED
#ifdef SEPARATE_SPECULAR
#ifdef PHONG
    result.rgb += (texel.a - 1.0) * extra;
#elif !defined(UNLIT)
    result.rgb += (texel.a - 1.0) * added;
#endif
#endif
    result.a = texel.a;
#endif
    result *= opacity;
#ifdef PEELED
    if (result.a == 0.0) discard;
#endif
#endif
#endif
}
