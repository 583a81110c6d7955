// The exact surface behind a mesh that only approaches it: the pixel's ray is followed from the
// triangle to the surface, so that normals, texture coordinates and places do not depend on how
// finely the mesh is cut. Lengths are those of generator::Surface.
#ifdef SURFACE
RAY in vec3 unitPosition;  // on the triangle
RAY in vec3 unitRay;       // from the eye to there
vec3 rayStart, rayStep;    // both, as main() sets them
#ifdef SURFACE_CAPS
flat in float cap;  // of the flat parts: their normal's y; 0: the side
#endif
#ifdef SURFACE_PROFILE
// Within a facet only the turn differs from the surface's: attributes of the profile are linear.
COVERED in vec2 profileNormal;  // away from Y, along it
COVERED in vec3 unitCovered;
#endif
#ifdef INSTANCED
flat in mat3 normalFromObject;  // from unit gradients
#endif

// t where the ray enters: the first root of a t^2 + 2 b t + c, without cancellation. Without a
// root where the ray comes nearest: the mesh stands out of its surface there.
float entry(float a, float b, float c) {
    float square = b * b - a * c;
    if (square > 0.0 && b < 0.0) return c / (sqrt(square) - b);
    return a > 0.0 ? -(b + sqrt(max(square, 0.0))) / a : 0.0;
}

#ifndef SURFACE_PROFILE
// Of the kind of surface (generator::SurfaceKind::glsl).
#ifdef SURFACE_RAY
// Second-order coefficients of the surface's equation along the ray.
void expand(vec3 q, vec3 d, out float a, out float b, out float c);
#endif
// Out of the curved part, of any length.
vec3 sideGradient(vec3 q);
#ifdef TEXTURED
// Where q is between the curved part's ends, 0..1, and how that changes as q moves by `step`.
float shareOf(vec3 q);
float shareChange(vec3 q, vec3 step);
#endif
#endif

// How far along the ray the surface is, in lengths of the ray.
float toSurface() {
#ifndef SURFACE_RAY
    return 0.0;
#else
#ifdef SURFACE_CAPS
    if (cap != 0.0) return 0.0;
#endif
    const float kFarthest = 0.5;  // only rays that graze a shape round the eye go so far
    float a, b, c;
    expand(rayStart, rayStep, a, b, c);
    float t = seenFrom * entry(a, seenFrom * b, c);
#ifdef SURFACE_TWO_STEPS
#ifdef EXACT_DEPTH
    const int kSteps = 5;  // each leaves the cube of the error; rays that graze the surface want them
#else
    const int kSteps = 2;
#endif
    for (int i = 1; i < kSteps; ++i) {
        t = clamp(t, -kFarthest, kFarthest);
        expand(rayStart + t * rayStep, rayStep, a, b, c);
        t += seenFrom * entry(a, seenFrom * b, c);
    }
#endif
    return clamp(t, -kFarthest, kFarthest);
#endif
}

// Out of the surface, of any length.
vec3 surfaceGradient(vec3 q) {
#ifdef SURFACE_PROFILE
    vec2 outwards = unitCovered.xz / max(length(unitCovered.xz), 1e-20);
    return vec3(profileNormal.x * outwards.x, profileNormal.y, profileNormal.x * outwards.y);
#else
#ifdef SURFACE_CAPS
    if (cap != 0.0) return vec3(0.0, cap, 0.0);
#endif
    return sideGradient(q);
#endif
}

#ifdef TEXTURED
// `near`: the triangle's interpolated coordinates, which select the whole turn of u.
vec2 surfaceCoordinates(vec3 q, vec2 near) {
#if defined(SURFACE_CAPS) && defined(SURFACE_RAY)
    if (cap != 0.0) {
        vec2 middle = cap < 0.0 ? surfaceDiscs.xy : surfaceDiscs.zw;
        return middle + balance * (near - middle);
    }
#endif
#ifdef SURFACE_DISC_UV
    return surfaceUv.xz + surfaceUv.yw * q.xz;
#else
#ifdef SURFACE_TURN_FROM_X
    float turn = atan(-q.z, q.x) / kTurn;
#else
    float turn = atan(q.x, q.z) / kTurn;
#endif
#ifdef SURFACE_PROFILE
    float share = near.y;
#else
    float share = shareOf(q);
#endif
    vec2 uv = surfaceUv.xz + surfaceUv.yw * vec2(turn, share);
    uv.x += floor(near.x - uv.x + 0.5);
#ifdef SURFACE_WRAPS_V
    uv.y += floor(near.y - uv.y + 0.5);
#endif
    return uv;
#endif
}

#ifndef SURFACE_PROFILE
// The coordinates' change as q, on the surface, moves by `step`.
vec2 coordinateChange(vec3 q, vec3 step) {
#ifdef SURFACE_DISC_UV
    return surfaceUv.yw * step.xz;
#else
    return surfaceUv.yw * vec2(turnChange(q, step), shareChange(q, step));
#endif
}
#endif

// Returns the change of the hit point in the tangent plane for the neighbouring pixel. `aside`: its
// change in the triangle; `reach`: from the eye to the hit point. Space of `gradient`.
vec3 tangentChange(vec3 aside, vec3 reach, vec3 gradient) {
    float facing = dot(gradient, reach);
    if (abs(facing) < 1e-12) return aside;
    return aside - reach * (dot(gradient, aside) / facing);
}

vec4 sampleSurface(vec3 q, vec2 near, vec3 right, vec3 up) {
    vec2 at = surfaceCoordinates(q, near);
#if defined(SURFACE_CAPS) && defined(SURFACE_RAY)
    if (cap != 0.0) return filtered(at, balance * CHANGE_RIGHT(near), balance * CHANGE_UP(near));
#endif
#ifdef SURFACE_PROFILE
    return filtered(at, vec2(turnChange(q, right), CHANGE_RIGHT(near.y)),
                    vec2(turnChange(q, up), CHANGE_UP(near.y)));
#else
    return filtered(at, coordinateChange(q, right), coordinateChange(q, up));
#endif
}
#endif
#endif
