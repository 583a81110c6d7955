// Interpolation of lighting attributes: at an outline at a covered sample, not at the pixel's
// centre, which may lie far outside a triangle that is seen edge-on. A ray to the exact surface
// starts anywhere in the triangle's plane, and texture coordinates stay at the centre (RAY):
// differences between pixels choose their mipmap. A depth that the shader writes is one for all of
// the samples that it is run for: exact depths are those of each sample, as is then the shading.
#if defined(EXACT_DEPTH)
#define COVERED sample
#define RAY sample
#elif defined(SURFACE) && !defined(SURFACE_PROFILE)
#define COVERED
#define RAY
#else
#define COVERED centroid
#define RAY
#endif

// No finite input gives NaN or infinity: docs/explanation/accuracy.md, "Guards of the shaders", has a
// row for each division, root, power and logarithm of these files.

// The shading model of OpenGL 2.1, section 2.14.1, written once for vertex and fragment stage.
// Eye space: the viewer at the origin, looking along -Z.

#if LIGHT_COUNT > 0
struct Light {
    vec4 position;     // w = 1: eye-space place; w = 0: unit vector towards the light
    vec4 spot;         // xyz: unit direction of shining; w: cosine of the cutoff, -2: no cone
    vec4 attenuation;  // constant, linear, quadratic; w: spot exponent
    vec4 diffuse;
    vec4 ambient;
    vec4 specular;
};
#if !defined(CARRIED) || !defined(FRAGMENT)
layout(std140, binding = 0) uniform Lights { Light lights[LIGHT_COUNT]; };
#endif
#if LIGHT_COUNT > 1 && !defined(CARRIED)
// LIGHT_COUNT, without the compiler's knowledge: it then unrolls the loop with tests between, which
// takes it 2 s where six lights in a row take 5 s, for frames that take as long.
uniform int lightCount;
#else
const int lightCount = LIGHT_COUNT;
#endif
#endif

#if !defined(CARRIED) || !defined(FRAGMENT)
uniform vec3 materialDiffuse;
uniform vec3 materialBase;  // emissive + ambient * global ambient
uniform vec3 materialAmbient;
uniform vec3 materialSpecular;
uniform float materialShininess;
#if defined(SURFACE) && !defined(INSTANCED)
uniform mat3 normalFromObject;
#endif
#ifdef SURFACE
uniform float seenFrom;  // 1: from outside, -1: the insides
uniform vec2 surfaceForm;
uniform vec3 surfaceLengths;
uniform vec4 surfaceUv;
uniform vec4 surfaceDiscs;
uniform float balance;  // by which the mesh is wider than its coordinates
#endif
#endif

#ifdef CARRIED
// The uniforms that fragments read, as flat attributes: llvmpipe (Mesa 22) reads each number of a
// uniform in a fragment shader for each pixel, in 27 instructions, and that of an attribute once.
#ifdef FRAGMENT
in Carried {
#else
out Carried {
#endif
    flat vec3 lightTo[LIGHT_COUNT];  // Light::position
    flat vec3 lightAmbient[LIGHT_COUNT];  // times the material's, without shadows
    flat vec3 lightDiffuse[LIGHT_COUNT];
#ifdef POSITIONAL
    flat float lightPlaced[LIGHT_COUNT];  // Light::position.w
    flat vec3 lightAttenuation[LIGHT_COUNT];
#endif
#ifdef SPOT
    flat vec4 lightSpot[LIGHT_COUNT];
    flat float lightExponent[LIGHT_COUNT];
#endif
#ifdef SPECULAR
    flat vec3 lightSpecular[LIGHT_COUNT];
    flat vec3 materialSpecular;
    flat float materialShininess;
#endif
    flat vec3 materialDiffuse;
    flat vec3 materialBase;
#ifdef SHADOWED
    flat vec3 materialAmbient;
#endif
#ifdef SURFACE
#ifndef INSTANCED
    flat mat3 normalFromObject;
#endif
    flat float seenFrom;
    flat vec2 surfaceForm;
#ifdef TEXTURED
    flat vec3 surfaceLengths;
    flat vec4 surfaceUv;
    flat vec4 surfaceDiscs;
    flat float balance;
#endif
#endif
#ifdef FRAGMENT
};
#else
} carried;
#endif
#endif

