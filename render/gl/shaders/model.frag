#ifdef TEXTURED
in vec2 uv;
uniform sampler2D image;
#endif
#ifdef SURFACE
uniform vec3 surfaceLengths;
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
#ifdef LAYER_NORMAL
uniform mat3 worldFromView;
#endif
#ifdef LAYER_DEPTH
uniform float nearest;
#endif
#if defined(UNLIT) || defined(LAYER_ID)
uniform vec3 plainColor;
#endif

out vec4 result;

#ifdef MAPPING_SPHERE
const float kPi = 3.14159265358979;
vec4 sampleSphere(vec3 position) {
    vec3 p = unitOr(position, vec3(0.0, 0.0, 1.0));
    float u = 0.5 + atan(p.z, p.x) / (2.0 * kPi);
    float v = 0.5 + asin(clamp(p.y, -1.0, 1.0)) / kPi;
    // Across the seam u jumps by one; the nearer of two unwrappings has the true derivative.
    float other = fract(u + 0.5) - 0.5;
    vec2 a = vec2(u, v), b = vec2(other, v);
    vec2 dx = dFdx(a), dy = dFdy(a), ex = dFdx(b), ey = dFdy(b);
    if (abs(ex.x) + abs(ey.x) < abs(dx.x) + abs(dy.x)) {
        dx = ex;
        dy = ey;
    }
    return textureGrad(image, a, dx, dy);
}
#endif

void main() {
#ifdef SURFACE
    float along = toSurface();
    vec3 unit = unitPosition + along * unitRay;
    vec3 normal = surfaceNormal(unit);
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
    shade(position, unitOr(normal, vec3(0.0, 0.0, 1.0)), primary, secondary);
    finish(primary, secondary, modulated, extra);
#endif
    result = vec4(modulated, 1.0);
#ifdef TEXTURED
#ifdef MAPPING_SPHERE
#ifdef SURFACE
    result.rgb *= sampleSphere(unit * surfaceLengths).rgb;
#else
    result.rgb *= sampleSphere(positionMapped).rgb;
#endif
#elif defined(SURFACE)
#if defined(TEXGEN_OBJECT)
    vec4 place = vec4(unit * surfaceLengths, 1.0);
    vec2 at = vec2(dot(planeS, place), dot(planeT, place));
#elif defined(TEXGEN_EYE)
    vec2 at = vec2(dot(planeS, vec4(position, 1.0)), dot(planeT, vec4(position, 1.0)));
#else
#define SURFACE_OWN_UV
#endif
#ifdef SURFACE_OWN_UV
    result.rgb *= sampleSurface(image, unit, uv).rgb;
#else
    result.rgb *= texture(image, at).rgb;
#endif
#else
    result.rgb *= texture(image, uv).rgb;
#endif
#endif
#ifdef SEPARATE_SPECULAR
#ifdef PHONG
    result.rgb += extra;
#elif !defined(UNLIT)
    result.rgb += added;
#endif
#endif
#endif
}
