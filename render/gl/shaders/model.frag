#ifdef TEXTURED
in vec2 uv;
uniform sampler2D image;
#endif
#ifdef MAPPING_SPHERE
in vec3 positionMapped;
#endif
#ifdef GOURAUD
in vec3 modulated;
#ifdef SEPARATE_SPECULAR
in vec3 added;
#endif
#endif
#ifdef FLAT
flat in vec3 modulated;
#ifdef SEPARATE_SPECULAR
flat in vec3 added;
#endif
#endif
#if defined(PHONG) || defined(LAYER_NORMAL)
in vec3 normalView;
#endif
#if defined(PHONG) || defined(LAYER_DEPTH)
in vec3 positionView;
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
vec4 sampleSphere() {
    vec3 p = unitOr(positionMapped, vec3(0.0, 0.0, 1.0));
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
#if defined(LAYER_ID)
    result = vec4(plainColor, 1.0);
#elif defined(LAYER_NORMAL)
    result = vec4(worldFromView * unitOr(normalView, vec3(0.0, 0.0, 1.0)) * 0.5 + 0.5, 1.0);
#elif defined(LAYER_DEPTH)
    result = vec4(vec3(nearest / max(-positionView.z, nearest)), 1.0);
#else
#ifdef UNLIT
    vec3 modulated = plainColor;
#endif
#ifdef CHESS
    if ((gl_PrimitiveID & 1) == 1) modulated *= 0.25;
#endif
#ifdef PHONG
    vec3 primary, secondary, modulated, extra;
    shade(positionView, unitOr(normalView, vec3(0.0, 0.0, 1.0)), primary, secondary);
    finish(primary, secondary, modulated, extra);
#endif
    result = vec4(modulated, 1.0);
#ifdef TEXTURED
#ifdef MAPPING_SPHERE
    result.rgb *= sampleSphere().rgb;
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