#if defined(CARRIED) && defined(FRAGMENT)
#define LIGHT_TO(i) lightTo[i]
#define LIGHT_AMBIENT(i) lightAmbient[i]
#define AMBIENT(i) lightAmbient[i]
#define LIGHT_DIFFUSE(i) lightDiffuse[i]
#define LIGHT_PLACED(i) lightPlaced[i]
#define LIGHT_ATTENUATION(i) lightAttenuation[i]
#define LIGHT_SPOT(i) lightSpot[i]
#define LIGHT_EXPONENT(i) lightExponent[i]
#define LIGHT_SPECULAR(i) lightSpecular[i]
#else
#define LIGHT_TO(i) lights[i].position.xyz
#define LIGHT_AMBIENT(i) lights[i].ambient.rgb
#define AMBIENT(i) (materialAmbient * lights[i].ambient.rgb)
#define LIGHT_DIFFUSE(i) lights[i].diffuse.rgb
#define LIGHT_PLACED(i) lights[i].position.w
#define LIGHT_ATTENUATION(i) lights[i].attenuation.xyz
#define LIGHT_SPOT(i) lights[i].spot
#define LIGHT_EXPONENT(i) lights[i].attenuation.w
#define LIGHT_SPECULAR(i) lights[i].specular.rgb
#endif

#ifdef MARK_NOT_FINITE
bool isFinite(vec3 v) {
    const uvec3 kExponent = uvec3(0x7f800000u);
    return all(notEqual(floatBitsToUint(v) & kExponent, kExponent));
}
#endif

#if defined(SHADOWED) && defined(FRAGMENT)
// The shares of the first lights that reach the pixel, 0..1; set before shade().
float shares[SHADOWED];
#endif

// normal: unit. primary holds all but the specular part, which goes to secondary.
void shade(vec3 position, vec3 normal, out vec3 primary, out vec3 secondary) {
    primary = materialBase;
    secondary = vec3(0.0);
#if LIGHT_COUNT > 0
    for (int i = 0; i < lightCount; ++i) {
        vec3 toLight = LIGHT_TO(i);
        float strength = 1.0;
#ifdef POSITIONAL
        if (LIGHT_PLACED(i) != 0.0) {
            toLight -= position;
            float distance = length(toLight);
            // A light exactly at the point has no direction: ambient only.
            toLight = distance > 0.0 ? toLight / distance : vec3(0.0);
            vec3 k = LIGHT_ATTENUATION(i);
            // A tiny sum rounds to 0; a strength of 1e30 saturates any colour.
            strength = 1.0 / max(k.x + distance * (k.y + distance * k.z), 1e-30);
#ifdef SPOT
            if (LIGHT_SPOT(i).w > -2.0) {
                float cosine = -dot(toLight, LIGHT_SPOT(i).xyz);
                float exponent = LIGHT_EXPONENT(i);
                if (cosine < LIGHT_SPOT(i).w)
                    strength = 0.0;
                else if (exponent > 0.0)  // pow(0, 0) is undefined; exponent 0 is 1 in the cone
                    strength *= pow(max(cosine, 0.0), exponent);
            }
#endif
        }
#endif
        float lambert = dot(normal, toLight);
#if defined(SHADOWED) && defined(FRAGMENT)
        primary += strength * materialAmbient * LIGHT_AMBIENT(i);
        if (i < SHADOWED) strength *= shares[i];
        primary += strength * max(lambert, 0.0) * materialDiffuse * LIGHT_DIFFUSE(i);
#else
        primary += strength * (AMBIENT(i) +
                               max(lambert, 0.0) * materialDiffuse * LIGHT_DIFFUSE(i));
#endif
#ifdef SPECULAR
        if (lambert > 0.0) {
#ifdef LOCAL_VIEWER
            // A vertex may be at the viewer's very place; no pixel is.
            vec3 toViewer = -position * inversesqrt(max(dot(position, position), 1e-30));
#else
            vec3 toViewer = vec3(0.0, 0.0, 1.0);
#endif
            vec3 halfway = toLight + toViewer;
            float size = length(halfway);
            float cosine = size > 0.0 ? max(dot(normal, halfway) / size, 0.0) : 0.0;
            float glint = materialShininess > 0.0 ? pow(cosine, materialShininess) : 1.0;
            secondary += strength * glint * materialSpecular * LIGHT_SPECULAR(i);
        }
#endif
    }
#endif
#ifdef MARK_NOT_FINITE
    if (isFinite(position) && isFinite(normal) && isFinite(primary) && isFinite(secondary)) return;
    primary = vec3(1.0, 0.0, 1.0);
    secondary = vec3(0.0);
#endif
}

// Splits the colour into the part that the texture modulates and the part added after it, 0..1.
void finish(vec3 primary, vec3 secondary, out vec3 modulated, out vec3 added) {
#ifdef SEPARATE_SPECULAR
    modulated = clamp(primary, 0.0, 1.0);
    added = clamp(secondary, 0.0, 1.0);
#else
    modulated = clamp(primary + secondary, 0.0, 1.0);
    added = vec3(0.0);
#endif
}

// A zero normal of a mesh file must not become NaN.
vec3 unitOr(vec3 v, vec3 other) {
    float size = length(v);
    return size > 0.0 ? v / size : other;
}
