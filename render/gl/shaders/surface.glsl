// The exact surface behind a mesh that only approaches it: the pixel's ray is followed from the
// triangle to the surface, so that normals, texture coordinates and places do not depend on how
// finely the mesh is cut. Lengths are those of generator::Surface.
#ifdef SURFACE
in vec3 unitPosition;  // on the triangle
in vec3 unitRay;       // from the eye to there
#if defined(SURFACE_FRUSTUM) || defined(SURFACE_RING)
flat in float cap;  // of the flat parts: their normal's y; 0: the side
#endif
// From unit gradients.
#ifdef INSTANCED
flat in mat3 normalFromObject;
#else
uniform mat3 normalFromObject;
#endif
uniform float seenFrom;         // 1: from outside, -1: the insides
uniform vec2 surfaceForm;

// t where the ray enters: the first root of a t^2 + 2 b t + c, without cancellation.
float entry(float a, float b, float c) {
    float root = sqrt(max(b * b - a * c, 0.0));
    if (b < 0.0) return c / (root - b);
    return a > 0.0 ? -(b + root) / a : 0.0;
}

// Second-order coefficients of the surface's equation along the ray.
void expand(vec3 q, vec3 d, out float a, out float b, out float c) {
#if defined(SURFACE_ELLIPSOID)
    a = dot(d, d);
    b = dot(q, d);
    c = dot(q, q) - 1.0;
#elif defined(SURFACE_FRUSTUM)
    float radius = surfaceForm.x + surfaceForm.y * q.y;
    float slope = surfaceForm.y * d.y;
    a = dot(d.xz, d.xz) - slope * slope;
    b = dot(q.xz, d.xz) - slope * radius;
    c = dot(q.xz, q.xz) - radius * radius;
#elif defined(SURFACE_TORUS)
    float radius = length(q.xz);
    float rate = dot(q.xz, d.xz) / radius;
    a = dot(d, d) - (dot(d.xz, d.xz) - rate * rate) / radius;
    b = rate * (radius - 1.0) + q.y * d.y;
    c = (radius - 1.0) * (radius - 1.0) + q.y * q.y - surfaceForm.x * surfaceForm.x;
#endif
}

// How far along the ray the surface is, in lengths of the ray.
float toSurface() {
#ifdef SURFACE_RING
    return 0.0;
#else
#ifdef SURFACE_FRUSTUM
    if (cap != 0.0) return 0.0;
#endif
    const float kFarthest = 0.5;  // only rays that graze a shape round the eye go so far
    float a, b, c;
    expand(unitPosition, unitRay, a, b, c);
    float t = seenFrom * entry(a, seenFrom * b, c);
#ifdef SURFACE_TORUS
    // Not a quadric: once more from there.
    t = clamp(t, -kFarthest, kFarthest);
    expand(unitPosition + t * unitRay, unitRay, a, b, c);
    t += seenFrom * entry(a, seenFrom * b, c);
#endif
    return clamp(t, -kFarthest, kFarthest);
#endif
}

// Of any length, eye space.
vec3 surfaceNormal(vec3 q) {
#if defined(SURFACE_ELLIPSOID)
    return normalFromObject * q;
#elif defined(SURFACE_FRUSTUM)
    float radius = surfaceForm.x + surfaceForm.y * q.y;
    return normalFromObject *
           (cap != 0.0 ? vec3(0.0, cap, 0.0) : vec3(q.x, -surfaceForm.y * radius, q.z));
#elif defined(SURFACE_TORUS)
    float radius = length(q.xz);
    return normalFromObject * vec3(q.x - q.x / radius, q.y, q.z - q.z / radius);
#else
    return cap * normalFromObject[1];
#endif
}

#ifdef TEXTURED
uniform vec4 surfaceUv;
uniform vec4 surfaceDiscs;
uniform float balance;  // by which the mesh is wider than its coordinates

// `near`: the triangle's own coordinates, which tell the turn that is meant.
vec2 surfaceCoordinates(vec3 q, vec2 near) {
#ifdef SURFACE_FRUSTUM
    if (cap != 0.0) {
        vec2 middle = cap < 0.0 ? surfaceDiscs.xy : surfaceDiscs.zw;
        return middle + balance * (near - middle);
    }
#endif
#ifdef SURFACE_DISC_UV
    return surfaceUv.xz + surfaceUv.yw * q.xz;
#else
    const float kTurn = 6.28318530717959;
    float radius = length(q.xz);
#ifdef SURFACE_TURN_FROM_X
    float turn = atan(-q.z, q.x) / kTurn;
#else
    float turn = atan(q.x, q.z) / kTurn;
#endif
#if defined(SURFACE_ELLIPSOID)
    float share = 0.5 + atan(q.y, radius) / (0.5 * kTurn);
#elif defined(SURFACE_FRUSTUM)
    float share = q.y;
#elif defined(SURFACE_TORUS)
    float share = atan(q.y, radius - 1.0) / kTurn;
#else
    float share = (radius - surfaceForm.x) / (1.0 - surfaceForm.x);
#endif
    vec2 uv = surfaceUv.xz + surfaceUv.yw * vec2(turn, share);
    uv.x += floor(near.x - uv.x + 0.5);
#ifdef SURFACE_TORUS
    uv.y += floor(near.y - uv.y + 0.5);
#endif
    return uv;
#endif
}

#ifdef SURFACE_TIPS
// How the coordinates change with q by `step`. At a pole or an apex the turn changes so fast that
// differences between pixels are no derivatives.
vec2 coordinateChange(vec3 q, vec3 step) {
    const float kTurn = 6.28318530717959;
    float squared = max(dot(q.xz, q.xz), 1e-12);
    float turn = (q.z * step.x - q.x * step.z) / (kTurn * squared);
#ifdef SURFACE_ELLIPSOID
    float radius = sqrt(squared);
    float change = radius * step.y - q.y * dot(q.xz, step.xz) / radius;
    float share = change / (0.5 * kTurn * dot(q, q));
#else
    float share = step.y;
#endif
    return surfaceUv.yw * vec2(turn, share);
}
#endif

vec4 sampleSurface(sampler2D image, vec3 q, vec2 near) {
    vec2 uv = surfaceCoordinates(q, near);
#ifdef SURFACE_TIPS
    vec3 dx = dFdx(q), dy = dFdy(q);
#ifdef SURFACE_FRUSTUM
    vec2 ex = dFdx(near), ey = dFdy(near);
    if (cap != 0.0) return textureGrad(image, uv, ex, ey);
#endif
    return textureGrad(image, uv, coordinateChange(q, dx), coordinateChange(q, dy));
#else
    return texture(image, uv);
#endif
}
#endif
#endif
