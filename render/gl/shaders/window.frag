in vec2 windowPosition;
out vec4 result;

#if defined(RESOLVE)
uniform sampler2DMS drawn;

// The mean of a pixel's samples, added up in their order.
void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < RESOLVE; ++i) sum += texelFetch(drawn, ivec2(gl_FragCoord.xy), i);
    result = sum * (1.0 / RESOLVE);
}
#elif defined(LAYER)
// Premultiplied.
#ifdef EACH_SAMPLE
uniform sampler2DMS drawn;

void main() { result = texelFetch(drawn, ivec2(gl_FragCoord.xy), gl_SampleID); }
#else
uniform sampler2D drawn;

void main() { result = texelFetch(drawn, ivec2(gl_FragCoord.xy), 0); }
#endif
#else
#ifdef SUPERSAMPLED
uniform float samplesAcross;  // of a pixel of the image, whose level of detail all its samples have
#define BIAS log2(samplesAcross)
#else
#define BIAS 0.0
#endif
#ifdef SKYBOX
uniform samplerCube sky;
flat in mat3 skyFromView;
flat in vec2 skyTangents;

void main() {
    vec3 ray = skyFromView * vec3(windowPosition * skyTangents, -1.0);
    // Cube maps are left-handed.
    result = vec4(texture(sky, vec3(ray.xy, -ray.z), BIAS).rgb, 1.0);
}
#else
uniform sampler2D image;

void main() { result = vec4(texture(image, windowPosition * 0.5 + 0.5, BIAS).rgb, 1.0); }
#endif
#endif
