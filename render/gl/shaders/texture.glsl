// Textures of exact surfaces, with the level of detail of OpenGL 4.5, 8.14.1, worked out at the pixel's middle.
// llvmpipe's own is one for four pixels, of differences between them, and its logarithm is up to
// 0.04 off: 5 levels of 255 where two mipmaps differ much.
#ifdef TEXTURED
in vec2 uv;
uniform sampler2D image;
#ifdef SUPERSAMPLED
uniform float samplesAcross;  // of a pixel of the image, whose level of detail all its samples have
#endif

// Derivatives by pixel of an attribute that is linear over the triangle: v / w and 1 / w
// (gl_FragCoord.w) are linear over the image, so that their differences are exact.
#define CHANGE(difference, v) \
    ((difference((v) * gl_FragCoord.w) - (v) * difference(gl_FragCoord.w)) / gl_FragCoord.w)
#define CHANGE_RIGHT(v) CHANGE(dFdx, v)
#define CHANGE_UP(v) CHANGE(dFdy, v)

#if defined(ALPHA_TEST) && defined(EACH_SAMPLE)
uniform vec2 samplePlaces[EACH_SAMPLE];  // from the pixel's middle, px
vec2 sampleShift = vec2(0.0);   // place in the pixel that is looked up
#endif

// `right` and `up`: how `at` changes by a pixel of the target.
vec4 filtered(vec2 at, vec2 right, vec2 up) {
#if defined(ALPHA_TEST) && defined(EACH_SAMPLE)
    at += sampleShift.x * right + sampleShift.y * up;
#endif
#ifdef SUPERSAMPLED
    right *= samplesAcross;
    up *= samplesAcross;
#endif
#if defined(FILTER_ANISOTROPIC)
    return textureGrad(image, at, right, up);
#elif defined(FILTER_MIPMAP)
    vec2 size = vec2(textureSize(image, 0));
    vec2 a = right * size, b = up * size;
    return textureLod(image, at, 0.5 * log2(max(max(dot(a, a), dot(b, b)), 1e-30)));
#else
    return texture(image, at);
#endif
}

// The mesh's own coordinates, with the GL's derivatives.
vec4 sampleMesh() {
#if defined(ALPHA_TEST) && defined(EACH_SAMPLE)
    // The GL's level of detail is one for four pixels, and costs a third of one for each.
    return texture(image, uv + sampleShift.x * dFdx(uv) + sampleShift.y * dFdy(uv));
#elif !defined(SUPERSAMPLED)
    return texture(image, uv);
#elif defined(FILTER_ANISOTROPIC)
    return textureGrad(image, uv, samplesAcross * dFdx(uv), samplesAcross * dFdy(uv));
#else
    return texture(image, uv, log2(samplesAcross));
#endif
}

const float kTurn = 6.28318530717959;

// How the turn about Y, from +Z towards +X, changes as p moves by `step`: in turns.
float turnChange(vec3 p, vec3 step) {
    return (p.z * step.x - p.x * step.z) / (kTurn * max(dot(p.xz, p.xz), 1e-12));
}

// How atan(p.y, length(p.xz) - radius) changes: in turns.
float latitudeChange(vec3 p, float radius, vec3 step) {
    float whole = max(length(p.xz), 1e-6);
    float off = whole - radius;
    float change = off * step.y - p.y * dot(p.xz, step.xz) / whole;
    return change / (kTurn * max(off * off + p.y * p.y, 1e-12));
}

#ifdef MAPPING_SPHERE
// u from -X by way of -Z, v from the south pole; p of any length.
vec4 sampleSphere(vec3 p, vec3 right, vec3 up) {
    vec2 at = 0.5 + vec2(atan(p.z, p.x), 2.0 * atan(p.y, length(p.xz))) / kTurn;
    return filtered(at, vec2(-turnChange(p, right), 2.0 * latitudeChange(p, 0.0, right)),
                    vec2(-turnChange(p, up), 2.0 * latitudeChange(p, 0.0, up)));
}
#endif
#endif
